"""Meshes, points and their attributes as arrays, compared with files; cameras of poses; what is a value is equal and pickled as one."""

import copy
import os
import pathlib
import pickle
import tempfile
import unittest

import numpy as np
import splatray as sr
from shapes import plane


def hill(side=20):
    """A mesh of a hilly square of 2 x 2: vertices and triangles."""
    x, y = np.meshgrid(np.linspace(-1, 1, side), np.linspace(-1, 1, side))
    vertices = np.stack([x, y, 0.25 * np.sin(3 * x) * y], axis=-1).reshape(-1, 3)
    corner = (np.arange(side - 1)[:, None] * side + np.arange(side - 1)).ravel()
    return vertices, np.concatenate([np.stack([corner, corner + 1, corner + side + 1], 1), np.stack([corner, corner + side + 1, corner + side], 1)])


def write_ply(path, vertices, triangles=(), **columns):
    """Text: doubles, with further columns as floats."""
    lines = ["ply", "format ascii 1.0", f"element vertex {len(vertices)}"] + [f"property double {axis}" for axis in "xyz"]
    lines += [f"property float {name}" for name in columns]
    lines += [f"element face {len(triangles)}", "property list uchar int vertex_indices"] if len(triangles) else []
    rows = np.column_stack([vertices, *columns.values()])
    lines += ["end_header"] + [" ".join(map(repr, row)) for row in rows.tolist()] + [f"3 {a} {b} {c}" for a, b, c in np.asarray(triangles).tolist()]
    pathlib.Path(path).write_text("\n".join(lines) + "\n")


