"""race_python.py MESH.ply --points N -o FILE [--runs N]: rays a second through Python, on one thread: splatray on N points of the mesh, embreex and Open3D on
the mesh itself, each in turn. JSON: a list of {rays, program, version, rate: [million a second, of each run], hits, commit, date}. Rays are
float32 arrays: "camera", a frame of 512 x 512; "random", as many from all around towards the box; "occluded", random ones of which any hit is
asked for. `hits` is the share of rays that hit, which tells whether all were given the same."""

import argparse
import datetime
import importlib.metadata
import json
import os
import pathlib
import time

os.environ["OMP_NUM_THREADS"] = "1"
import embreex.rtcore_scene  # noqa: E402  (reads the number of threads)
import numpy as np  # noqa: E402
import open3d  # noqa: E402
import splatray  # noqa: E402
from embreex.mesh_construction import TriangleMesh  # noqa: E402

SIZE = 512


def camera_rays(low, high):
    """One through each pixel of a camera that looks along -z at the box."""
    middle, reach = 0.5 * (low + high), np.linalg.norm(high - low)
    eye = middle + (0, 0, 1.6 * reach)
    at = (np.arange(SIZE) + 0.5) / SIZE - 0.5
    x, y = np.meshgrid(at, -at)
    directions = np.stack([0.7 * x, 0.7 * y, -np.ones_like(x)], -1).reshape(-1, 3)
    return np.broadcast_to(eye, directions.shape), directions


def random_rays(low, high):
    random = np.random.default_rng(5)
    middle, half = 0.5 * (low + high), 0.5 * (high - low)
    away = random.normal(size=(SIZE * SIZE, 3))
    origins = middle + 1.5 * np.linalg.norm(half) * away / np.linalg.norm(away, axis=1, keepdims=True)
    return origins, middle + half * random.uniform(-1, 1, origins.shape) - origins


def as_float32(rays):
    origins, directions = rays
    return np.ascontiguousarray(origins, np.float32), np.ascontiguousarray(directions / np.linalg.norm(directions, axis=1, keepdims=True), np.float32)


class Splatray:
    name = "splatray"

    def __init__(self, path, _vertices, _faces, points):
        self.scene = splatray.open(path, mesh_points=points, device="cpu", threads=1)

    def trace(self, origins, directions):
        return np.isfinite(self.scene.trace(origins, directions).t)

    def occluded(self, origins, directions):
        return self.scene.occluded(origins, directions)


class Embreex:
    name = "embreex"

    def __init__(self, _path, vertices, faces, _points):
        self.scene = embreex.rtcore_scene.EmbreeScene()
        self.mesh = TriangleMesh(self.scene, vertices.astype(np.float32), faces.astype(np.int32))

    def trace(self, origins, directions):
        return self.scene.run(origins, directions) >= 0

    def occluded(self, origins, directions):
        return self.scene.run(origins, directions, query="OCCLUDED") >= 0


class Open3D:
    name = "open3d"

    def __init__(self, _path, vertices, faces, _points):
        self.scene = open3d.t.geometry.RaycastingScene(nthreads=1)
        self.scene.add_triangles(vertices.astype(np.float32), faces.astype(np.uint32))

    def trace(self, origins, directions):
        return np.isfinite(self.scene.cast_rays(np.hstack([origins, directions]), nthreads=1)["t_hit"].numpy())

    def occluded(self, origins, directions):
        return self.scene.test_occlusions(np.hstack([origins, directions]), nthreads=1).numpy()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh")
    parser.add_argument("--points", type=int, required=True)
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True)
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--commit", required=True)
    options = parser.parse_args()
    mesh = open3d.io.read_triangle_mesh(options.mesh)
    vertices, faces = np.asarray(mesh.vertices), np.asarray(mesh.triangles)
    box = vertices.min(0), vertices.max(0)
    racers = [make(options.mesh, vertices, faces, options.points) for make in (Splatray, Embreex, Open3D)]
    random = as_float32(random_rays(*box))
    records = []
    for rays, (origins, directions), any_hit in (("camera", as_float32(camera_rays(*box)), False), ("random", random, False), ("occluded", random, True)):
        rates, hits = {racer.name: [] for racer in racers}, {}
        for run in range(1 + options.runs):
            for racer in racers:
                begin = time.perf_counter()
                met = (racer.occluded if any_hit else racer.trace)(origins, directions)
                seconds = time.perf_counter() - begin
                hits[racer.name] = float(np.mean(met))
                if run > 0:
                    rates[racer.name].append(len(origins) / seconds / 1e6)
        for name, rate in rates.items():
            record = {"rays": rays, "program": name, "version": importlib.metadata.version(name), "rate": rate, "hits": hits[name]}
            records.append(record | {"triangles": len(faces), "points": options.points, "commit": options.commit, "date": datetime.date.today().isoformat()})
            print(f"{rays}, {name}: {np.median(rate):.3f} M rays/s, {hits[name]:.4f} hit", flush=True)
    options.output.write_text(json.dumps(records))


if __name__ == "__main__":
    main()
