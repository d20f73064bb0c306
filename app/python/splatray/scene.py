"""Scenes: opened from files, made of arrays, shown and traced."""

from __future__ import annotations

import errno
import os
from collections.abc import Iterable
from typing import Any, Dict, List, Mapping, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np

from . import _check, _core
from .camera import Camera, Vector, frame
from .image import Image
from .look import Light, Material

Path = Union[str, "os.PathLike[str]"]

MOST_COLOR = 1.01  # more than rounding makes of 1
STYLES = ("auto", "paper", "lit", "clay", "ao", "scan")


class Hits(NamedTuple):
    """What rays hit, an element a ray.

    t: float64 (n,), distance from the origin in world units, inf on a miss. normal: float32 (n, 3), unit, against the ray, 0 on a miss.
    object: int32 (n,), index into Scene.objects. splat: int64 (n,), the first disc hit, index into Scene.splats. point: int64 (n,), which
    of the points given to points() that disc is, -1 for files. The last three are -1 on a miss.
    """

    t: np.ndarray
    normal: np.ndarray
    object: np.ndarray
    splat: np.ndarray
    point: np.ndarray


class Splats(NamedTuple):
    """A scene's discs: center and normal, float64 (n, 3), radius, float64 (n,), world units; object, int32 (n,)."""

    center: np.ndarray
    normal: np.ndarray
    radius: np.ndarray
    object: np.ndarray


