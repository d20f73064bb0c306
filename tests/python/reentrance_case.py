"""Scenes used by progress functions and by forked processes; Ctrl-C while a scene waits for another's picture. A failure would be a call
that never ends: each program has a time limit."""

import os
import signal
import subprocess
import sys
import time
import unittest

START = "import gc, os, sys, threading, numpy as np, splatray as sr\nfrom shapes import sphere\npoints, normals = sphere()\n" \
        "make = lambda **names: sr.points(points, normals=normals, **names)\nscene = make()\n"


def environment():
    tests = os.path.dirname(os.path.abspath(__file__))
    return os.environ | {"PYTHONPATH": os.pathsep.join([tests, os.environ.get("PYTHONPATH", "")])}


class Reentrance(unittest.TestCase):
    def run_program(self, program):
        done = subprocess.run([sys.executable, "-c", START + program], env=environment(), capture_output=True, text=True, timeout=120)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout

    def test_progress_uses_its_own_scene(self):
        found = self.run_program(
            "for use in (lambda: scene.trace([[0, 0, 3]], [[0, 0, -1]]), lambda: scene.render(size=(9, 9))):\n"
            "    try:\n        scene.render(size=(64, 64), progress=lambda *_: use() and None)\n"
            "    except ValueError as error:\n        print(error)\n")
        self.assertEqual(found.count("progress function that uses the scene"), 2)

    def test_progress_uses_and_drops_others(self):
        found = self.run_program(
            "others = [make()]\nothers[0].render(size=(9, 9))\n"
            "def hear(stage, share):\n    others.clear()\n    make().trace([[0, 0, 3]], [[0, 0, -1]])\n    scene.close()\n    gc.collect()\n"
            "print(scene.render(size=(64, 64), progress=hear).pixels.shape)\n")
        self.assertEqual(found, "(64, 64, 4)\n")

    def test_forked_children(self):
        found = self.run_program(
            "import warnings\nwarnings.filterwarnings('ignore', 'This process .* is multi-threaded', DeprecationWarning)\n"  # since Python 3.12
            "host = make(device='cpu')\nexpected = host.render(size=(9, 9)).pixels\nscene.render(size=(9, 9))\n"
            "child = os.fork()\n"
            "if child == 0:\n"
            "    try:\n        scene.render(size=(9, 9))\n"
            "    except sr.NoDeviceError as error:\n        print(error)\n"
            "    print((host.render(size=(9, 9)).pixels == expected).all(), (make(device='cpu').render(size=(9, 9)).pixels == expected).all())\n"
            "else:\n    assert os.waitpid(child, 0)[1] == 0\n")
        self.assertRegex(found, "forked off after Vulkan was used.*\nTrue True\n")

    def test_control_c_ends_what_waits(self):
        program = START + ("def work():\n    try:\n        scene.render(size=(1920, 1080), samples=65536, progress=lambda *_: busy.set() or not stop)\n"
                           "    except sr.Cancelled:\n        pass\n"
                           "stop = []\nbusy = threading.Event()\nother = make()\nthread = threading.Thread(target=work)\nthread.start()\nbusy.wait()\n"
                           "print('ready', flush=True)\n"
                           "try:\n    other.render(size=(9, 9))\nexcept KeyboardInterrupt:\n    print('ended', flush=True)\n"
                           "stop.append(1)\nthread.join()\n")
        child = subprocess.Popen([sys.executable, "-c", program], env=environment(), stdout=subprocess.PIPE, text=True)
        self.assertEqual(child.stdout.readline(), "ready\n")
        time.sleep(1.0)
        began = time.monotonic()
        child.send_signal(signal.SIGINT)
        self.assertEqual(child.stdout.readline(), "ended\n")
        self.assertLess(time.monotonic() - began, 3.0)
        self.assertEqual((child.communicate(timeout=60)[0], child.returncode), ("", 0))


if __name__ == "__main__":
    unittest.main()
