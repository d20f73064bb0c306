"""Scenes as both renderers read them: points and options for splatray, polygons and plugins for Mitsuba."""

import os
import subprocess
from dataclasses import dataclass, field

import mitsuba as mi
import numpy as np

from discs import polygons, read_discs

GOLDEN = 0.5 * (1.0 + 5.0**0.5)


@dataclass
class Part:
    """An object: points with normals, a base colour, and the roughness of a white metal, or None for a matte one."""

    points: np.ndarray
    normals: np.ndarray
    color: tuple = (0.8, 0.8, 0.8)
    metal: float | None = None


@dataclass
class Scene:
    parts: dict
    eye: tuple
    target: tuple
    fov_deg: float
    lamps: list = field(default_factory=list)  # (centre, radius, radiance)
    sky: np.ndarray | None = None  # (height, width, 3), latitude and longitude


def rectangle(corner, u, v, per_unit):
    """Points in rows on a rectangle, to its edges."""
    corner, u, v = (np.asarray(x, float) for x in (corner, u, v))
    counts = [max(2, int(round(np.linalg.norm(x) * per_unit)) + 1) for x in (u, v)]
    a, b = np.meshgrid(np.linspace(0.0, 1.0, counts[0]), np.linspace(0.0, 1.0, counts[1]))
    points = corner + a.reshape(-1, 1) * u + b.reshape(-1, 1) * v
    normal = np.cross(u, v)
    return points, np.broadcast_to(normal / np.linalg.norm(normal), points.shape)


def ball(centre, radius, count):
    """Points on a ball (Fibonacci lattice)."""
    i = np.arange(count) + 0.5
    z = 1.0 - 2.0 * i / count
    angle = 2.0 * np.pi * i / GOLDEN
    ring = np.sqrt(1.0 - z * z)
    normals = np.stack([ring * np.cos(angle), z, ring * np.sin(angle)], 1)
    return np.asarray(centre) + radius * normals, normals


def joined(*pieces):
    return tuple(np.concatenate([piece[i] for piece in pieces]) for i in range(2))


def cornell():
    """The box, lit by two balls: matte walls, a matte block, a mirror's ball and a rough one's."""
    per = 24
    white = joined(
        rectangle((-1, -1, 1), (2, 0, 0), (0, 0, -2), per),
        rectangle((-1, 1, -1), (2, 0, 0), (0, 0, 2), per),
        rectangle((-1, -1, -1), (2, 0, 0), (0, 2, 0), per),
    )
    turn = np.array([[np.cos(0.3), 0, np.sin(0.3)], [0, 1, 0], [-np.sin(0.3), 0, np.cos(0.3)]])
    at = np.array([-0.35, -1.0, -0.4])
    faces = [
        ((-0.3, 0, 0.3), (0.6, 0, 0), (0, 1.2, 0)),
        ((0.3, 0, -0.3), (-0.6, 0, 0), (0, 1.2, 0)),
        ((0.3, 0, 0.3), (0, 0, -0.6), (0, 1.2, 0)),
        ((-0.3, 0, -0.3), (0, 0, 0.6), (0, 1.2, 0)),
        ((-0.3, 1.2, 0.3), (0.6, 0, 0), (0, 0, -0.6)),
    ]
    block = joined(*[rectangle(turn @ np.array(c) + at, turn @ np.array(u), turn @ np.array(v), per) for c, u, v in faces])
    return Scene(
        parts={
            "white": Part(*joined(white, block), (0.75, 0.75, 0.75)),
            "red": Part(*rectangle((-1, -1, 1), (0, 0, -2), (0, 2, 0), per), (0.6, 0.05, 0.05)),
            "green": Part(*rectangle((1, -1, -1), (0, 0, 2), (0, 2, 0), per), (0.1, 0.5, 0.1)),
            "mirror": Part(*ball((0.45, -0.65, -0.2), 0.35, 4000), (1, 1, 1), 0.0),
            "rough": Part(*ball((0.0, -0.75, 0.5), 0.25, 4000), (1, 1, 1), 0.2),
        },
        eye=(0, 0, 3.9),
        target=(0, 0, 0),
        fov_deg=40,
        lamps=[((0.0, 0.7, 0.0), 0.15, 20.0), ((-0.6, 0.2, 0.5), 0.05, 30.0)],
    )


