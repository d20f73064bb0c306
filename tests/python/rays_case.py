"""Ray queries against closed forms and brute force."""

import unittest

import numpy as np
import splatray as sr
from shapes import plane, sphere

BOUND = 5e-6  # 1e-6 of the plane's diagonal


class Rays(unittest.TestCase):
    def check_plane(self, center, height, expected_height, distance):
        points, normals = plane(height, center)
        scene = sr.points(points, normals=normals)
        direction = np.array([0.3, -0.2, -1.0])
        hits = scene.trace(points - distance * direction, 7.0 * direction)
        self.assertTrue((hits.object == 0).all())
        expected = (height - expected_height + distance) * np.linalg.norm(direction)
        return np.abs(hits.t - expected).max()

    def test_planes(self):
        for distance in (0.01, 3.0, 1e4):
            self.assertLess(self.check_plane((0, 0), 0.0, 0.0, distance), BOUND)
            self.assertLess(self.check_plane((5e5, 4e6), 250.0, 250.0, distance), BOUND)
        self.assertGreater(self.check_plane((0, 0), 0.0, 1e-5, 3.0), BOUND)

    def test_first_disc_is_that_of_brute_force(self):
        points, normals = sphere(3000)
        scene = sr.points(points, normals=normals)
        splats = scene.splats
        random = np.random.default_rng(7)
        origins = random.normal(size=(500, 3)) * 3.0
        directions = random.normal(size=(500, 3)) * 0.3 - origins
        hits = scene.trace(origins, directions)
        unit = directions / np.linalg.norm(directions, axis=1, keepdims=True)
        along = np.einsum("sk,rk->rs", splats.normal, unit)
        t = (np.einsum("sk,sk->s", splats.normal, splats.center) - origins @ splats.normal.T) / along
        miss = np.linalg.norm(origins[:, None] + t[..., None] * unit[:, None] - splats.center, axis=2) / splats.radius
        clear = np.abs(miss - 1.0).min(axis=1) > 1e-4  # no disc's rim is in question
        t = np.where((miss <= 1.0) & (t > 0.0), t, np.inf)
        first = t.argmin(axis=1)
        found = np.isfinite(t.min(axis=1))
        self.assertGreater(clear.sum(), 100)
        np.testing.assert_array_equal((hits.object >= 0)[clear], found[clear])
        both = clear & found
        nearest = np.sort(t, axis=1)
        sure = both & (nearest[:, 1] > nearest[:, 0] + 1e-5)
        self.assertGreater(sure.sum(), 50)
        np.testing.assert_array_equal(hits.splat[sure], first[sure])
        self.assertLess(np.linalg.norm(points[hits.point[sure]] - splats.center[hits.splat[sure]], axis=1).max(), 1e-5)
        self.assertFalse((hits.splat[sure] == np.roll(first, 1)[sure]).all())

    def test_shapes_and_types(self):
        points, normals = sphere(2000)
        scene = sr.points(points, normals=normals)
        empty = scene.trace(np.zeros((0, 3)), np.zeros((0, 3)))
        self.assertEqual([a.shape for a in empty], [(0,), (0, 3), (0,), (0,), (0,)])
        origins = np.tile([3.0, 0.1, 0.2], (10, 1))
        expected = scene.trace(origins, [-1.0, 0.0, 0.0])
        self.assertEqual([a.dtype for a in expected], [np.float64, np.float32, np.int32, np.int64, np.int64])
        for other in (np.asfortranarray(origins), np.repeat(origins, 2, axis=0)[::2], origins.tolist(), np.tile([3.0, 0.1, 0.2], (10, 2))[:, 3:]):
            for a, b in zip(scene.trace(other, [-1.0, 0.0, 0.0]), expected):
                np.testing.assert_array_equal(a, b)
        a = scene.trace(origins.astype(np.float32), np.array([[-1, 0, 0]] * 10, dtype=np.int8))
        self.assertLess(np.abs(a.t - expected.t).max(), 1e-6)
        miss = scene.trace([[0, 0, 5]], [[0, 0, 1]])
        self.assertEqual((miss.t[0], miss.object[0], miss.splat[0], miss.point[0]), (np.inf, -1, -1, -1))

    def test_ends_and_any_hit(self):
        points, normals = sphere(3000)
        scene = sr.points(points, normals=normals)
        random = np.random.default_rng(3)
        origins = random.normal(size=(4000, 3)) * 2.0
        directions = random.normal(size=(4000, 3))
        hits = scene.trace(origins, directions)
        met = scene.occluded(origins, directions)
        self.assertEqual((met.dtype, met.shape), (np.bool_, (4000,)))
        np.testing.assert_array_equal(met, hits.object >= 0)
        self.assertGreater(met.sum(), 200)
        self.assertGreater((~met).sum(), 200)
        for t_max in (0.5, random.uniform(0.0, 4.0, 4000)):
            nearer, ended = scene.occluded(origins, directions, t_max=t_max), scene.trace(origins, directions, t_max=t_max)
            np.testing.assert_array_equal(nearer, ended.object >= 0)
            sure = np.abs(hits.t - t_max) > 0.05  # t is that of the blended surface, which the first disc is near
            np.testing.assert_array_equal(nearer[sure], (hits.t < t_max)[sure])
            self.assertTrue(0 < nearer.sum() < met.sum())
            np.testing.assert_array_equal(ended.t[nearer], hits.t[nearer])
        self.assertFalse(scene.occluded(origins, directions, t_max=0.0).any())
        single = scene.trace(origins.astype(np.float32), directions.astype(np.float32))
        self.assertEqual(single.t.dtype, np.float32)
        both = np.isfinite(single.t) & np.isfinite(hits.t)
        self.assertGreater(both.mean() / met.mean(), 0.99)
        self.assertLess(np.median(np.abs(single.t - hits.t)[both]), 1e-5)
        for wrong in (-1.0, np.nan, np.ones(3), "far"):
            with self.assertRaises((ValueError, TypeError)):
                scene.occluded(origins, directions, t_max=wrong)

    def test_rows_that_are_not_finite_are_left_out(self):
        points, normals = plane()
        points[5] = np.nan
        scene = sr.points(points, normals=normals)
        self.assertEqual(len(scene), len(points) - 1)
        self.assertIn("1 point", scene.notes[0])
        hit = scene.trace(points[6] + [0, 0, 1], [0, 0, -1])
        self.assertEqual(hit.point[0], 6)


if __name__ == "__main__":
    unittest.main()
