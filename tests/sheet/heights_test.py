#!/usr/bin/env python3
"""heights_test.py RENDER FOLDER: heights of a plan's raster against the truth of a simulated scan (SPLATRAY_DATA_DIR): off by a quarter
of the points' spacing at most in the median, where its floors are. Exit 77: skipped."""
import json
import os
import pathlib
import subprocess
import sys

from pypi_python import RASTERIO, pypi_python

render, folder = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
CUT = 2.0  # above the floor: pews and pillars' feet

COMPARE = """
import json, sys
import numpy, rasterio
truth, raster, cut = numpy.load(sys.argv[1]), sys.argv[2], float(sys.argv[3])
place = truth["position"] + truth["offset"]
# What looks up and was measured where it is; the world is y-up, a plan's top is -z.
floor = place[(truth["kind"] == 0) & (truth["normal"][:, 1] > 0.9 * 32767) & (place[:, 1] < cut - 0.05)]
with rasterio.open(raster) as file:
    columns, rows = (numpy.floor(v).astype(int) for v in ~file.transform * (floor[:, 0], -floor[:, 2]))
    inside = (columns >= 0) & (rows >= 0) & (columns < file.width) & (rows < file.height)
    found = file.read(1)[rows[inside], columns[inside]]
off = numpy.abs(found - floor[inside, 1])
some = floor[:: len(floor) // 300]
apart = [numpy.partition(((floor - one) ** 2).sum(1), 1)[1] ** 0.5 for one in some]
print(json.dumps([len(off), float(numpy.isfinite(off).mean()), float(numpy.nanmedian(off)), float(numpy.median(apart))]))
"""


def main():
    if "SPLATRAY_DATA_DIR" not in os.environ:
        print("skipped: SPLATRAY_DATA_DIR is not set: heights are not compared with a scan's truth")
        sys.exit(77)
    folder.mkdir(parents=True, exist_ok=True)
    python = pypi_python(folder.parent / "rasterio", *RASTERIO)
    scan = pathlib.Path(os.environ["SPLATRAY_DATA_DIR"]) / "scans/sim_sibenik_tls.e57"
    heights = folder / "heights.tif"
    subprocess.run([render, "--quiet", scan, "--sheet", f"plan:z={CUT},scale=50,dpi=100", "--samples", "1", "--keep-noise",
                    "--height-raster", heights, "-o", folder / "plan.png"], check=True)

    def compared(cut):
        answer = subprocess.run([python, "-W", "ignore", "-c", COMPARE, scan.with_suffix(".truth.npz"), heights, str(cut)],
                                check=True, capture_output=True, text=True)
        count, there, median, spacing = json.loads(answer.stdout)
        print(f"{count} places, {100 * there:.1f} % with a height; off by {1000 * median:.2f} mm in the median, spacing {1000 * spacing:.1f} mm")
        return there, median, spacing

    there, median, spacing = compared(CUT)
    assert there > 0.95 and median <= spacing / 4
    # The comparison fails where it should: a raster that lies too high.
    subprocess.run([python, "-W", "ignore", "-c", "import rasterio, sys\n"
                    "with rasterio.open(sys.argv[1], 'r+') as file: file.write(file.read(1) + float(sys.argv[2]), 1)",
                    heights, str(spacing / 3)], check=True)
    assert compared(CUT)[1] > spacing / 4, "a third of the spacing was not noticed"


main()
