#!/usr/bin/env python3
"""dxf_test.py RENDER MEASURE FOLDER: a plan and measures as DXF, as ezdxf reads them: layers, units, closed polylines, circles where they
were measured. Exit 77: skipped."""
import itertools
import json
import math
import pathlib
import subprocess
import sys

from pypi_python import EZDXF, pypi_python

render, measure, folder = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
LOW, HIGH = (1000.0, 2000.0, 100.0), (1002.0, 2001.0, 101.2)
BALL, RADIUS = (1005.0, 2000.5, 100.5), 0.4
# Boards of 0.5 x 0.4 below the cut and above it: corner and height.
BOARD_BELOW, BOARD_ABOVE, BOARD = (1000.3, 2000.3, 100.3), (1001.2, 2000.3, 101.0), (0.5, 0.4)

READ = """
import json, sys
import ezdxf
from ezdxf.lldxf.encoding import decode_dxf_unicode
drawing = ezdxf.readfile(sys.argv[1])
problems = drawing.audit()
space = drawing.modelspace()
print(json.dumps({
    "errors": [error.message for error in problems.errors + problems.fixes], "units": drawing.units,
    "layers": [layer.dxf.name for layer in drawing.layers],
    "hatch": [[list(line.dxf.start), list(line.dxf.end)] for line in space.query("LINE") if line.dxf.layer == "HATCH"],
    "polylines": [[line.dxf.layer, line.closed, [list(point[:2]) for point in line.get_points()]] for line in space.query("LWPOLYLINE")],
    "texts": [[text.dxf.layer, decode_dxf_unicode(text.dxf.text)] for text in space.query("TEXT")],
    "circles": [[list(circle.ocs().to_wcs(circle.dxf.center)), circle.dxf.radius] for circle in space.query("CIRCLE")]}))
"""


def write_points(path):
    """Points on the sides of a box, on boards in it, and on a ball beside it."""
    golden = math.pi * (3 - math.sqrt(5))
    with open(path, "w") as file:
        for axis in range(3):
            a, b = (axis + 1) % 3, (axis + 2) % 3
            counts = [round((HIGH[n] - LOW[n]) / 0.02) for n in (a, b)]
            for side, i, j in itertools.product((LOW, HIGH), range(counts[0]), range(counts[1])):
                p = list(side)
                for n, step, count in ((a, i, counts[0]), (b, j, counts[1])):
                    p[n] = LOW[n] + (HIGH[n] - LOW[n]) * (step + 0.5) / count
                file.write(" ".join(f"{v:.5f}" for v in p) + "\n")
        for board in BOARD_BELOW, BOARD_ABOVE:
            for i, j in itertools.product(range(50), range(40)):
                file.write(f"{board[0] + 0.01 * (i + 0.5):.5f} {board[1] + 0.01 * (j + 0.5):.5f} {board[2]:.5f}\n")
        for i in range(8000):
            z = 1 - (2 * i + 1) / 8000
            r = math.sqrt(1 - z * z)
            file.write(" ".join(f"{c + RADIUS * d:.5f}" for c, d in zip(BALL, (r * math.cos(golden * i), r * math.sin(golden * i), z))) + "\n")


def read(python, path):
    found = json.loads(subprocess.run([python, "-W", "ignore", "-c", READ, path], check=True, capture_output=True, text=True).stdout)
    assert not found["errors"], found["errors"]
    return found


def area(points):
    return 0.5 * sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(points, points[1:] + points[:1]))