class Scene:
    """Splats in an octree; it never changes. open() and points() make scenes. Usable from several threads at once, and in `with`."""

    def __init__(self, core: _core.Scene) -> None:
        if not isinstance(core, _core.Scene):
            raise TypeError("scenes are made by splatray.open and splatray.points")
        self._core: Optional[_core.Scene] = core

    def _open_core(self) -> _core.Scene:
        core = self._core
        if core is None:
            raise ValueError("the scene is closed")
        return core

    def close(self) -> None:
        """Frees the scene's memory, on the device too, as soon as no call uses it."""
        self._core = None

    def __enter__(self) -> "Scene":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    @property
    def bounds(self) -> np.ndarray:
        """float64 (2, 3): lowest and highest corner of the box of the discs' centres."""
        return np.array(self._open_core().bounds)

    @property
    def up(self) -> np.ndarray:
        """float64 (3,), unit."""
        return np.array(self._open_core().up)

    @property
    def objects(self) -> List[str]:
        """Names."""
        return self._open_core().objects

    @property
    def materials(self) -> Dict[str, Material]:
        """Of each object, by name."""
        core = self._open_core()
        return {name: Material._of_core(value) for name, value in zip(core.objects, core.materials)}

    @property
    def notes(self) -> List[str]:
        """Sentences about what is odd in the files or arrays."""
        return self._open_core().notes

    @property
    def device(self) -> str:
        """The device's name; the first use opens it."""
        return self._open_core().device

    @property
    def splats(self) -> Splats:
        """The discs as they are traced; a copy."""
        return Splats(*self._open_core().splats())

    def __len__(self) -> int:
        """Number of discs."""
        return self._open_core().splat_count

    def __repr__(self) -> str:
        return "<splatray.Scene, closed>" if self._core is None else f"<splatray.Scene of {len(self)} splats>"

    def save(self, path: Path) -> None:
        """Writes splatray's scene file (.soct), which opens without preprocess."""
        core = self._open_core()
        try:
            core.save(_check.path("path", path))
        except RuntimeError as error:
            raise OSError(str(error)) from None

    def render(self, camera: Optional[Camera] = None, size: Tuple[int, int] = (1280, 720), *, samples: int = 16, seed: int = 1,
               bounces: int = 8, shadows: bool = True, channels: bool = False, look: str = "auto", lights: Optional[Sequence[Light]] = None,
               environment: str = "", environment_strength: float = 1.0, environment_turn: float = 0.0,
               materials: Optional[Mapping[str, Material]] = None, progress: Optional[_check.Progress] = None) -> Image:
        """The picture of the scene; the same arguments and device give the same bits.

        camera: None for frame(). size: (width, height), pixels, to 32768. samples: a pixel, to 65536. bounces: mirror and glass rays in
        a path, to 64. channels: also depth, normal and object. look: lit (path tracing), paper (highlights, mirrors, glass and hard shadows:
        quick), clay (all matt and grey), ao (ambient occlusion), scan (colours under ambient occlusion and the lights), auto for scan or lit. lights: None for the scene's own, or a key light. environment: file of a
        latitude-longitude picture, or studio, white, black, or a radiance "r,g,b"; empty for the scene's, else the studio.
        environment_turn: turns about up, 1 = a full one. materials: by object's name, in place of the scene's.
        """
        core = self._open_core()
        width, height = _check.size(size)
        camera = frame(self, aspect=width / height) if camera is None else camera
        if not isinstance(camera, Camera):
            raise TypeError(f"camera: found {camera!r}, expected a splatray.Camera")
        style = _check.choice("look", look, STYLES)
        shown = _core.Look()
        shown.style = style
        shown.lights = None if lights is None else [_to_core(Light, "lights", light) for light in lights]
        shown.environment = _check.path("environment", environment)
        shown.environment_strength = _check.number("environment_strength", environment_strength)
        shown.environment_turn = _check.number("environment_turn", environment_turn)
        shown.materials = _materials(core, materials)
        settings = _core.Settings()
        settings.samples = _check.whole("samples", samples, 1, 65536)
        settings.seed = _check.whole("seed", seed, 0, 2**32 - 1)
        settings.bounces = _check.whole("bounces", bounces, 0, 64)
        settings.shadows = bool(shadows)
        settings.channels = bool(channels)
        return Image(core.render(camera._to_core(), width, height, shown, settings, _check.progress(progress)))

    def trace(self, origins: Any, directions: Any, *, progress: Optional[_check.Progress] = None) -> Hits:
        """Traces rays exactly, as brute force over all discs would.

        origins, directions: (n, 3) each, or one of them (3,) for all rays; float64 arrays are not copied. Directions have any length
        above 0.
        """
        core = self._open_core()
        given = [_check.array(name, value, np.float64) for name, value in (("origins", origins), ("directions", directions))]
        count = max((len(value) for value in given if value.ndim == 2), default=1)
        origins, directions = (_check.rows(name, np.broadcast_to(value, (count, 3)) if value.shape == (3,) else value, np.float64)
                               for name, value in zip(("origins", "directions"), given))
        if len(origins) != len(directions):
            raise ValueError(f"found {len(origins)} origins and {len(directions)} directions, expected as many of each")
        return Hits(*core.trace(origins, directions, _check.progress(progress)))


def _to_core(kind: type, name: str, value: Any) -> Any:
    if not isinstance(value, kind):
        raise TypeError(f"{name}: found {value!r}, expected a splatray.{kind.__name__}")
    return value._to_core()


def _materials(core: _core.Scene, materials: Optional[Mapping[str, Material]]) -> List[_core.Material]:
    if materials is None:
        return []
    if not isinstance(materials, Mapping):
        raise TypeError(f"materials: found {materials!r}, expected a dict of object names to materials")
    names, all_materials = core.objects, core.materials
    for name, value in materials.items():
        if name not in names:
            raise ValueError(f"materials: found object {name!r}, expected one of {names}")
        changed = _to_core(Material, "materials", value)
        all_materials = [changed if other == name else kept for other, kept in zip(names, all_materials)]
    return all_materials


def _options(radius_scale: float, up: Optional[Vector], threads: int, device: str, cache: Optional[Path],
             color_by: str) -> _core.OpenOptions:
    options = _core.OpenOptions()
    options.radius_scale = _check.number("radius_scale", radius_scale)
    options.up = None if up is None else _check.vector("up", up)
    options.threads = _check.whole("threads", threads, 0, 4096)
    options.device = _check.text("device", device)
    options.cache = "" if cache is None else _check.path("cache", cache)
    options.color_by = _check.text("color_by", color_by)
    return options