def plates():
    """Veach's plates: four metals of growing roughness under four lamps of growing size, over a matte floor."""
    parts = {"floor": Part(*rectangle((-4, -1.4, 3), (8, 0, 0), (0, 0, -6), 12), (0.4, 0.4, 0.4))}
    eye = np.array([0.0, 1.0, 6.0])
    lamp_row = np.array([0.0, 2.2, -2.0])
    for i, roughness in enumerate((0.06, 0.12, 0.18, 0.24)):
        centre = np.array([0.0, -1.2 + 0.45 * i, 1.6 - 0.9 * i])
        normal = (eye - centre) / np.linalg.norm(eye - centre) + (lamp_row - centre) / np.linalg.norm(lamp_row - centre)
        normal /= np.linalg.norm(normal)
        down = np.cross((1.0, 0.0, 0.0), normal)
        parts[f"plate{i}"] = Part(
            *rectangle(centre - (2.0, 0, 0) + 0.3 * down, (4.0, 0, 0), -0.6 * down, 24), (1, 1, 1), roughness
        )
    lamps = [((-1.8 + 1.2 * i, 2.2, -2.0), radius, 1.2 / radius**2) for i, radius in enumerate((0.03, 0.1, 0.25, 0.45))]
    return Scene(parts=parts, eye=tuple(eye), target=(0, 0, 0), fov_deg=40, lamps=lamps)


def read_model(path):
    """Vertices and triangles of a PLY file, two units large, on the ground."""
    mesh = mi.load_dict({"type": "ply", "filename": path})
    vertices = np.array(mesh.vertex_positions_buffer()).reshape(-1, 3)
    faces = np.array(mesh.faces_buffer()).reshape(-1, 3)
    low, high = vertices.min(0), vertices.max(0)
    return (vertices - [0.5 * (low[0] + high[0]), low[1], 0.5 * (low[2] + high[2])]) * (2.0 / (high - low).max()), faces


def sunny_sky():
    """Latitude and longitude: bluer above, with a sun."""
    rows, _ = np.mgrid[0:64, 0:128]
    sky = np.full((64, 128, 3), 0.3) + 0.7 * (1.0 - rows / 63.0)[..., None] * [0.6, 0.8, 1.0]
    sky[14:18, 30:36] += [60.0, 55.0, 45.0]
    return sky.repeat(8, 0).repeat(8, 1)  # Mitsuba's rows lie half a row beside ours


def scan(model):
    """A scanned body on a floor below a picture of the sky."""

    def make():
        vertices, faces = read_model(model)
        corners = vertices[faces]
        across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        areas = np.linalg.norm(across, axis=1)
        random = np.random.default_rng(1)
        chosen = random.choice(len(faces), 60000, p=areas / areas.sum())
        a, b = random.random((2, 60000, 1))
        a, b = np.where(a + b > 1.0, 1.0 - a, a), np.where(a + b > 1.0, 1.0 - b, b)
        points = corners[chosen, 0] * (1 - a - b) + corners[chosen, 1] * a + corners[chosen, 2] * b
        body = Part(points, across[chosen] / areas[chosen, None], (0.7, 0.5, 0.35))
        floor = Part(*rectangle((-3, 0, 3), (6, 0, 0), (0, 0, -6), 20), (0.6, 0.6, 0.6))
        return Scene(parts={"body": body, "floor": floor}, eye=(2.5, 1.8, 4.0), target=(0, 0.7, 0), fov_deg=35, sky=sunny_sky())

    return make


def write_points(path, part):
    """A binary PLY file of points with normals."""
    values = np.concatenate([part.points, part.normals], 1).astype("<f8")
    names = "".join(f"property double {name}\n" for name in ("x", "y", "z", "nx", "ny", "nz"))
    with open(path, "wb") as file:
        file.write(f"ply\nformat binary_little_endian 1.0\nelement vertex {len(values)}\n{names}end_header\n".encode())
        file.write(values.tobytes())


