"""Noise and time of scenes that are hard to light, beside Mitsuba 3's of the same meshes.

Both renderers make two pictures of each scene; their noise is what these differ by, over what they show (relative RMSE of one picture). A
renderer's time to a noise of 2 % follows from both, as noise falls with the square root of the samples: a little less for splatray, whose
samples are low-discrepancy ones. Prints a table. Times are those of the renderers' own clocks, without start-up and reading.

With --store FILE Mitsuba's pictures alone are made, and kept for tests/bench/guard: of each scene its glTF, what splatray-render is given,
and the means of BLOCKS x BLOCKS parts of the picture. Scenes with models or a picture of the sky are left out."""

import argparse
import base64
import json
import os
import subprocess
import time

import mitsuba as mi
import numpy as np

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("programs", help="folder of splatray's programs")
parser.add_argument("folder", help="folder to work in")
parser.add_argument("--data", help="folder of real models; without it there is no dragon")
parser.add_argument("--only", nargs="*", default=[], help="names of scenes")
parser.add_argument("--edge", type=int, default=200, help="pixels of a picture's edge")
parser.add_argument("--samples", type=int, default=64)
parser.add_argument("--splats", type=int, default=150000)
parser.add_argument("--store", help="file to keep Mitsuba's means in (JSON)")
parser.add_argument("--record", help="file to keep the table in (JSON)")
parser.add_argument("--variant", default="scalar_rgb", help="of Mitsuba; llvm_ad_rgb is faster, and needs LLVM 16 to 19")
OPTIONS = parser.parse_args()
mi.set_variant(OPTIONS.variant)

from scenes import ball_of_light, environment, read_model, sensor, sunny_sky, triangle_mesh  # noqa: E402  (needs a variant)

BOUNCES = 8
BLOCKS = 10


class Room:
    """Quads, triangles and balls of light, as glTF and for Mitsuba."""

    def __init__(self, eye, target, fov_deg):
        self.eye, self.target, self.fov_deg = eye, target, fov_deg
        self.meshes = []  # (vertices (N, 3), triangles (M, 3), colour, emission, further values of glTF's material)
        self.balls = []  # (centre, radius, radiance)
        self.area_lights = []  # (centre, half u, half v, radiance)
        self.sky = None

    def quads(self, quads, color, emission=0.0, **values):
        """Each of corner, u, v; its front is where cross(u, v) points."""
        corners = np.array([[c, np.add(c, u), np.add(np.add(c, u), v), np.add(c, v)] for c, u, v in quads], float)
        faces = np.arange(len(quads))[:, None, None] * 4 + np.array([[0, 1, 2], [0, 2, 3]])[None]
        self.meshes.append((corners.reshape(-1, 3), faces.reshape(-1, 3), color, emission, values))

    def box(self, low, high, color):
        """The inside of a box."""
        (x, y, z), (u, v, w) = low, np.subtract(high, low)
        self.quads(
            [
                ((x, y, z), (0, 0, w), (u, 0, 0)),
                ((x, y + v, z), (u, 0, 0), (0, 0, w)),
                ((x, y, z), (u, 0, 0), (0, v, 0)),
                ((x, y, z + w), (0, v, 0), (u, 0, 0)),
                ((x, y, z), (0, v, 0), (0, 0, w)),
                ((x + u, y, z), (0, 0, w), (0, v, 0)),
            ],
            color,
        )


