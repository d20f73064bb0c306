"""gltf_in_mitsuba.py SCENE OUT.png --environment FILE [--eye X,Y,Z --target X,Y,Z --fov DEG] [--samples N]
[--variant NAME]: the triangles of a glTF file, path-traced by Mitsuba 3 (Jakob et al. 2022) from that view or the file's first camera, 480 x 360
pixels, sRGB without a tone curve. A reader of glTF 2.0 of its own, so that pictures of splatray are compared with another's understanding of
the file; it reads what the sample assets have: no sparse accessors, skins or morphs. Needs Mitsuba and NumPy from PyPI."""

import argparse
import base64
import io
import json
import pathlib
import struct
import tempfile

import mitsuba as mi
import numpy as np

WIDTH, HEIGHT = 480, 360
COMPONENTS = {5120: "i1", 5121: "u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
COLUMNS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
COAT = 4.0  # Mitsuba's principled coat is a quarter of glTF's (Burley 2012)
SMOOTHEST = 1e-3


class File:
    """A .gltf or .glb file: its JSON, and what its buffers and images hold."""

    def __init__(self, path):
        self.path = pathlib.Path(path)
        data, self.blob = self.path.read_bytes(), None
        if data[:4] == b"glTF":
            size = struct.unpack("<I", data[12:16])[0]
            data, self.blob = data[20 : 20 + size], data[28 + size :]
        self.json = json.loads(data)
        self.pictures = {}

    def stored(self, uri):
        return base64.b64decode(uri.split(",", 1)[1]) if uri.startswith("data:") else (self.path.parent / uri).read_bytes()

    def view(self, index):
        view = self.json["bufferViews"][index]
        buffer = self.json["buffers"][view["buffer"]]
        data = self.stored(buffer["uri"]) if "uri" in buffer else self.blob
        start = view.get("byteOffset", 0)
        return data[start : start + view["byteLength"]], view.get("byteStride")

    def accessor(self, index):
        """(count, columns), normalised integers as 0..1."""
        accessor = self.json["accessors"][index]
        data, stride = self.view(accessor["bufferView"])
        kind, columns = np.dtype(COMPONENTS[accessor["componentType"]]), COLUMNS[accessor["type"]]
        stride = stride or kind.itemsize * columns
        values = np.ndarray((accessor["count"], columns), kind, data, accessor.get("byteOffset", 0), (stride, kind.itemsize))
        return values / np.iinfo(kind).max if accessor.get("normalized") else values.copy()

    def picture(self, texture):
        """A texture's (height, width, 4) bytes as 0..1."""
        source = self.json["textures"][texture]["source"]
        if source not in self.pictures:
            image = self.json["images"][source]
            data = self.stored(image["uri"]) if "uri" in image else self.view(image["bufferView"])[0]
            with tempfile.NamedTemporaryFile() as file:
                file.write(data)
                file.flush()
                bitmap = mi.Bitmap(file.name)
            self.pictures[source] = np.array(bitmap.convert(mi.Bitmap.PixelFormat.RGBA, mi.Struct.Type.UInt8, True)) / 255.0
        return self.pictures[source]


def linear(srgb):
    return np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)


def texture(values, info):
    """A texture of Mitsuba with values (height, width, 1 or 3), laid as a textureInfo says (KHR_texture_transform)."""
    moved = info.get("extensions", {}).get("KHR_texture_transform", {})
    (u, v), (du, dv) = moved.get("scale", (1, 1)), moved.get("offset", (0, 0))
    to_uv = mi.ScalarTransform4f(np.array([[u, 0, 0, du], [0, v, 0, dv], [0, 0, 1, 0], [0, 0, 0, 1.0]]))
    return {"type": "bitmap", "bitmap": mi.Bitmap(np.ascontiguousarray(values, np.float32)), "raw": True, "to_uv": to_uv}