def open(files: Union[Path, Sequence[Path]], *, radius_scale: float = 1.0, mesh_points: int = 0, data: Sequence[Path] = (),
         color_by: str = "", up: Optional[Vector] = None, threads: int = 0, device: str = "", cache: Optional[Path] = None,
         progress: Optional[_check.Progress] = None) -> Scene:
    """Reads a scene, model or scan, or several in one scene, or a folder of scans.

    radius_scale: factor on every disc's radius. mesh_points: sampled on meshes by area; 0 for their vertices where fine enough. data:
    folders searched for models that a scene names. color_by: an attribute shown as colours, such as height, intensity or class. up: up
    direction, None for the file's own. threads: of reading, preprocess and device="cpu", 0 for all cores. device: number or part of a name of devices(),
    empty for the best, "cpu" for the processors without Vulkan. cache: folder that compiled pipelines are kept in between runs.
    """
    if isinstance(files, (str, bytes, os.PathLike)) or not isinstance(files, Iterable):
        files = [files]
    paths = [_check.path("files", path) for path in files]
    for path in paths:
        if not os.path.exists(path):
            raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), path)
    options = _options(radius_scale, up, threads, device, cache, color_by)
    options.mesh_points = _check.whole("mesh_points", mesh_points, 0, 2**32 - 1)
    options.data = [_check.path("data", folder) for folder in data]
    return Scene(_core.open(paths, options, _check.progress(progress)))


def _linear_colors(colors: Any) -> np.ndarray:
    """float32 (n, 3), linear; uint8 and uint16 are sRGB, as files have them."""
    given = np.asarray(colors)
    linear = _check.rows("colors", colors, np.float32)
    if given.dtype in (np.uint8, np.uint16):
        encoded = linear / np.float32(np.iinfo(given.dtype).max)
        linear = np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)
    if not np.isfinite(linear).all():
        raise ValueError("colors: found some that are masked or not finite, expected 0 to 1")
    if linear.size and linear.max() > MOST_COLOR:
        raise ValueError(f"colors: found {given.dtype} up to {linear.max():g}, expected linear values of 0 to 1, or uint8 or uint16, which are sRGB")
    return np.ascontiguousarray(linear, dtype=np.float32)


def points(xyz: Any, *, normals: Any = None, colors: Any = None, radii: Any = None, name: str = "points",
           material: Optional[Material] = None, scanned: Optional[bool] = None, radius_scale: float = 1.0, up: Optional[Vector] = None,
           threads: int = 0, device: str = "", cache: Optional[Path] = None, progress: Optional[_check.Progress] = None) -> Scene:
    """A scene of arrays, which are copied.

    xyz: (n, 3), world units; points that are masked or not finite are left out, and Scene.notes says so. normals: (n, 3), of any length; zero, masked or NaN:
    estimated. colors: (n, 3), linear in 0..1, or uint8 and uint16, which are sRGB. radii: (n,), world units; zero, negative or NaN: chosen.
    scanned: whether they come from a scanner, whose strays are left out and noise is smoothed; None where there are no normals. up: z unless
    given. The others are those of open().
    """
    options = _options(radius_scale, up, threads, device, cache, "")
    positions = _check.rows("xyz", xyz, np.float64)
    given_radii = None if radii is None else _check.array("radii", radii, np.float32)
    if given_radii is not None and given_radii.ndim != 1:
        raise ValueError(f"radii: found an array of shape {given_radii.shape}, expected (n,)")
    rows = {"normals": None if normals is None else _check.rows("normals", normals, np.float32),
            "colors": None if colors is None else _linear_colors(colors), "radii": given_radii}
    for kind, values in rows.items():
        if values is not None and len(values) != len(positions):
            raise ValueError(f"{kind}: found {len(values)}, expected as many as the {len(positions)} points")
    return Scene(_core.make_scene(positions, rows["normals"], rows["colors"], rows["radii"], _check.text("name", name),
                                  None if material is None else _to_core(Material, "material", material),
                                  None if scanned is None else bool(scanned), options, _check.progress(progress)))