def write_gltf(room, path):
    views, accessors, meshes, materials, data = [], [], [], [], b""

    def accessor(values, kind, component):
        nonlocal data
        raw = values.tobytes()
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(raw)})
        data += raw
        entry = {"bufferView": len(views) - 1, "componentType": component, "count": len(values), "type": kind}
        if kind == "VEC3":
            entry |= {"min": values.min(0).tolist(), "max": values.max(0).tolist()}
        accessors.append(entry)
        return len(accessors) - 1

    for vertices, triangles, color, emission, values in room.meshes:
        material = {
            "doubleSided": not emission,
            "pbrMetallicRoughness": {"baseColorFactor": [*color, 1.0], "metallicFactor": 0.0, "roughnessFactor": 1.0} | values,
            "extensions": {"KHR_materials_specular": {"specularFactor": 0.0 if not values else 1.0}},
        }
        if emission:
            material["emissiveFactor"] = [1.0, 1.0, 1.0]
            material["extensions"]["KHR_materials_emissive_strength"] = {"emissiveStrength": emission}
        materials.append(material)
        attributes = {"POSITION": accessor(vertices.astype("<f4"), "VEC3", 5126)}
        indices = accessor(triangles.astype("<u4").reshape(-1), "SCALAR", 5125)
        meshes.append({"primitives": [{"attributes": attributes, "indices": indices, "material": len(materials) - 1}]})
    gltf = {
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": list(range(len(meshes)))}],
        "scene": 0,
        "nodes": [{"mesh": i} for i in range(len(meshes))],
        "meshes": meshes,
        "materials": materials,
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}],
        "extensionsUsed": ["KHR_materials_specular", "KHR_materials_emissive_strength"],
    }
    with open(path, "w", encoding="utf-8") as file:
        json.dump(gltf, file)


def numbers(values):
    return ",".join(repr(float(x)) for x in values)


def options_of(room, folder):
    """What splatray-render shows a room with, but for samples, seed and output."""
    command = ["--look=lit", f"--bounces={BOUNCES}", "--tone=none", "--exposure=0", "--quiet"]
    command += [f"--fov={room.fov_deg}", f"--eye={numbers(room.eye)}", f"--target={numbers(room.target)}"]
    command += [f"--resolution={OPTIONS.edge}x{OPTIONS.edge}", "--background=0,0,0"]
    for centre, radius, radiance in room.balls:
        command += ["--light", numbers((*centre, *[np.pi * radius**2 * radiance] * 3, radius))]
    for centre, half_u, half_v, radiance in room.area_lights:
        ahead = np.cross(half_u, half_v)
        sizes = [2 * np.linalg.norm(half_u), 2 * np.linalg.norm(half_v)]
        command += ["--area-light", numbers((*centre, *np.add(centre, ahead / np.linalg.norm(ahead)), *sizes, *[radiance] * 3))]
    if not room.balls and not room.area_lights:
        command.append("--lights=none")
    command.append("--environment=black")
    if room.sky is not None:
        mi.Bitmap(room.sky.astype(np.float32)).write(f"{folder}/sky.exr")
        command[-1] = f"--environment={folder}/sky.exr"
    return command