class Material:
    """A glTF material as plugins of Mitsuba."""

    def __init__(self, file, source):
        self.file, self.source = file, source
        self.pbr = source.get("pbrMetallicRoughness", {})

    def extension(self, name):
        return self.source.get("extensions", {}).get("KHR_materials_" + name)

    def number(self, factor, info, channel, change=lambda x: x):
        if info is None:
            return float(change(factor))
        return texture(change(factor * self.file.picture(info["index"])[..., channel : channel + 1]), info)

    def base(self, colored):
        factor, info = np.array(self.pbr.get("baseColorFactor", (1, 1, 1, 1))[:3]), self.pbr.get("baseColorTexture")
        if info:
            return texture(factor * linear(self.file.picture(info["index"])[..., :3]), info)
        return {"type": "mesh_attribute", "name": "vertex_color"} if colored else {"type": "rgb", "value": factor.tolist()}

    def tint(self, crossings):
        """The base colour's root, so that light that crosses this often is tinted by all of it."""
        factor = np.array(self.pbr.get("baseColorFactor", (1, 1, 1, 1))[:3])
        return {"type": "rgb", "value": (factor ** (1.0 / crossings)).tolist()}

    def metal_rough(self, name, channel, change=lambda x: x):
        return self.number(self.pbr.get(name, 1.0), self.pbr.get("metallicRoughnessTexture"), channel, change)

    def glass(self):
        if self.extension("volume") is None:
            return {"type": "thindielectric", "specular_transmittance": self.tint(1)}
        ior = (self.extension("ior") or {}).get("ior", 1.5)
        glass = {"type": "dielectric", "int_ior": max(ior, 1.001), "ext_ior": 1.0, "specular_transmittance": self.tint(2)}
        alpha = self.metal_rough("roughnessFactor", 1, lambda x: np.maximum(x * x, SMOOTHEST))
        return glass if alpha == SMOOTHEST else glass | {"type": "roughdielectric", "distribution": "ggx", "alpha": alpha}

    def opaque(self, colored):
        coat = self.extension("clearcoat") or {}
        bsdf = {
            "type": "principled",
            "base_color": self.base(colored),
            "metallic": self.metal_rough("metallicFactor", 2),
            "roughness": self.metal_rough("roughnessFactor", 1, lambda x: np.maximum(x, SMOOTHEST**0.5)),
            "eta": (self.extension("ior") or {}).get("ior", 1.5),
        }
        if coat.get("clearcoatFactor"):
            bsdf["clearcoat"] = self.number(COAT * coat["clearcoatFactor"], coat.get("clearcoatTexture"), 0)
            bsdf["clearcoat_gloss"] = 1.0 - coat.get("clearcoatRoughnessFactor", 0.0)
        return bsdf

    def bsdf(self, colored, mirrored):
        """`mirrored`: of triangles whose texture is laid mirrored."""
        is_glass = bool((self.extension("transmission") or {}).get("transmissionFactor"))
        bsdf = self.glass() if is_glass else self.opaque(colored)
        if info := self.source.get("normalTexture"):
            normals = self.file.picture(info["index"])[..., :3] * 2.0 - 1.0
            normals[..., :2] *= info.get("scale", 1.0) * np.array([1.0, -1.0 if mirrored else 1.0])
            normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
            bsdf = {"type": "normalmap", "normalmap": texture(normals * 0.5 + 0.5, info), "bsdf": bsdf}
        if not is_glass:
            bsdf = {"type": "twosided", "bsdf": bsdf}
        mode, info = self.source.get("alphaMode", "OPAQUE"), self.pbr.get("baseColorTexture")
        if mode != "OPAQUE":
            cutoff = self.source.get("alphaCutoff", 0.5)
            change = (lambda x: np.asarray(x >= cutoff, float)) if mode == "MASK" else (lambda x: x)
            bsdf = {"type": "mask", "opacity": self.number(self.pbr.get("baseColorFactor", (1, 1, 1, 1))[3], info, 3, change), "bsdf": bsdf}
        return bsdf

    def emitter(self):
        factor, info = np.array(self.source.get("emissiveFactor", (0, 0, 0))), self.source.get("emissiveTexture")
        if not factor.any():
            return {}
        radiance = texture(factor * linear(self.file.picture(info["index"])[..., :3]), info) if info else {"type": "rgb", "value": factor.tolist()}
        return {"emitter": {"type": "area", "radiance": radiance}}

    def interior(self):
        volume = self.extension("volume") or {}
        if "attenuationDistance" not in volume:
            return {}
        absorbed = -np.log(np.maximum(volume.get("attenuationColor", (1, 1, 1)), 1e-3)) / volume["attenuationDistance"]
        most = max(absorbed.max(), 1e-6)
        sigma_t = {"type": "rgb", "value": (absorbed / most).tolist()}
        return {"interior": {"type": "homogeneous", "albedo": 0.0, "sigma_t": sigma_t, "scale": float(most)}}


