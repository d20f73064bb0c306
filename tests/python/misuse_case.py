"""What makes no sense raises the right exception; random arguments never end the interpreter. SPLATRAY_FUZZ_SECONDS: how long, 10."""

import os
import resource
import time
import unittest

import numpy as np
import splatray as sr
from shapes import plane

NAN = float("nan")


class Misuse(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        points, normals = plane()
        cls.scene = sr.points(points, normals=normals)

    def refused(self, kind, call, *words, **names):
        with self.assertRaises(kind) as caught:
            call(*words, **names)
        self.assertGreater(len(str(caught.exception)), 10)

    def test_points(self):
        xyz = np.random.default_rng(1).random((10, 3))
        for bad in (xyz[0], xyz[:, :2], np.zeros((0, 3)), np.full((4, 3), NAN), np.full((4, 3), 1e200), np.zeros((2, 3, 3)), []):
            self.refused(ValueError, sr.points, bad)
        for bad in (None, "text", xyz.astype(complex), [[1, 2], [3]], object(), xyz.astype(str)):
            self.refused(TypeError, sr.points, bad)
        for name, bad in (("normals", xyz[:5]), ("normals", xyz.ravel()), ("colors", xyz[:, :2]), ("colors", xyz * NAN), ("radii", xyz),
                          ("radii", np.ones(3)), ("radius_scale", 0.0), ("radius_scale", NAN), ("up", (0, 0, 0)), ("up", (0, NAN, 1)),
                          ("threads", -1), ("threads", 10**9), ("up", "z")):
            self.refused(ValueError, sr.points, xyz, **{name: bad})
        for name, bad in (("normals", "a"), ("threads", 1.5), ("material", "gold"), ("progress", 3), ("name", 4)):
            self.refused(TypeError, sr.points, xyz, **{name: bad})

    def test_colors_of_other_kinds(self):
        points, normals = plane()
        for bad in (np.full(points.shape, 200), np.full(points.shape, 200.0), np.full(points.shape, 2, np.int8), np.ma.masked_less(points * 0, 1)):
            self.refused(ValueError, sr.points, points, normals=normals, colors=bad)
        for good in (np.ones(points.shape, int), np.full(points.shape, 1.001), np.zeros(points.shape, bool), np.ma.asarray(points * 0)):
            sr.points(points, normals=normals, colors=good)

    def test_masked_points_are_left_out(self):
        points, normals = plane()
        masked = np.ma.masked_where(np.repeat(np.arange(len(points))[:, None] % 10 == 0, 3, axis=1), points)
        scene = sr.points(masked, normals=normals)
        self.assertEqual(len(scene), len(points) - masked.mask[:, 0].sum())
        self.assertIn("not finite", scene.notes[0])
        self.assertEqual(len(sr.points(points, normals=np.ma.masked_less(normals, 2), radii=np.ma.masked_less(np.ones(len(points)), 2))), len(points))

    def test_more_memory_than_there_is(self):
        with open("/proc/self/status") as status:
            used = next(int(line.split()[1]) << 10 for line in status if line.startswith("VmSize:"))
        old = resource.getrlimit(resource.RLIMIT_AS)
        self.scene.render(size=(8, 8))
        resource.setrlimit(resource.RLIMIT_AS, (used + (3 << 30), old[1]))
        try:
            self.refused(MemoryError, self.scene.render, size=(32768, 32768))
        finally:
            resource.setrlimit(resource.RLIMIT_AS, old)
        self.scene.render(size=(8, 8))

    def test_files(self):
        self.refused(FileNotFoundError, sr.open, "missing.ply")
        self.refused(ValueError, sr.open, [])
        self.refused(ValueError, sr.open, __file__)
        for bad in (5, b"x", None, [5], ["a", b"x"]):
            self.refused(TypeError, sr.open, bad)
        self.refused(ValueError, sr.open, "a\0.ply")
        self.refused(ValueError, self.scene.save, "a\0.soct")
        self.refused(ValueError, self.scene.render(size=(9, 9)).save, "a\0.png")
        self.refused(OSError, self.scene.save, "/no/such/folder/a.soct")
        image = self.scene.render(size=(8, 8), samples=1)
        self.refused(OSError, image.save, "/no/such/folder/a.png")
        self.refused(ValueError, image.save, "a.gif")
        self.refused(TypeError, image.save, 3)
        image.exposure = 1000
        self.refused(ValueError, image.save, "a.png")
        image.exposure, image.tone = 0, "bright"
        self.refused(ValueError, image.save, "a.png")

    def test_render(self):
        render = self.scene.render
        for names in ({"size": (0, 5)}, {"size": (5, 40000)}, {"samples": 0}, {"samples": 2**40}, {"seed": -1}, {"bounces": 65},
                      {"environment_strength": -1}, {"environment_turn": NAN}, {"look": "nice"}, {"environment": "no.hdr"}, {"environment": "1,nan,1"},
                      {"materials": {"other": sr.Material()}}, {"materials": {"points": sr.Material(ior=-1.0)}},
                      {"lights": [sr.Light((0, 0, 1), (-1, 0, 0))]}, {"lights": [sr.Light((0, 0, 0), (1, 1, 1))]}, {"lights": [sr.sun((0, 0, 1), 1, 200)]}):
            self.refused(ValueError, render, **({"size": (8, 8)} | names))
        for names in ({"size": 5}, {"size": (5, 5.5)}, {"samples": "3"}, {"camera": (1, 2, 3)}, {"lights": [3]}, {"materials": [1]},
                      {"environment": 4}, {"progress": "x"}, {"materials": {"points": "gold"}}):
            self.refused(TypeError, render, **({"size": (8, 8)} | names))
        with self.assertRaisesRegex(TypeError, "'sample'; did you mean 'samples'"):
            render(size=(8, 8), sample=4)
        with self.assertRaisesRegex(TypeError, "found a field 'sample'; did you mean 'samples'"):
            sr.Request(sample=4)
        with self.assertRaisesRegex(TypeError, "'qqq', expected one of look,"):
            render(size=(8, 8), qqq=4)
        for camera in (sr.Camera((0, 0, 1), (0, 0, 1)), sr.Camera((0, 0, 1), (0, 0, 0)), sr.Camera((1, 0, 1), (0, 0, 0), fov=180),
                       sr.Camera((1, 0, 1), (0, 0, 0), ortho_height=-1), sr.Camera((1, 0, 1), (0, 0, 0), pixel_aspect=0),
                       sr.Camera((1, 0, 1), (0, 0, 0), lens_shift=(1000, 0))):
            self.refused(ValueError, render, camera, (8, 8))
        for eye in ((NAN, 0, 1), (1, 2)):
            self.refused(ValueError, sr.Camera, eye, (0, 0, 0))
        self.refused(ValueError, sr.frame, self.scene, elevation=100)
        self.refused(TypeError, sr.frame, self.scene, azimuth="north")
        self.refused(ValueError, sr.material, "wood")

    def test_trace(self):
        trace = self.scene.trace
        ray = np.ones((2, 3))
        for origins, directions in ((ray, np.zeros((2, 3))), (ray * NAN, ray), (ray, ray * np.inf), (ray, np.ones((3, 3))), (ray[:, :2], ray),
                                    (np.ones((2, 3, 1)), ray), (np.ones(4), ray)):
            self.refused(ValueError, trace, origins, directions)
        for origins, directions in ((ray, None), ("a", ray), (ray * 1j, ray)):
            self.refused(TypeError, trace, origins, directions)

    def test_device_and_closed_scene(self):
        self.refused(sr.NoDeviceError, lambda: sr.points(np.eye(3), device="no such device").device)
        with sr.points(np.eye(3)) as scene:
            pass
        for call in (scene.render, lambda: scene.trace(np.ones((1, 3)), np.ones((1, 3))), lambda: scene.bounds, lambda: len(scene),
                     lambda: sr.frame(scene), lambda: scene.save("a.soct"), lambda: scene.splats, lambda: scene.device):
            self.refused(ValueError, call)
        scene.close()
        self.assertIn("closed", repr(scene))
        self.refused(TypeError, sr.Scene, None)
        self.refused(TypeError, sr.Image, 3)


class Fuzz(unittest.TestCase):
    EXPECTED = (ValueError, TypeError, MemoryError)

    def array(self, random, right=0.5):
        """An array of a shape, type, layout and with values that may all be wrong; of this share the shape is one of rows of three."""
        rows = int(random.choice([0, 1, 2, 3, 17, 300]))
        shape = (rows, 3)
        if random.random() > right:
            shape = [(3,), (rows,), (rows, 4), (3, rows), (rows, 3, 1), ()][random.integers(6)]
        values = np.asarray(random.normal(size=shape)) * 10.0 ** float(random.integers(-40, 40) if random.random() < 0.3 else random.integers(-2, 3))
        if values.size and random.random() < 0.4:
            at = random.integers(0, values.size, size=3)
            np.put(values, at, random.choice([NAN, np.inf, -np.inf, 0.0, 1e300, -1e300, 5e-324, 1e38]))
        with np.errstate(all="ignore"):
            values = np.asarray(values).astype(random.choice(["f8", "f8", "f4", "f2", "i4", "u1", "?", ">f8", "c16", "O", "U3"]))
        layout = random.integers(4)
        if layout == 1:
            values = np.asfortranarray(values)
        elif layout == 2 and values.ndim:
            values = np.repeat(values, 2, axis=0)[::2][::-1]
        elif layout == 3:
            values = values.tolist()
        return values

    def test_random_arrays(self):
        seed = int(os.environ.get("SPLATRAY_FUZZ_SEED", time.time()))
        random = np.random.default_rng(seed)
        points, normals = plane()
        fixed = sr.points(points, normals=normals)
        end = time.monotonic() + float(os.environ.get("SPLATRAY_FUZZ_SECONDS", 10))
        latest = end + 120  # on a busy machine the first scenes alone take seconds
        counts = {"refused": 0, "made": 0, "traced": 0, "shown": 0}
        while time.monotonic() < end or (min(counts.values()) == 0 and time.monotonic() < latest):
            names = [name for name in ("normals", "colors", "radii") if random.random() < 0.3]
            try:
                scene = sr.points(self.array(random, 0.9), **{name: self.array(random, 0.9) for name in names})
                counts["made"] += 1
            except self.EXPECTED:
                counts["refused"] += 1
                scene = None
            traced = scene if scene and random.random() < 0.1 else fixed
            try:
                hits = traced.trace(self.array(random, 0.9), self.array(random, 0.5))
                counts["traced"] += 1
                assert not np.isnan(hits.t).any() and (hits.splat < len(traced)).all()
            except self.EXPECTED:
                pass
            if not scene or random.random() < 0.8:
                continue
            try:
                camera = sr.Camera(tuple(random.normal(size=3) * 10.0 ** random.integers(-3, 8)), tuple(scene.bounds.mean(axis=0)))
                pixels = scene.render(camera if random.random() < 0.5 else None, (int(random.integers(1, 40)), int(random.integers(1, 40))),
                                      samples=1, aov="depth,normal,id").pixels
                counts["shown"] += 1
                assert np.isfinite(pixels).all()
            except self.EXPECTED:
                pass
        print(f"seed {seed}: {counts}")
        self.assertGreater(min(counts.values()), 0, "the fuzzer reaches nothing")


if __name__ == "__main__":
    unittest.main()
