"""The guide's pages of rays and arrays: their code runs from top to bottom and finds what is there. The module's reference has all its names."""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import splatray as sr

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "tests/structure"))
import page_inputs  # noqa: E402  (lies in the folder just named)


class Guide(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder.name)

    def run_page(self, page, least):
        """The names that the page's code makes; of `least` blocks or more."""
        blocks = re.findall(r"```python\n(.*?)```", (ROOT / "app/guide" / page).read_text(), re.DOTALL)
        self.assertGreaterEqual(len(blocks), least)
        names = {}
        for block in blocks:
            exec(compile(block, page, "exec"), names)
        return names

    def test_arrays(self):
        names = self.run_page("arrays.md", 4)
        self.assertEqual(names["scene"].objects, ["hill", "coil"])
        u, v, w = names["u"], names["v"], names["w"]
        depth = names["photo"].depth[round(v / w), round(u / w)]
        self.assertAlmostEqual(depth, np.linalg.norm([0.5, 0.5, 0.25 * np.sin(1.5) * 0.5 - 3]), delta=0.03)
        seen = [scene.render(size=(32, 18), samples=1).pixels[..., 3].mean() for scene in (names["pressure"], names["ground"])]
        self.assertGreater(seen[0], seen[1])

    def test_rays(self):
        pathlib.Path("survey.laz").write_bytes(page_inputs.survey())
        names = self.run_page("rays.md", 6)
        # The survey is a hill of 6 m on a plain at 300 m, with a house of 5 m on it; the tower stands in its corner.
        self.assertAlmostEqual(np.nanmin(names["heights"]), 300.0, delta=0.5)
        self.assertAlmostEqual(np.nanmax(names["heights"]), 311.0, delta=0.7)
        self.assertGreater(np.isfinite(names["heights"]).mean(), 0.9)
        self.assertTrue(0.5 < names["seen"].mean() < 1.0)
        self.assertAlmostEqual(names["width"].value, 58 * 2**0.5, delta=0.5)
        self.assertTrue(abs(names["drop"].value) < names["drop"].within < 2.0)
        self.assertGreater(len(names["again"]), 1000)
        self.assertGreater(np.isfinite(names["depth"]).mean(), 0.2)
        self.assertTrue(pathlib.Path("seen.png").read_bytes().startswith(b"\x89PNG"))

    def test_reference_has_all_names(self):
        subprocess.run([ROOT / "app/package/reference", self.folder.name, sys.executable], check=True, capture_output=True)
        page = pathlib.Path("python/splatray.html").read_text()
        for name in sr.__all__:
            self.assertIn(f'name="{name}"' if isinstance(getattr(sr, name), type) else f'name="-{name}"', page)
            for member in vars(getattr(sr, name)):
                if not member.startswith("_"):
                    self.assertIn(f">{member}<", page, name)