class Objects(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)

    def bytes_of(self, scene):
        scene.save("scene.soct")
        return pathlib.Path("scene.soct").read_bytes()

    def test_a_mesh_is_its_file(self):
        vertices, triangles = hill()
        write_ply("hill.ply", vertices, triangles)
        file = self.bytes_of(sr.open("hill.ply", up=(0, 0, 1), mesh_points=5000))
        # Of any type, stride and order of bytes.
        for xyz, indices in ((vertices, triangles), (np.asfortranarray(vertices.astype(">f8")), triangles.astype(np.uint16)),
                             (np.repeat(vertices, 2, axis=1)[:, ::2], np.repeat(triangles, 2, axis=0)[::2].astype(">i8")), (vertices.tolist(), triangles.tolist())):
            self.assertEqual(self.bytes_of(sr.make_scene(sr.Mesh(xyz, indices, name="hill"), mesh_points=5000)), file)
        self.assertNotEqual(self.bytes_of(sr.make_scene(sr.Mesh(vertices + 1e-3, triangles, name="hill"), mesh_points=5000)), file)

    def test_attributes_are_their_file(self):
        vertices, _ = hill(60)
        kinds = np.where(vertices[:, 0] < 0, 2, 6)
        heat = vertices[:, 0].astype(np.float32)
        write_ply("points.ply", vertices, **{"intensity": heat, "class": kinds})
        pictures = []
        for fields in ({"color_by": "intensity"}, {"color_by": "class"}, {"hide_class": "6"}):
            scene = sr.points(vertices, attributes={"intensity": heat, "class": kinds}, **fields)
            pictures.append(scene.render(size=(48, 48), samples=1))
            self.assertEqual(pictures[-1], sr.open("points.ply", up=(0, 0, 1), **fields).render(size=(48, 48), samples=1), fields)
        self.assertNotEqual(pictures[0], pictures[1])
        self.assertNotEqual(pictures[1], pictures[2])

    def test_mixed_objects_have_their_materials(self):
        vertices, triangles = hill()
        points, normals = plane(height=0.5)
        scene = sr.make_scene([sr.Mesh(vertices, triangles, name="hill"), sr.Points(points, normals, name="roof", material=sr.material("gold"))],
                              mesh_points=5000, materials={"hill": sr.material("ruby")})
        self.assertEqual(scene.objects, ["hill", "roof"])
        self.assertEqual(scene.materials["roof"].mirror, sr.material("gold").mirror)
        self.assertTrue(scene.materials["hill"].glass)
        hits = scene.trace([[0.55, 0.55, 2.0], [0.55, 0.55, 0.4]], [0, 0, -1])
        self.assertEqual(hits.object.tolist(), [1, 0])
        self.assertEqual(hits.point[1], -1)
        np.testing.assert_allclose(points[hits.point[0]][:2], 0.55, atol=0.1)

    def test_sensors_and_heights_of_arrays(self):
        points, _ = plane()
        for height in (5.0, -5.0):
            scene = sr.points(points, sensor=(0, 0, height))
            self.assertGreater(np.sign(height) * scene.splats.normal[:, 2].mean(), 0.99)
        np.testing.assert_allclose(sr.points(points + [0, 0, 10], z_scale=0.3048).bounds[:, 2], 3.048, atol=1e-5)

    def test_refusals(self):
        vertices, triangles = hill(5)
        count = len(vertices)
        for error, part, call in (
                (ValueError, "vertex 25 in triangle 3", lambda: sr.Mesh(vertices, np.where(np.arange(len(triangles))[:, None] == 3, count, triangles))),
                (ValueError, "vertex -1 in triangle 0", lambda: sr.Mesh(vertices, triangles - 1)),
                (ValueError, "(0,)", lambda: sr.Mesh(vertices, np.zeros(0, int))),
                (ValueError, "(0, 3)", lambda: sr.Mesh(vertices, np.zeros((0, 3), int))),
                (TypeError, "float64", lambda: sr.Mesh(vertices, triangles * 1.0)),
                (ValueError, "normals: found 3", lambda: sr.Mesh(vertices, triangles, normals=vertices[:3])),
                (ValueError, "up to 200", lambda: sr.Mesh(vertices, triangles, colors=np.full(vertices.shape, 200.0))),
                (ValueError, "heat: found 2", lambda: sr.Points(vertices, attributes={"heat": [1, 2]})),
                (ValueError, "(25, 3)", lambda: sr.Points(vertices, attributes={"heat": vertices})),
                (TypeError, "dict", lambda: sr.Points(vertices, attributes=[1])),
                (ValueError, "'point'", lambda: sr.points(vertices, attributes={"point": vertices[:, 0]})),
                (ValueError, "whole numbers", lambda: sr.points(vertices, attributes={"class": vertices[:, 0]})),
                (ValueError, "no such", lambda: sr.points(vertices, color_by="no such")),
                (TypeError, "splatray.Points", lambda: sr.make_scene(vertices)),
                (TypeError, "splatray.Points", lambda: sr.make_scene(None)),
                (ValueError, "point", lambda: sr.make_scene([])),
                (ValueError, "rotation", lambda: sr.Camera.from_pose(2 * np.eye(4), np.eye(3), (8, 8))),
                (ValueError, "(3, 4)", lambda: sr.Camera.from_pose(np.eye(4)[:3], np.eye(3), (8, 8))),
                (ValueError, "skew", lambda: sr.Camera.from_pose(np.eye(4), np.eye(3) + np.eye(3, k=1), (8, 8)))):
            with self.assertRaises(error) as caught:
                call()
            self.assertIn(part, str(caught.exception))

    def test_a_pose_shows_points_where_it_projects_them(self):
        size = (96, 64)
        K = np.array([[110.0, 0, 30.25], [0, 80, 45.5], [0, 0, 1]])
        turn, random = 0.4, np.random.default_rng(5)
        pose = np.array([[np.cos(turn), np.sin(turn), 0, 7], [np.sin(turn), -np.cos(turn), 0, -3], [0, 0, -1, 5], [0, 0, 0, 1]])
        camera = sr.Camera.from_pose(pose.astype(np.float32), K, size)
        columns, rows = np.meshgrid(np.arange(size[0]), np.arange(size[1]))
        for pixel in random.uniform((8, 8), (88, 56), (3, 2)):
            place = pose[:3] @ np.append(4 * np.linalg.inv(K) @ [*pixel, 1], 1)
            scene = sr.points([place], normals=[[0, 0, 1]], radii=[0.1])
            coverage = scene.render(camera, size, samples=256).pixels[..., 3]
            seen = [(coverage * at).sum() / coverage.sum() for at in (columns, rows)]
            np.testing.assert_allclose(seen, pixel, atol=0.1)
        # The same camera by request, in JSON too.
        request = sr.Request(camera=camera, resolution=size, samples=1)
        self.assertEqual(scene.render(request=sr.Request.from_json(request.json())), scene.render(camera, size, samples=1))

    def test_values_are_equal_and_pickled(self):
        vertices, triangles = hill(5)
        camera = sr.Camera(np.array([1, 2, 3]), [0, 0, 0.5], lens_shift=np.array([0.25, 0]))
        values = [camera, sr.material("gold"), sr.sun(np.array([0, 0, 1])), sr.Mesh(vertices, triangles, attributes={"heat": vertices[:, 0]}),
                  sr.Points(vertices * [1, 1, np.nan], material=sr.material("gold")),
                  sr.points(vertices).render(size=(8, 8), samples=1, aov="depth,normal,id")]
        others = [sr.Camera((1, 2, 3), (0, 0, 0.5)), sr.material("ruby"), sr.sun((0, 0, 2)), sr.Mesh(vertices, triangles[:-1], attributes={"heat": vertices[:, 0]}),
                  sr.Points(vertices), sr.points(vertices).render(size=(8, 8), samples=1)]
        for value, other in zip(values, others):
            for again in (pickle.loads(pickle.dumps(value)), copy.deepcopy(value)):
                self.assertEqual(again, value)
                self.assertFalse(again != value)
            self.assertNotEqual(value, other)
            self.assertNotEqual(value, None)
        self.assertEqual(camera, sr.Camera((1.0, 2.0, 3.0), (0.0, 0.0, 0.5), lens_shift=(0.25, 0.0)))
        self.assertEqual(hash(camera), hash(pickle.loads(pickle.dumps(camera))))


if __name__ == "__main__":
    unittest.main()