def build(scene, programs, folder):
    """Preprocesses a scene. Returns the scene file and the options of splatray-render that show it as Mitsuba does: discs one by one,
    secondary rays that leave them by a fixed distance."""
    os.makedirs(folder, exist_ok=True)
    files = []
    for name, part in scene.parts.items():
        files.append(f"{folder}/{name}.ply")
        write_points(files[-1], part)
    soct = f"{folder}/scene.soct"
    subprocess.run([f"{programs}/splatray-preprocess", *files, "-o", soct, "--normal-fields=off", "--clip=off"], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    options = ["--look=lit", "--bounces=64", "--tone=none", f"--fov={scene.fov_deg}"]
    for name, value in (("eye", scene.eye), ("target", scene.target)):
        options.append(f"--{name}=" + ",".join(map(str, value)))
    for name, part in scene.parts.items():
        color = "/".join(map(str, part.color))
        kind = "specular=0,mirror=0" if part.metal is None else f"metallic=1,roughness={part.metal}"
        options += ["--object", f"{name}:two-sided=on,diffuse={color},{kind}"]
    for centre, radius, radiance in scene.lamps:
        intensity = np.pi * radius * radius * radiance
        options += ["--light", ",".join(map(str, (*centre, intensity, intensity, intensity, radius)))]
    if not scene.lamps:
        options.append("--lights=none")
    options.append("--environment=black")
    if scene.sky is not None:
        mi.Bitmap(scene.sky.astype(np.float32)).write(f"{folder}/sky.exr")
        options[-1] = f"--environment={folder}/sky.exr"
    return soct, options


def sensor(scene, edge):
    """Mitsuba's, of what has eye, target and fov_deg."""
    return {
        "type": "perspective",
        "fov": scene.fov_deg,
        "fov_axis": "y",
        "to_world": mi.ScalarTransform4f().look_at(origin=scene.eye, target=scene.target, up=(0, 1, 0)),
        "film": {
            "type": "hdrfilm",
            "width": edge,
            "height": edge,
            "rfilter": {"type": "box"},
            "pixel_format": "rgb",
            "component_format": "float32",
        },
        "sampler": {"type": "independent"},
    }


def triangle_mesh(name, vertices, triangles, bsdf, emission=0.0):
    """Mitsuba's, of two-sided triangles; light leaves their fronts."""
    properties = mi.Properties()
    properties["bsdf"] = mi.load_dict({"type": "twosided", "bsdf": bsdf})
    if emission:
        properties["emitter"] = mi.load_dict({"type": "area", "radiance": {"type": "rgb", "value": emission}})
    mesh = mi.Mesh(name, len(vertices), len(triangles), has_vertex_normals=False, props=properties)
    parameters = mi.traverse(mesh)
    parameters["vertex_positions"] = vertices.astype(np.float32).ravel()
    parameters["faces"] = triangles.astype(np.uint32).ravel()
    parameters.update()
    return mesh


def ball_of_light(centre, radius, radiance):
    """Mitsuba's."""
    emitter = {"type": "area", "radiance": {"type": "rgb", "value": radiance}}
    return {"type": "sphere", "center": list(centre), "radius": radius, "emitter": emitter}


def environment(sky):
    """Mitsuba's, whose first column lies where the middle of splatray's does."""
    return {"type": "envmap", "bitmap": mi.Bitmap(np.roll(sky, sky.shape[1] // 2, axis=1).astype(np.float32))}


def in_mitsuba(scene, soct, edge):
    """The scene with the splats of the scene file as polygons."""
    centres, normals, radii, objects = read_discs(soct)
    described = {"type": "scene", "integrator": {"type": "path", "max_depth": 66}, "sensor": sensor(scene, edge)}
    for i, (name, part) in enumerate(scene.parts.items()):
        own = objects == i
        vertices, triangles = polygons(centres[own], normals[own], radii[own])
        if part.metal is None:
            inner = {"type": "diffuse", "reflectance": {"type": "rgb", "value": list(part.color)}}
        elif part.metal == 0.0:
            inner = {"type": "conductor", "material": "none"}
        else:
            inner = {"type": "roughconductor", "material": "none", "distribution": "ggx", "alpha": part.metal**2}
        described[name] = triangle_mesh(name, vertices, triangles, inner)
    for i, lamp in enumerate(scene.lamps):
        described[f"lamp{i}"] = ball_of_light(*lamp)
    if scene.sky is not None:
        described["sky"] = environment(scene.sky)
    return mi.load_dict(described)
