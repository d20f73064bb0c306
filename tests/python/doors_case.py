"""One request through splatray-render and through Python: the same pixels, choices and metadata. SPLATRAY_RENDER: the program."""

import os
import pathlib
import struct
import subprocess
import tempfile
import unittest
import zlib

import numpy as np
import splatray as sr
from shapes import sphere

RENDER = os.environ.get("SPLATRAY_RENDER")
OF_THE_DOOR = {"command_line", "commit"}  # who wrote it, by what, of which build
SMALL = ("--resolution=24x16", "--samples=4")
CUBE = (*SMALL, "--mesh-points=2000")


def box_pcd():
    """The inside of a box of 4 x 5 x 3, seen from its middle, as a sensor there saw it."""
    steps = (np.arange(24) + 0.5) / 24 * 2 - 1
    u, v = (grid.ravel() for grid in np.meshgrid(steps, steps))
    sides = []
    for axis in range(3):
        for end in (-1.0, 1.0):
            place = np.empty((u.size, 3))
            place[:, axis], place[:, (axis + 1) % 3], place[:, (axis + 2) % 3] = end, u, v
            sides.append(place * (2.0, 2.5, 1.5))
    points = np.concatenate(sides)
    head = ("VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n"
            f"WIDTH {len(points)}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {len(points)}\nDATA ascii\n")
    return head + "".join(f"{x:.6f} {y:.6f} {z:.6f}\n" for x, y, z in points)


def cube_obj():
    corners = "".join(f"v {i & 1} {i >> 1 & 1} {i >> 2 & 1}\n" for i in range(8))
    return corners + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n"


def ball_ply():
    points, normals = sphere()
    rows = "".join(" ".join(f"{value:.6f}" for value in row) + "\n" for row in np.hstack([points, normals]))
    names = "".join(f"property float {name}\n" for name in ("x", "y", "z", "nx", "ny", "nz"))
    return f"ply\nformat ascii 1.0\nelement vertex {len(points)}\n{names}end_header\n{rows}"


def png_parts(path):
    """The pixels of a PNG as they are stored, and its texts."""
    data, at, pixels, texts = path.read_bytes(), 8, b"", {}
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        pixels += body if kind == b"IDAT" else b""
        if kind in (b"tEXt", b"iTXt", b"zTXt"):
            name, text = body.split(b"\0", 1)
            texts[name.decode().removeprefix("splatray.")] = text
        at += size + 12
    return zlib.decompress(pixels), {name: text for name, text in texts.items() if name not in OF_THE_DOOR}


@unittest.skipUnless(RENDER, "SPLATRAY_RENDER names no program")
class Doors(unittest.TestCase):
    def same(self, scene, text, *options):
        with tempfile.TemporaryDirectory() as folder:
            source, made, other = (pathlib.Path(folder) / name for name in (scene, "made.png", "other.png"))
            source.write_text(text)
            asked = pathlib.Path(folder) / "asked.json"
            words = [RENDER, "--quiet", source, "--device=cpu", "-o", made, *options]
            subprocess.run(words, check=True)
            subprocess.run([*words, "--save-request", asked], check=True)
            request = sr.Request.from_json(asked.read_text())
            done = sr.open(source, request=request).make(other, request=request)
            self.assertEqual(done.files, [str(other)])
            (pixels, texts), (other_pixels, other_texts) = png_parts(made), png_parts(other)
            self.assertEqual(pixels, other_pixels, options)
            self.assertEqual(texts, other_texts, options)

    def test_scans(self):
        for options in (SMALL, (*SMALL, "--keep-noise", "--view=dollhouse"), (*SMALL, "--keep-box=-1,-1,-2,1,1,2", "--look=ao"),
                        ("--samples=4", "--sheet=plan:z=0.5,scale=100,dpi=40")):
            self.same("room.pcd", box_pcd(), *options)

    def test_meshes(self):
        area = "--area-light=0,3,3,0,0,0,1,1"
        for options in (CUBE, (*CUBE, "--material=glass", "--environment=sky:30,120"), (*CUBE, area), (*CUBE, area, "--look=paper"),
                        (*CUBE, "--eye=0.5,0.5,0.9", "--target=0.5,0.5,0"),
                        (*CUBE, "--light=spot:at=0.5,3,0.5,to=0.5,0,0.5,cone=12,range=9")):
            self.same("cube.obj", cube_obj(), *options)

    def test_points_with_normals(self):
        self.same("ball.ply", ball_ply(), *SMALL, "--despeckle", "--exposure=auto")

    def test_another_request_is_noticed(self):
        with self.assertRaises(AssertionError):
            with tempfile.TemporaryDirectory() as folder:
                folder = pathlib.Path(folder)
                (folder / "cube.obj").write_text(cube_obj())
                scene = sr.open(folder / "cube.obj", device="cpu", mesh_points=2000)
                for name, samples in (("a.png", 2), ("b.png", 3)):
                    scene.make(folder / name, resolution=(24, 16), samples=samples)
                self.assertEqual(png_parts(folder / "a.png"), png_parts(folder / "b.png"))


if __name__ == "__main__":
    unittest.main()
