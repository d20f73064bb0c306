"""Measures against closed forms, and what is refused."""

import unittest

import numpy as np
import splatray as sr
from shapes import plane, sphere

CENTER = (431250.0, 5412360.0, 217.0)
IN = (1.0, 0.0, 0.0)


class Measures(unittest.TestCase):
    def setUp(self):
        points, normals = sphere(40000, CENTER)
        self.scene = sr.points(points, normals=normals)
        self.near, self.west, self.east, self.far = (np.add(CENTER, np.multiply(side, IN)) for side in (-2.0, -1.0, 1.0, 2.0))

    def check(self, kind, places, name, expected, bound=2e-4, **options):
        found = self.scene.measure(kind, places, **options).values[name]
        self.assertLess(abs(found.value - expected), bound)
        self.assertLess(found.within, 20 * bound)
        return found

    def test_closed_forms(self):
        through = [(self.near, IN), (self.far, np.negative(IN))]
        self.assertEqual(self.check("distance", through, "distance", 2.0).unit, "length")
        self.check("distance", [self.west, self.east], "distance", 2.0)
        ends = [np.add(CENTER, (0, 0, -1)), np.add(CENTER, (0, 0, 1))]
        self.check("vertical", ends, "vertical", 2.0)
        self.check("height", ends, "vertical", 2.0)  # its old name
        self.check("horizontal", ends, "horizontal", 0.0)
        corners = [np.add(CENTER, corner) for corner in ((1, 0, 0), (0, 1, 0), (-1, 0, 0), (0, -1, 0))]
        self.assertEqual(self.check("area", corners, "area", 2.0, 1e-3).unit, "area")
        # The nearest place of the discs may be the rim of one, a radius aside.
        aside = self.scene.splats.radius.max()
        self.assertEqual(self.check("angle", corners[:3], "angle", 90.0, np.degrees(aside)).unit, "degrees")
        self.check("sphere", [self.west], "radius", 1.0, reach=0.8)
        point = self.scene.measure("point", [self.west])
        self.assertLess(np.linalg.norm(point.points[0] - np.subtract(CENTER, IN)), aside)
        self.assertAlmostEqual(np.linalg.norm(point.points[0] - CENTER), 1.0, delta=2e-4)
        self.assertEqual(point.points.shape, (1, 3))

    def test_places_far_from_every_surface_are_refused(self):
        for kind, places in (("point", [self.near]), ("distance", [self.west, CENTER]), ("height", [self.west, self.far])):
            with self.assertRaisesRegex(RuntimeError, "lies 1 from the nearest surface"):
                self.scene.measure(kind, places)
        self.assertAlmostEqual(self.scene.measure("sphere", [CENTER], reach=1.1).values["radius"].value, 1.0, delta=2e-4)

    def test_a_region_is_measured(self):
        half = sr.Request(cut=[(*CENTER, 1.0, 0.0, 0.0)])
        back = np.add(CENTER, (0.5, 0.0, 0.0))
        self.check("distance", [(self.near, IN), (back, IN)], "distance", 0.0, request=half)

    def test_what_makes_no_sense_is_refused(self):
        for kind, places, reach in (("length", [self.near, self.far], 0), ("distance", [self.near], 0), ("sphere", [self.near], 0),
                                    ("angle", [self.near] * 4, 0), ("point", [(1, 2)], 0), ("point", ["abc"], 0),
                                    ("point", [(np.nan, 0, 0)], 0), ("point", [(self.near, (0, 0, 0))], 0)):
            with self.assertRaises(ValueError):
                self.scene.measure(kind, places, reach=reach)
        with self.assertRaises(TypeError):
            self.scene.measure("point", 3)
        nothing = sr.Request(keep_box="0,0,0,1,1,1")
        for request, place in ((nothing, self.west), (None, (self.near, (0, 0, 1)))):
            with self.assertRaises(RuntimeError):
                self.scene.measure("point", [place], request=request)
        flat = sr.points(*plane()[:1], normals=plane()[1])
        with self.assertRaises(RuntimeError):
            flat.measure("sphere", [(0, 0, 0)], reach=1.0)
