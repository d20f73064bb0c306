#!/usr/bin/env python3
"""spheres_test.py RENDER FOLDER: 64 small spheres (with SPLATRAY_TEST_ALL 1024) of known places in UTM coordinates are found again, by rasterio, in sheets as PNG
with world file and as GeoTIFF, whole and in tiles, in metres and feet: within 0.1 pixel and 1 mm. Heights, too. Exit 77: skipped."""
import math
import os
import pathlib
import random
import struct
import subprocess
import sys

from pypi_python import RASTERIO, pypi_python

render, folder = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
ACROSS = 32 if "SPLATRAY_TEST_ALL" in os.environ else 8
SPHERES, RADIUS, STEP, POINTS = ACROSS * ACROSS, 0.055, 0.25, 300
ORIGIN = (431250.0, 5412360.0, 217.0)
SHEET = "scale=50,dpi=150"
PIXEL = 25.4 / 150 * 50 / 1000


def centers():
    """Spheres of a grid, each moved by chance, none over another."""
    chance = random.Random(3)
    return [tuple(o + STEP * (i + 0.5) + chance.uniform(-0.5, 0.5) * (STEP - 2.6 * RADIUS)
                  for o, i in zip(ORIGIN, (n % ACROSS, n // ACROSS))) + (ORIGIN[2] + chance.uniform(0, 2),)
            for n in range(SPHERES)]


def write_ply(path, places, unit):
    """Points of a Fibonacci lattice on each sphere, with normals and radii, lengths of `unit` metres."""
    golden = math.pi * (3 - math.sqrt(5))
    lattice = []
    for i in range(POINTS):
        z = 1 - (2 * i + 1) / POINTS
        r = math.sqrt(1 - z * z)
        lattice.append((r * math.cos(golden * i), r * math.sin(golden * i), z))
    with open(path, "wb") as file:
        names = "".join(f"property {kind} {name}\n" for kind, name in
                        [("double", n) for n in "xyz"] + [("float", n) for n in ("nx", "ny", "nz")])
        file.write(f"ply\nformat binary_little_endian 1.0\nelement vertex {len(places) * POINTS}\n{names}end_header\n".encode())
        for center in places:
            for n in lattice:
                file.write(struct.pack("<3d3f", *((c + RADIUS * d) / unit for c, d in zip(center, n)), *n))


def run(*arguments):
    subprocess.run([render, "--quiet", "--samples", "16", "--keep-noise", "--look", "ao", *arguments], check=True)


FIND = """
import json, sys
import numpy, rasterio
places, radius, unit, files = json.loads(sys.argv[1]), float(sys.argv[2]), float(sys.argv[3]), sys.argv[4:]
worst_pixel = worst_metre = worst_height = 0.0
found = 0
for n, (x, y, z) in enumerate(places):
    weight, at, tops = 0.0, numpy.zeros(2), []
    for name in files:
        with rasterio.open(name) as file:
            inverse = ~file.transform
            column, row = inverse * (x / unit, y / unit)
            reach = radius / unit / file.transform.a * 1.2 + 1
            window = ((max(int(row - reach), 0), min(int(row + reach) + 2, file.height)),
                      (max(int(column - reach), 0), min(int(column + reach) + 2, file.width)))
            if window[0][0] >= window[0][1] or window[1][0] >= window[1][1]:
                continue
            values = file.read(file.count, window=window).astype(float)
            if file.dtypes[0] == "float32":
                if numpy.isfinite(values).any():
                    tops.append(numpy.nanmax(values))
                continue
            rows, columns = numpy.mgrid[window[0][0]:window[0][1], window[1][0]:window[1][1]]
            weight += values.sum()
            at += numpy.array([((columns + 0.5) * file.transform.a + file.transform.c).__mul__(values).sum(),
                               ((rows + 0.5) * file.transform.e + file.transform.f).__mul__(values).sum()])
            pixel = file.transform.a
    if tops:
        worst_height = max(worst_height, abs(max(tops) * unit - (z + radius)))
        found += 1
    if weight > 0:
        off = numpy.abs(at / weight - (x / unit, y / unit)).max()
        worst_pixel, worst_metre = max(worst_pixel, off / pixel), max(worst_metre, off * unit)
        found += 1
print(json.dumps([found, worst_pixel, worst_metre, worst_height]))
"""


def find(python, places, unit, files):
    import json
    answer = subprocess.run([python, "-W", "ignore", "-c", FIND, json.dumps(places), str(RADIUS), str(unit), *map(str, files)],
                            check=True, capture_output=True, text=True)
    found, pixel, metre, height = json.loads(answer.stdout)
    print(f"{len(files)} file(s), {files[0].name}: {found} found, off by at most {pixel:.3f} pixel, {1000 * metre:.2f} mm; height {1000 * height:.2f} mm")
    assert found == SPHERES, "spheres are missing"
    return pixel, metre, height


def require(pixel, metre, _):
    assert pixel <= 0.1 and metre <= 1e-3


def main():
    folder.mkdir(parents=True, exist_ok=True)
    python = pypi_python(folder.parent / "rasterio", *RASTERIO)
    places = centers()
    # The highest pixel's centre is at most half a diagonal from a sphere's top.
    fall = RADIUS - math.sqrt(RADIUS ** 2 - PIXEL ** 2 / 2)

    ply, png, heights = folder / "m.ply", folder / "m.png", folder / "m_heights.tif"
    write_ply(ply, places, 1.0)
    in_metres = ply, "--up", "0,0,1", "--sheet", f"plan:{SHEET},unit=m"
    run(*in_metres, "--height-raster", heights, "-o", png)
    require(*find(python, places, 1.0, [png]))
    assert find(python, places, 1.0, [heights])[2] <= fall + 1e-3
    tiles = [folder / f"tile{i}.tif" for i in (1, 2, 3)]
    for i, tile in enumerate(tiles):
        run(*in_metres, "--tile", f"{i + 1}/3", "-o", tile)
    require(*find(python, places, 1.0, tiles))
    # The comparison fails where it should: a world file that takes pixels' corners for their centres.
    world = png.with_suffix(".pgw")
    lines = world.read_text().split("\n")
    lines[4] = repr(float(lines[4]) - PIXEL / 2)
    world.write_text("\n".join(lines))
    assert find(python, places, 1.0, [png])[0] > 0.1, "half a pixel was not noticed"

    foot, ply, tif = 0.3048, folder / "ft.ply", folder / "ft.tif"
    write_ply(ply, places, foot)
    run(ply, "--up", "0,0,1", "--sheet", f"plan:{SHEET},unit=ft", "-o", tif)
    require(*find(python, places, foot, [tif]))


main()