def main():
    folder.mkdir(parents=True, exist_ok=True)
    python = pypi_python(folder.parent / "ezdxf", *EZDXF)
    points, measures = folder / "points.xyz", folder / "measures.geojson"
    write_points(points)
    ball = ",".join(map(str, (BALL[0], BALL[1], BALL[2] + RADIUS)))
    subprocess.run([measure, points, "-o", measures, "--sphere", f"{ball};0.5", "--distance", "1000.2,2000,100.6;1001.8,2000,100.6"], check=True)
    plan = folder / "plan.dxf"
    subprocess.run([render, "--quiet", points, "-o", plan, "--up", "0,0,1", "--sheet", "plan:z=100.6,unit=m", "--title", "Haus \u00c4 \u2300",
                    "--measures", measures], check=True)
    found = read(python, plan)
    assert found["units"] == 6, "metres"
    assert {"CUT", "HATCH", "BEYOND", "HIDDEN", "CONTOURS", "LEVELS", "MEASURES", "TEXT"} <= set(found["layers"])
    cut = sorted((abs(area([[x - LOW[0], y - LOW[1]] for x, y in line])), closed) for layer, closed, line in found["polylines"] if layer == "CUT")
    print("areas of what is cut:", cut)
    assert len(cut) == 2 and all(closed for _, closed in cut), cut
    assert abs(cut[1][0] - 2.0) < 0.01 and abs(cut[0][0] - math.pi * (RADIUS ** 2 - 0.1 ** 2)) < 0.005, cut
    for layer, board in ("BEYOND", BOARD_BELOW), ("HIDDEN", BOARD_ABOVE):
        (closed, points_of_line), = [(closed, line) for name, closed, line in found["polylines"] if name == layer]
        around = area([[x - board[0], y - board[1]] for x, y in points_of_line])
        print(f"{layer}: {len(points_of_line)} corners around {abs(around):.4f}")
        # Of the points 0.49 x 0.39; discs may reach over them by up to their radius.
        assert closed and len(points_of_line) <= 8 and 0.185 < abs(around) < 0.215, points_of_line
    print("lines of the hatch:", len(found["hatch"]))
    assert len(found["hatch"]) > 20 and all(0 < math.dist(*line) < 1.5 for line in found["hatch"])
    assert ["TEXT", "Haus \u00c4 \u2300"] in found["texts"] and ["TEXT", "1 : 50"] in found["texts"], found["texts"]
    assert any(layer == "MEASURES" for layer, _, _ in found["polylines"])

    # An atlas of its one floor, cut over the boards, and views side by side.
    sheets = {"atlas": "atlas:above=1.1,unit=m", "views": "plan:z=100.6,unit=m;section:1000,2000.5,1002,2000.5;elevation:south"}
    for name, sheet in sheets.items():
        subprocess.run([render, "--quiet", points, "-o", folder / f"{name}.dxf", "--up", "0,0,1", "--sheet", sheet], check=True)
    atlas, views = (read(python, folder / f"{name}.dxf") for name in sheets)
    (floor,) = [abs(area([[x - LOW[0], y - LOW[1]] for x, y in line])) for layer, closed, line in atlas["polylines"] if layer == "FLOOR1-CUT"]
    print(f"area of the floor's cut: {floor:.4f}")
    assert abs(floor - 2.0) < 0.01 and not [layer for layer in atlas["layers"] if layer.startswith("FLOOR2")]
    assert any(layer == "FLOOR1-TEXT" and text.startswith("Floor at height 100.00") for layer, text in atlas["texts"]), atlas["texts"]
    areas = sorted(abs(area([[x - LOW[0], y - LOW[1]] for x, y in line])) for layer, closed, line in views["polylines"] if layer == "CUT" and closed)
    print("areas of the views' cuts:", areas)
    assert len(areas) == 3 and abs(areas[1] - 2.0) < 0.01 and abs(areas[2] - 2.4) < 0.015, "plan 2 x 1, section 2 x 1.2, ball"
    for caption in "1  Plan", "2  Section", "3  Elevation":
        assert any(text.startswith(caption) for _, text in views["texts"]), views["texts"]

    dxf = folder / "measures.dxf"
    subprocess.run([measure, points, "-o", dxf, "--sphere", f"{ball};0.5"], check=True)
    (center, radius), = read(python, dxf)["circles"]
    assert math.dist(center, BALL) < 0.005 and abs(radius - RADIUS) < 0.005, (center, radius)


main()
