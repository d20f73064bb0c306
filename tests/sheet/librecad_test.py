#!/usr/bin/env python3
"""librecad_test.py RENDER FOLDER: LibreCAD's dxf2pdf opens a sheet, views on a page and an atlas as DXF without a message, and draws them.
Exit 77: there is no LibreCAD (Debian's package librecad)."""
import itertools
import os
import pathlib
import shutil
import subprocess
import sys

render, folder = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
SHEETS = {"plan": "plan:z=1,scale=50,dpi=50,level=0", "views": "plan:z=1,scale=50,dpi=50;section:0,1,4,1;elevation:south",
          "atlas": "atlas:scale=50,dpi=50"}
# What Qt and LibreCAD say of any file.
USUAL = ("RS_DEBUG::setLevel", "QStandardPaths:", "Printing ", "libGL", "MESA", "This plugin does not support propagateSizeHints")


def write_room(path):
    """Points of a room of 4 x 3 x 2.5 with a board in it."""
    with open(path, "w") as file:
        for i, j in itertools.product(range(80), repeat=2):
            u, v = (i + 0.5) / 80, (j + 0.5) / 80
            for x, y, z in ((u, v, 0), (u, v, 1), (u, 0, v), (u, 1, v), (0, u, v), (1, u, v)):
                file.write(f"{4 * x:.4f} {3 * y:.4f} {2.5 * z:.4f}\n")
            file.write(f"{1 + u:.4f} {1 + 0.6 * v:.4f} 0.75\n")


def opened(dxf):
    """What LibreCAD says of a drawing beside what it says of any; its page lies beside it."""
    try:
        ran = subprocess.run(["librecad", "dxf2pdf", dxf.name], cwd=dxf.parent, capture_output=True, text=True, timeout=20,
                             env=dict(os.environ, QT_QPA_PLATFORM="offscreen"))
    except subprocess.TimeoutExpired:  # a message waits for its button
        return ["a message"]
    said = [line for line in (ran.stdout + ran.stderr).splitlines() if line and not line.startswith(USUAL)]
    return said + ([f"exit {ran.returncode}"] if ran.returncode else [])


def main():
    if not shutil.which("librecad"):
        print("skipped: there is no LibreCAD (Debian's package librecad)")
        sys.exit(77)
    folder.mkdir(parents=True, exist_ok=True)
    write_room(folder / "room.xyz")
    for name, sheet in SHEETS.items():
        dxf, pdf = folder / f"{name}.dxf", folder / f"{name}.pdf"
        pdf.unlink(missing_ok=True)
        subprocess.run([render, "--quiet", folder / "room.xyz", "-o", dxf, "--up", "0,0,1", "--sheet", sheet, "--title", "Haus \u00c4"], check=True)
        assert opened(dxf) == [], (name, opened(dxf))
        assert pdf.stat().st_size > 2000, f"{pdf} is empty"
    # The check fails where it should.
    (folder / "broken.dxf").write_bytes(dxf.read_bytes()[:3000])
    assert opened(folder / "broken.dxf"), "a drawing that breaks off was opened without a message"


main()