def node_matrix(node):
    if "matrix" in node:
        return np.array(node["matrix"], float).reshape(4, 4).T
    x, y, z, w = node.get("rotation", (0, 0, 0, 1))
    matrix = np.eye(4)
    matrix[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    matrix[:3, :3] *= node.get("scale", (1, 1, 1))
    matrix[:3, 3] = node.get("translation", (0, 0, 0))
    return matrix


def placed_nodes(file):
    """(node, its matrix to the world) of the scene's nodes, parents first."""
    stack = [(i, np.eye(4)) for i in reversed(file.json["scenes"][file.json.get("scene", 0)]["nodes"])]
    while stack:
        index, parent = stack.pop()
        node = file.json["nodes"][index]
        matrix = parent @ node_matrix(node)
        yield node, matrix
        stack += [(child, matrix) for child in reversed(node.get("children", []))]


def save_ply(path, triangles, places, normals, uvs, colors):
    mesh = mi.Mesh("mesh", len(places), len(triangles), has_vertex_normals=normals is not None, has_vertex_texcoords=uvs is not None)
    if colors is not None:
        mesh.add_attribute("vertex_color", 3, colors[:, :3].astype(np.float32).ravel())
    parameters = mi.traverse(mesh)
    parameters["vertex_positions"] = places.astype(np.float32).ravel()
    parameters["faces"] = triangles.astype(np.uint32).ravel()
    if normals is not None:
        parameters["vertex_normals"] = normals.astype(np.float32).ravel()
    if uvs is not None:
        parameters["vertex_texcoords"] = uvs.astype(np.float32).ravel()
    parameters.update()
    mesh.write_ply(str(path))


def shapes(file, primitive, matrix, stem):
    """A primitive's triangles in the world as shapes of Mitsuba; those whose texture is laid mirrored, of a material with a normal map, are one
    of their own."""
    attributes = {name: file.accessor(index) for name, index in primitive["attributes"].items()}
    places = attributes["POSITION"] @ matrix[:3, :3].T + matrix[:3, 3]
    triangles = file.accessor(primitive["indices"]) if "indices" in primitive else np.arange(len(places))
    triangles = triangles.reshape(-1, 3)[:, :: 1 if np.linalg.det(matrix[:3, :3]) > 0 else -1]
    normals, uvs = attributes.get("NORMAL"), attributes.get("TEXCOORD_0")
    if normals is not None:
        normals = normals @ np.linalg.inv(matrix[:3, :3])
        normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-30)
    material = Material(file, file.json["materials"][primitive["material"]] if "material" in primitive else {})
    mirrored = np.zeros(len(triangles), bool)
    if "normalTexture" in material.source:
        sides = np.diff(uvs[triangles].astype(float), axis=1)
        # v runs down the picture, so that a texture which is not mirrored turns the other way.
        mirrored = np.linalg.det(sides) > 0
    for is_mirrored in (False, True):
        part = triangles[mirrored == is_mirrored]
        if not len(part):
            continue
        path = pathlib.Path(f"{stem}{'m' if is_mirrored else ''}.ply")
        save_ply(path, part, places, normals, uvs, attributes.get("COLOR_0"))
        colored = "COLOR_0" in attributes
        yield path.stem, {
            "type": "ply", "filename": str(path), "face_normals": normals is None, "bsdf": material.bsdf(colored, is_mirrored),
        } | material.emitter() | material.interior()


def sensor(file, args):
    to_world = None
    if args.eye:
        to_world, fov = mi.ScalarTransform4f().look_at(origin=args.eye, target=args.target, up=(0, 1, 0)), args.fov
    else:
        node, matrix = next((node, matrix) for node, matrix in placed_nodes(file) if "camera" in node)
        eye = matrix[:3, 3]
        to_world = mi.ScalarTransform4f().look_at(origin=eye, target=eye - matrix[:3, 2], up=matrix[:3, 1])
        fov = np.degrees(file.json["cameras"][node["camera"]]["perspective"]["yfov"])
    film = {"type": "hdrfilm", "width": WIDTH, "height": HEIGHT, "rfilter": {"type": "gaussian"}, "pixel_format": "rgb"}
    return {"type": "perspective", "fov": float(fov), "fov_axis": "y", "near_clip": 1e-4, "to_world": to_world, "film": film}


def lights(file):
    """Suns of KHR_lights_punctual."""
    for node, matrix in placed_nodes(file):
        if "KHR_lights_punctual" in node.get("extensions", {}):
            light = file.json["extensions"]["KHR_lights_punctual"]["lights"][node["extensions"]["KHR_lights_punctual"]["light"]]
            radiance = light.get("intensity", 1.0) * np.array(light.get("color", (1, 1, 1)))
            yield {"type": "directional", "direction": (-matrix[:3, 2]).tolist(), "irradiance": {"type": "rgb", "value": radiance.tolist()}}


def load(file, args, folder):
    scene = {"type": "scene", "integrator": {"type": "volpath", "max_depth": 32}, "sensor": sensor(file, args)}
    for number, (node, matrix) in enumerate(placed_nodes(file)):
        if "mesh" in node:
            for i, primitive in enumerate(file.json["meshes"][node["mesh"]]["primitives"]):
                scene.update(shapes(file, primitive, matrix, f"{folder}/shape{number}_{i}"))
    scene.update((f"light{i}", light) for i, light in enumerate(lights(file)))
    sky = np.array(mi.Bitmap(args.environment).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32, False))
    # Mitsuba's first column lies where the middle of splatray's does.
    scene["sky"] = {"type": "envmap", "bitmap": mi.Bitmap(np.roll(sky, sky.shape[1] // 2, axis=1))}
    return mi.load_dict(scene)


def main():
    def triple(text):
        return tuple(float(number) for number in text.split(","))

    parser = argparse.ArgumentParser()
    parser.add_argument("scene")
    parser.add_argument("out")
    parser.add_argument("--environment", required=True)
    parser.add_argument("--eye", type=triple)
    parser.add_argument("--target", type=triple)
    parser.add_argument("--fov", type=float)
    parser.add_argument("--samples", type=int, default=256)
    parser.add_argument("--variant", default="llvm_ad_rgb")
    args = parser.parse_args()
    mi.set_variant(args.variant)
    with tempfile.TemporaryDirectory() as folder:
        picture = mi.render(load(File(args.scene), args, folder), spp=args.samples)
    mi.util.write_bitmap(args.out, picture, write_async=False)


if __name__ == "__main__":
    main()
