"""Pictures: arrays without copies, files, threads, interrupts."""

import copy
import inspect
import os
import pathlib
import pickle
import signal
import struct
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import zlib

import numpy as np
import splatray as sr
from shapes import plane, sphere


def png_size(data):
    """Width and height of a PNG, whose first chunk's checksum is looked at."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n" and zlib.crc32(data[12:29]) == struct.unpack(">I", data[29:33])[0]
    return struct.unpack(">II", data[16:24])


class Pictures(unittest.TestCase):
    def setUp(self):
        self.points, self.normals = sphere()
        self.scene = sr.points(self.points, normals=self.normals, name="ball")

    def test_make_writes_what_made_it_inside(self):
        with tempfile.TemporaryDirectory() as folder:
            still, turn, page, plan = (os.path.join(folder, name) for name in ("a.png", "t.##.png", "a.html", "plan.png"))
            made = self.scene.make(still, resolution=(32, 32), samples=4)
            self.assertEqual((made.files, made.choices), ([still], {"denoise": "on"}))
            asked = sr.Request.of_picture(still)
            self.assertEqual(asked.get("resolution"), ["32x32"])
            self.assertEqual(self.scene.make(turn, turntable=2, resolution=(16, 16), samples=2).files,
                             [turn.replace("##", number) for number in ("00", "01")])
            self.scene.make(page, orbit=(4, 1), resolution=(30, 30), samples=2)
            self.assertIn(b"<html", pathlib.Path(page).read_bytes())
            self.scene.make(plan, sheet="plan:scale=50,dpi=40", samples=2)
            self.assertTrue(os.path.exists(plan + ".sheet.json"))
            size = png_size(pathlib.Path(plan).read_bytes())
            drawn = self.scene.render(request=sr.Request(sheet="plan:scale=50,dpi=40", samples=2))
            self.assertEqual((drawn.width, drawn.height), size)
            with self.assertRaisesRegex(ValueError, "expected one picture; make"):
                self.scene.render(request=sr.Request(turntable=3, output="a.#.png"))
            with self.assertRaisesRegex(ValueError, "expected one of them"):
                self.scene.make(turn, sheet="plan", turntable=3)

    def test_five_lines(self):
        image = self.scene.render(sr.frame(self.scene, azimuth=30, fov=35), (160, 90), samples=4)
        with tempfile.TemporaryDirectory() as folder:
            for name in ("a.png", "a.exr"):
                image.save(pathlib.Path(folder) / name)
                self.assertGreater(os.path.getsize(os.path.join(folder, name)), 500)
        a = image.pixels
        self.assertEqual((a.dtype, a.shape), (np.float32, (90, 160, 4)))
        self.assertEqual(png_size(image._repr_png_()), (160, 90))
        hits = self.scene.trace([[3.0, 0.0, 0.0]], [[-1.0, 0.0, 0.0]])
        self.assertAlmostEqual(hits.t[0], 2.0, delta=1e-3)

    def test_the_cpu_without_vulkan(self):
        program = (
            "import numpy as np, splatray as sr\n"
            "from shapes import sphere\n"
            "points, normals = sphere()\n"
            "scene = sr.points(points, normals=normals, device='cpu')\n"
            "np.save('pixels.npy', scene.render(sr.frame(scene, azimuth=30, fov=35), (160, 90), samples=4).pixels)\n"
            "np.save('t.npy', scene.trace([[3.0, 0.0, 0.0]], [[-1.0, 0.0, 0.0]]).t)\n")
        with tempfile.TemporaryDirectory() as folder:
            tests = os.path.dirname(os.path.abspath(__file__))
            environment = os.environ | {"VK_DRIVER_FILES": "/nonexistent.json", "VK_ICD_FILENAMES": "/nonexistent.json",
                                        "PYTHONPATH": os.pathsep.join([tests, os.environ.get("PYTHONPATH", "")])}
            subprocess.run([sys.executable, "-c", program], cwd=folder, env=environment, check=True)
            pixels, t = np.load(os.path.join(folder, "pixels.npy")), np.load(os.path.join(folder, "t.npy"))
        image = self.scene.render(sr.frame(self.scene, azimuth=30, fov=35), (160, 90), samples=4)
        self.assertLess(np.abs(pixels - image.pixels).mean(), 1e-4)
        self.assertEqual(t[0], self.scene.trace([[3.0, 0.0, 0.0]], [[-1.0, 0.0, 0.0]]).t[0])

    def test_pixels_are_views(self):
        image = self.scene.render(size=(32, 18), samples=1, aov="depth,normal,id")
        self.assertTrue(np.shares_memory(image.pixels, image.pixels))
        self.assertTrue(np.shares_memory(np.asarray(image), image.pixels))
        kept = image.pixels
        copy = kept.copy()
        del image
        np.testing.assert_array_equal(kept, copy)

    def test_requests_say_what_arguments_say(self):
        fields = dict(samples=2, environment="black", lights=[sr.sun((0, 0, 1)), sr.point_light((0, 0, 3), 5.0)], bounces=3)
        request = sr.Request(resolution=(32, 18), **fields)
        pixels = self.scene.render(size=(32, 18), **fields).pixels
        for again in (request, pickle.loads(pickle.dumps(request)), sr.Request.from_json(request.json()), copy.deepcopy(request)):
            self.assertEqual(again, request)
            np.testing.assert_array_equal(self.scene.render(request=again).pixels, pixels)
        self.assertEqual(request.replace(samples=5).get("samples"), ["5"])
        self.assertEqual(request.get("samples"), ["2"])
        self.assertGreater(np.abs(pixels - self.scene.render(request=request, environment="white").pixels).max(), 0.01)
        rough = sr.Material(mirror=1.0, roughness=0.9)
        self.assertGreater(np.abs(self.scene.render(size=(32, 18), materials={"ball": sr.Material(mirror=1.0)}).pixels
                                  - self.scene.render(size=(32, 18), materials={"ball": rough}).pixels).max(), 0.01)

    def test_every_field_is_in_a_signature(self):
        parameters = {name for call in (sr.open, sr.points, sr.Scene.render) for name in inspect.signature(call).parameters}
        from splatray._table import FIELDS, LIGHTS
        for name, field in FIELDS.items():
            if field.group == "Output" or name in LIGHTS or name in ("inputs", "resolution"):
                continue  # of files, or there under another name: lights, files, size
            self.assertIn(name, parameters)
            self.assertTrue(any(f"{name}: " in call.__doc__ for call in (sr.open, sr.Scene.render)), name)

    def test_pictures_are_pickled_and_copied(self):
        for channels in ("", "depth,normal,id"):
            image = self.scene.render(size=(32, 18), samples=1, aov=channels)
            for again in (pickle.loads(pickle.dumps(image)), copy.deepcopy(image)):
                for name in ("pixels", "depth", "normal", "object"):
                    np.testing.assert_array_equal(getattr(again, name), getattr(image, name))
                self.assertEqual(again.png(), image.png())
                self.assertFalse(np.shares_memory(again.pixels, image.pixels))

    def test_channels_agree_with_the_sphere(self):
        camera = sr.Camera((4.0, 0.0, 0.0), (0.0, 0.0, 0.0), fov=40)
        image = self.scene.render(camera, (64, 64), samples=1, aov="depth,normal,id")
        self.assertIsNone(self.scene.render(camera, (8, 8), samples=1).depth)
        hit = image.object == 0
        self.assertTrue(np.isinf(image.depth[~hit]).all() and (image.object[~hit] == -1).all())
        # Pixel centres, away from the rim: depth and normal of the unit sphere.
        step = 2 * np.tan(np.radians(20)) / 64
        u, v = np.meshgrid((np.arange(64) - 31.5) * step, (31.5 - np.arange(64)) * step)
        direction = np.stack([-np.ones_like(u), u, v], axis=2)
        direction /= np.linalg.norm(direction, axis=2, keepdims=True)
        b = direction[..., 0] * 4.0
        inside = b * b - 15.0 > 0.1
        expected = -b[inside] - np.sqrt(b[inside] ** 2 - 15.0)
        self.assertTrue(hit[inside].all())
        self.assertLess(np.abs(image.depth[inside] - expected).max(), 2e-3)
        normal = np.array([4.0, 0.0, 0.0]) + expected[:, None] * direction[inside]
        self.assertLess(np.abs(image.normal[inside] - normal).max(), 0.02)
        self.assertGreater(np.abs(image.depth[inside] - expected - 0.01).max(), 2e-3)  # a centimetre off is found

    def test_look(self):
        size = (48, 27)
        plain = self.scene.render(size=size).pixels
        gold = self.scene.render(size=size, materials={"ball": sr.material("gold")}).pixels
        lit = self.scene.render(size=size, lights=[sr.point_light((0, 0, 3), 20.0), sr.sun((1, 0, 0))], environment="black").pixels
        dark = self.scene.render(size=size, lights=[], environment="black").pixels
        self.assertEqual(dark[..., :3].max(), 0.0)
        for look in ("paper", "clay", "ao", "scan"):
            other = self.scene.render(size=size, look=look).pixels
            self.assertTrue(np.isfinite(other).all() and np.abs(other - plain).max() > 0.02, look)
        for a, b in ((plain, gold), (plain, lit), (gold, lit)):
            self.assertGreater(np.abs(a - b).max(), 0.05)
        np.testing.assert_array_equal(plain, self.scene.render(size=size).pixels)

    def test_colors_of_bytes_are_srgb(self):
        points, normals = plane()
        camera = sr.Camera((0, 0, 5), (0, 0, 0), up=(0, 1, 0), fov=10)
        pictures = [sr.points(points, normals=normals, colors=np.full(points.shape, value, dtype)).render(camera, (8, 8), samples=1).pixels
                    for value, dtype in ((188, np.uint8), (0.5028864, np.float32), (0.5, np.float32))]
        self.assertLess(np.abs(pictures[0] - pictures[1]).max(), 0.01)
        self.assertGreater(np.abs(pictures[1] - 2 * pictures[2]).max(), 0.01)

    def test_scene_file_and_text_file(self):
        with tempfile.TemporaryDirectory() as folder:
            self.scene.save(os.path.join(folder, "a.soct"))
            again = sr.open(os.path.join(folder, "a.soct"))
            np.testing.assert_array_equal(again.render(size=(32, 18)).pixels, self.scene.render(size=(32, 18)).pixels)
            np.savetxt(os.path.join(folder, "a.xyz"), self.points)
            self.assertAlmostEqual(len(sr.open([pathlib.Path(folder) / "a.xyz"])), 20000, delta=20)

    def test_threads(self):
        pictures = [None] * 4

        def work(i):
            scene = self.scene if i % 2 else sr.points(self.points, normals=self.normals)
            pictures[i] = scene.render(size=(64, 36), samples=4).pixels
            scene.trace(np.full((1000, 3), 3.0), -np.ones(3))

        threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for picture in pictures:
            np.testing.assert_array_equal(picture, pictures[0])

    def test_close_while_rendering(self):
        scene = sr.points(self.points, normals=self.normals)
        thread = threading.Thread(target=lambda: scene.render(size=(320, 180), samples=16))
        thread.start()
        time.sleep(0.2)
        scene.close()
        with self.assertRaises(ValueError):
            scene.render()
        thread.join()

    def test_other_threads_run_meanwhile(self):
        counted = []
        thread = threading.Thread(target=lambda: self.scene.render(size=(640, 360), samples=64))
        thread.start()
        while thread.is_alive():
            counted.append(time.monotonic())
            time.sleep(0.005)
        self.assertGreater(len(counted), 10)
        self.assertLess(max(np.diff(counted)), 1.0)

    def test_progress(self):
        heard = []
        self.scene.render(size=(64, 36), progress=lambda stage, share: heard.append((stage, share)))
        self.assertEqual(heard[-1], ("tracing", 1.0))
        sr.points(self.points, progress=lambda stage, share: heard.append((stage, share)))
        self.assertIn("normals", {stage for stage, _ in heard})
        with self.assertRaises(sr.Cancelled):
            self.scene.render(size=(64, 36), progress=lambda *_: False)
        with self.assertRaisesRegex(KeyError, "mine"):
            self.scene.render(size=(64, 36), progress=lambda *_: {}["mine"])
        with self.assertRaises(sr.Cancelled):
            sr.points(self.points, progress=lambda *_: False)

    def test_control_c(self):
        program = ("import splatray as sr, numpy as np, sys\n"
                   "scene = sr.points(np.random.default_rng(1).random((1000, 3)))\n"
                   "scene.device; print('ready', flush=True)\n"
                   "try:\n    scene.render(size=(1920, 1080), samples=65536)\n"
                   "except KeyboardInterrupt:\n    print('ended'); sys.exit(7)\n")
        child = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True)
        self.assertEqual(child.stdout.readline(), "ready\n")
        time.sleep(1.5)
        child.send_signal(signal.SIGINT)
        self.assertEqual((child.communicate(timeout=30)[0], child.returncode), ("ended\n", 7))


class WithoutVulkan(unittest.TestCase):
    def test_renders_on_the_host_and_says_what_to_install(self):
        program = ("import splatray as sr, numpy as np\nscene = sr.points(np.eye(3))\nassert sr.devices() == []\n"
                   "print(scene.render(size=(16, 9)).pixels.shape, scene.device)\n"
                   "try:\n    sr.points(np.eye(3), device='0').render()\nexcept sr.NoDeviceError as error:\n    print(error)\n")
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "libvulkan.so.1").write_text("no library")
            done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, env=os.environ | {"LD_LIBRARY_PATH": folder})
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertRegex(done.stdout, "(?s)host's CPU.*libvulkan1 and mesa-vulkan-drivers")


if __name__ == "__main__":
    unittest.main()
