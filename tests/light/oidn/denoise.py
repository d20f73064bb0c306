"""Pictures of a ball on a floor, 16 samples, without their noise: by the Open Image Denoise of PyPI's wheel, and by the own filter.

Each must be nearer to 1024 samples than 0.7 times the noisy picture is, root of the mean square of display values. Prints the distances."""

import math
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pyoidn
from PIL import Image

PROGRAMS, FOLDER = map(Path, sys.argv[1:3])
NEARER = 0.7


def write_scene(path):
    """Points of a unit ball and of the floor below it, with normals."""
    rows = []
    for i in range(4000):  # a Fibonacci lattice
        z = 1.0 - (2 * i + 1) / 4000
        r, turn = math.sqrt(1.0 - z * z), i * math.pi * (3.0 - math.sqrt(5.0))
        x, y = r * math.cos(turn), r * math.sin(turn)
        rows.append((x, y, z, x, y, z))
    rows += [(0.1 * i - 3.0, 0.1 * j - 3.0, -1.0, 0.0, 0.0, 1.0) for i in range(61) for j in range(61)]
    names = ("x", "y", "z", "nx", "ny", "nz")
    header = ["ply", "format ascii 1.0", f"element vertex {len(rows)}", *(f"property float {n}" for n in names), "end_header"]
    path.write_text("\n".join(header + [" ".join(map(str, row)) for row in rows]) + "\n")


def picture(samples, seed, more=(), library=""):
    """Display values of a picture, and what the program says."""
    output = FOLDER / "picture.png"
    command = [PROGRAMS / "splatray-render", FOLDER / "ball.ply", "-o", output, "--look=lit", "--up=0,0,1", "--eye=3,-5,3", "--target=0,0,0"]
    command += ["--area-light=2,-1,3,0,0,0,1,1", "--resolution=96x96", f"--samples={samples}", f"--seed={seed}", *more]
    environment = os.environ | {"LD_LIBRARY_PATH": library}
    said = subprocess.run(command, check=True, env=environment, capture_output=True, text=True).stderr
    return np.asarray(Image.open(output), float)[..., :3] / 255.0, said


def distance(image, truth):
    return float(np.sqrt(((image - truth) ** 2).mean()))


write_scene(FOLDER / "ball.ply")
truth, _ = picture(1024, 99, ["--keep-noise"])
noise = distance(picture(16, 1, ["--keep-noise"])[0], truth)
library = str(next(Path(pyoidn.__file__).parent.rglob("libOpenImageDenoise.so.2")).parent)
failed = False
for name, where in (("Open Image Denoise 2", library), ("splatray's own filter", "")):
    image, said = picture(16, 1, ["--denoise"], where)
    left = distance(image, truth)
    print(f"{name}: {left:.4f} of {noise:.4f}")
    if f"denoised by {name}" not in said or not left < NEARER * noise:
        print(f"expected less than {NEARER} of it, and 'denoised by {name}' in: {said}")
        failed = True
sys.exit(1 if failed else 0)