def in_splatray(room, folder):
    """The command that shows a room, but for samples, seed and output."""
    write_gltf(room, f"{folder}/scene.gltf")
    soct = f"{folder}/scene.soct"
    points = f"--mesh-points={OPTIONS.splats}"
    subprocess.run([f"{OPTIONS.programs}/splatray-preprocess", f"{folder}/scene.gltf", "-o", soct, points], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return [f"{OPTIONS.programs}/splatray-render", soct, *options_of(room, folder)]


def splatray_pictures(command, folder):
    pictures, seconds = [], []
    for seed in (1, 2):
        end = [f"--samples={OPTIONS.samples}", f"--seed={seed}", "-o", f"{folder}/picture.exr", "--stats-json", f"{folder}/stats.json"]
        subprocess.run(command + end, check=True, env=os.environ | {"SPLATRAY_VALIDATION": "0"})
        stats = json.load(open(f"{folder}/stats.json", encoding="utf-8"))
        seconds.append(stats["times_ms"]["trace"] / 1000.0)
        pictures.append(np.array(mi.Bitmap(f"{folder}/picture.exr"))[..., :3].mean(-1))
    return np.array(pictures, float), min(seconds), stats["commit"]


def in_mitsuba(room):
    described = {
        "type": "scene",
        "integrator": {"type": "path", "max_depth": BOUNCES + 2, "hide_emitters": room.sky is not None},
        "sensor": sensor(room, OPTIONS.edge),
    }
    for i, (vertices, triangles, color, emission, values) in enumerate(room.meshes):
        inner = {"type": "diffuse", "reflectance": {"type": "rgb", "value": list(color)}}
        if values:
            inner = {"type": "principled", "base_color": {"type": "rgb", "value": list(color)}, "metallic": values["metallicFactor"]}
            inner["roughness"] = values["roughnessFactor"]
        described[f"mesh{i}"] = triangle_mesh(f"mesh{i}", vertices, triangles, inner, emission)
    for i, ball in enumerate(room.balls):
        described[f"ball{i}"] = ball_of_light(*ball)
    for i, (centre, half_u, half_v, radiance) in enumerate(room.area_lights):
        to_world = np.eye(4)
        ahead = np.cross(half_u, half_v)
        to_world[:3, 0], to_world[:3, 1], to_world[:3, 2] = half_u, half_v, ahead / np.linalg.norm(ahead)
        to_world[:3, 3] = centre
        described[f"area{i}"] = {
            "type": "rectangle",
            "to_world": mi.ScalarTransform4f(to_world),
            "emitter": {"type": "area", "radiance": {"type": "rgb", "value": radiance}},
        }
    if room.sky is not None:
        described["sky"] = environment(room.sky)
    return mi.load_dict(described)


def mitsuba_pictures(scene):
    mi.render(scene, spp=1, seed=9).numpy()  # compiles
    pictures, seconds = [], []
    for seed in (1, 2):
        start = time.time()
        pictures.append(mi.render(scene, spp=OPTIONS.samples, seed=seed).numpy()[..., :3].mean(-1))
        seconds.append(time.time() - start)
    return np.array(pictures, float), min(seconds)


def noise_of(pictures):
    """Relative RMSE of one of two pictures; the brightest fiftieth of the pixels, lamps and their rims, does not count."""
    difference = 0.5 * (pictures[0] - pictures[1]) ** 2
    mean = pictures.mean(0)
    counted = mean < np.quantile(mean, 0.98)
    return np.sqrt(difference[counted].mean()) / mean[counted].mean(), mean[counted].mean()


def stored(room, folder):
    """What is kept of a room: its scene, how it is shown, and Mitsuba's means of the picture's parts."""
    write_gltf(room, f"{folder}/scene.gltf")
    picture = mi.render(in_mitsuba(room), spp=OPTIONS.samples, seed=1).numpy()[..., :3].mean(-1)
    part = OPTIONS.edge // BLOCKS
    means = picture.reshape(BLOCKS, part, BLOCKS, part).mean((1, 3))
    options = options_of(room, folder)
    with open(f"{folder}/scene.gltf", encoding="utf-8") as file:
        return {"gltf": json.load(file), "options": options, "means": [[float(f"{mean:.4g}") for mean in row] for row in means]}


def cornell(lamp):
    room = Room((0, 0, 3.9), (0, 0, 0), 40)
    room.quads([((-1, -1, 1), (2, 0, 0), (0, 0, -2)), ((-1, 1, -1), (2, 0, 0), (0, 0, 2)), ((-1, -1, -1), (2, 0, 0), (0, 2, 0))], (0.75, 0.75, 0.75))
    room.quads([((-1, -1, 1), (0, 0, -2), (0, 2, 0))], (0.6, 0.05, 0.05))
    room.quads([((1, -1, -1), (0, 0, 2), (0, 2, 0))], (0.1, 0.5, 0.1))
    if lamp == "object":
        room.quads([((-0.25, 0.999, -0.25), (0.5, 0, 0), (0, 0, 0.5))], (0, 0, 0), 15.0)
    else:
        room.area_lights.append(((0, 0.999, 0), (0.25, 0, 0), (0, 0, 0.25), 15.0))
    return room


def panels():
    """64 panels below a ceiling."""
    room = Room((3.6, 1.6, 3.6), (-1.0, 0.8, -1.0), 60)
    room.box((-4, 0, -4), (4, 3, 4), (0.7, 0.7, 0.7))
    lamps = [((-3.7 + i, 2.999, -3.7 + j), (0.4, 0, 0), (0, 0, 0.4)) for i in range(8) for j in range(8)]
    room.quads(lamps, (0, 0, 0), 4.0)
    return room


def balls():
    """256 balls over a floor, in a room."""
    room = Room((3.6, 1.6, 3.6), (-1.0, 0.8, -1.0), 60)
    room.box((-4, 0, -4), (4, 3, 4), (0.7, 0.7, 0.7))
    random = np.random.default_rng(3)
    for _ in range(256):
        room.balls.append((random.uniform((-3.8, 0.3, -3.8), (3.8, 2.8, 3.8)), 0.05, 8.0))
    return room


def windows():
    """A room that the sky alone lights, through two windows."""
    room = Room((3.4, 1.6, 3.4), (-1.0, 1.1, -2.0), 60)
    grey = (0.7, 0.7, 0.7)
    (x, y, z), (u, v, w) = (-4, 0, -4), (8, 3, 8)
    room.quads(
        [
            ((x, y, z), (0, 0, w), (u, 0, 0)),
            ((x, y + v, z), (u, 0, 0), (0, 0, w)),
            ((x, y, z), (0, v, 0), (0, 0, w)),
            ((x + u, y, z), (0, 0, w), (0, v, 0)),
            ((x, y, z + w), (0, v, 0), (u, 0, 0)),
        ],
        grey,
    )
    wall = [(-4, 4, 0, 0.9), (-4, 4, 2.3, 3), (-4, -3, 0.9, 2.3), (-1, 1, 0.9, 2.3), (3, 4, 0.9, 2.3)]
    room.quads([((left, low, z), (right - left, 0, 0), (0, high - low, 0)) for left, right, low, high in wall], grey)
    room.sky = sunny_sky()
    return room


def dragon(model):
    vertices, faces = read_model(model)
    room = Room((2.5, 1.8, 4.0), (0, 0.7, 0), 35)
    room.meshes.append((vertices, faces, (0.7, 0.5, 0.35), 0.0, {}))
    room.quads([((-3, 0, 3), (6, 0, 0), (0, 0, -6))], (0.6, 0.6, 0.6))
    room.sky = sunny_sky()
    return room


def main():
    scenes = {
        "Cornell box, area light": lambda: cornell("light"),
        "Cornell box, emissive object": lambda: cornell("object"),
        "64 panels": panels,
        "256 balls": balls,
    }
    if not OPTIONS.store:
        scenes["room with windows"] = windows
    if OPTIONS.data and not OPTIONS.store:
        scenes["dragon"] = lambda: dragon(f"{OPTIONS.data}/models/dragon.ply")
    if OPTIONS.store:
        os.makedirs(OPTIONS.folder, exist_ok=True)
        kept = {name: stored(make(), OPTIONS.folder) for name, make in scenes.items() if not OPTIONS.only or name in OPTIONS.only}
        about = {"mitsuba": mi.__version__, "samples": OPTIONS.samples}
        with open(OPTIONS.store, "w", encoding="utf-8") as file:
            json.dump(about | {"scenes": kept}, file)
        return
    records = []
    print("| scene | light, of Mitsuba's | noise | Mitsuba's | seconds | Mitsuba's | time to 2 %, of Mitsuba's |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    for name, make in scenes.items():
        if OPTIONS.only and not any(part in name for part in OPTIONS.only):
            continue
        place = f"{OPTIONS.folder}/{name.replace(' ', '_').replace(',', '')}"
        os.makedirs(place, exist_ok=True)
        room = make()
        ours, our_seconds, commit = splatray_pictures(in_splatray(room, place), place)
        theirs, their_seconds = mitsuba_pictures(in_mitsuba(room))
        mi.Bitmap(np.concatenate([ours[0], theirs[0]], 1).astype(np.float32)).write(f"{place}/both.exr")
        (noise, light), (their_noise, their_light) = noise_of(ours), noise_of(theirs)
        ratio = our_seconds * noise**2 / (their_seconds * their_noise**2)
        records.append({"scene": name, "light": light / their_light, "noise": [noise, their_noise], "seconds": [our_seconds, their_seconds], "ratio": ratio, "commit": commit})
        columns = (name, f"{light / their_light:.4f}", f"{noise:.4f}", f"{their_noise:.4f}", f"{our_seconds:.2f}", f"{their_seconds:.2f}", f"{ratio:.2f}")
        print("| " + " | ".join(columns) + " |", flush=True)
    if OPTIONS.record:
        with open(OPTIONS.record, "w", encoding="utf-8") as file:
            json.dump(records, file)


if __name__ == "__main__":
    main()
