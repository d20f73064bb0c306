"""Scenes: opened from files, made of arrays, shown and traced."""

from __future__ import annotations

import errno
import os
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, Dict, List, Literal, Mapping, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np

from . import _check, _core
from .camera import Camera
from .image import Image
from .look import Light, Material
from .objects import Mesh, Points
from .request import FILES, OPENING, PICTURES, Request, checked, takes_fields

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._fields import FileFields, OpeningFields, PictureFields

Path = Union[str, "os.PathLike[str]"]


class Hits(NamedTuple):
    """What rays hit, an element a ray.

    t: float64 (n,), distance from the origin in world units, inf on a miss. normal: float32 (n, 3), unit, against the ray, 0 on a miss.
    object: int32 (n,), index into Scene.objects. splat: int64 (n,), the first disc hit, index into Scene.splats. point: int64 (n,), which
    of its object's Points that disc is, -1 for meshes and files. The last three are -1 on a miss.
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


class MeasureValue(NamedTuple):
    """A value; the half-width of its 95 % confidence interval; "length", "area" or "degrees"."""

    value: float
    within: float
    unit: str


class Measure(NamedTuple):
    """points: float64 (n, 3), the places on the surface. values: by name, such as "distance", "area", "radius"."""

    points: np.ndarray
    values: Dict[str, MeasureValue]


class Made(NamedTuple):
    """What Scene.make has written. files: names; choices: as Image.choices; notes: sentences."""

    files: List[str]
    choices: Dict[str, str]
    notes: List[str]


class Scene:
    """Splats in an octree; it never changes. open(), make_scene() and points() make scenes. Usable from several threads at once, and in `with`."""

    def __init__(self, core: _core.Scene) -> None:
        if not isinstance(core, _core.Scene):
            raise TypeError("scenes are made by splatray.open, splatray.make_scene and splatray.points")
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

    @takes_fields(PICTURES)
    def render(self, camera: Optional[Camera] = None, size: Tuple[int, int] = (1280, 720), *, lights: Optional[Sequence[Light]] = None,
               materials: Optional[Mapping[str, Material]] = None, request: Optional[Request] = None,
               progress: Optional[_check.Progress] = None, **fields: "Unpack[PictureFields]") -> Image:
        """The picture of the scene, the same as splatray-render's; the same arguments and device give the same bits.

        camera: None for what suits the scene (or eye, target, view ...). size: (width, height), pixels, to 32768. lights: None for the
        scene's own, or a key light. materials: by object's name, in place of the scene's. request: what else is asked for; its camera, size,
        lights and materials where none are given here.
        """
        core = self._open_core()
        checked("render", fields, PICTURES)
        asked = Request() if request is None else request.replace()
        if camera is not None and not isinstance(camera, Camera):
            raise TypeError(f"camera: found {camera!r}, expected a splatray.Camera")
        if request is None or size != (1280, 720):
            asked._set({"resolution": _check.size(size)})
        _check_objects(core, materials)
        asked._set({"camera": camera, "lights": lights, "materials": materials} | fields)
        return Image(core.render(asked._core, _check.progress(progress)))

    @takes_fields(FILES)
    def make(self, output: Path, camera: Optional[Camera] = None, *, lights: Optional[Sequence[Light]] = None,
             materials: Optional[Mapping[str, Material]] = None, request: Optional[Request] = None,
             progress: Optional[_check.Progress] = None, **fields: "Unpack[FileFields]") -> Made:
        """Writes what is asked for to a file, as splatray-render does, with what made it inside: a picture, a sequence (turntable,
        camera_path), a page (orbit, .html) or a drawing to scale (sheet, .png .tif .svg .pdf .exr).

        output: the file's name, of a sequence with #### where the number goes. Else as render(); resolution: the picture's size. Drawings
        other than .png and .exr need splatray-sheet, which wheels do not have.
        """
        core = self._open_core()
        checked("make", fields, FILES)
        asked = Request() if request is None else request.replace()
        _check_objects(core, materials)
        asked._set({"output": _check.path("output", output), "camera": camera, "lights": lights, "materials": materials} | fields)
        try:
            files, choices, notes = core.make(asked._core, _check.progress(progress))
        except RuntimeError as error:
            raise OSError(str(error)) from None
        return Made(files, dict(choices), notes)

    def trace(self, origins: Any, directions: Any, *, t_max: Any = None, progress: Optional[_check.Progress] = None) -> Hits:
        """Traces rays exactly, as brute force over all discs would.

        origins, directions: (n, 3) each, or one of them (3,) for all rays; float64 and float32 arrays are not copied. Directions have any
        length above 0. t_max: number or (n,), world units: rays whose first disc is not nearer than that miss. t of the hits is float32
        where both arrays are.
        """
        core = self._open_core()
        rays = _rays(origins, directions, t_max)
        hits = Hits(*core.trace(*rays, _check.progress(progress)))
        return hits._replace(t=hits.t.astype(np.float32)) if rays[0].dtype == np.float32 else hits

    def occluded(self, origins: Any, directions: Any, *, t_max: Any = None, progress: Optional[_check.Progress] = None) -> np.ndarray:
        """Whether rays hit anything nearer than t_max: bool (n,), of rays as trace() takes them, in less time.

        Between two places: origins a, directions b - a, t_max the distance less a little, as surfaces at b count too.
        """
        core = self._open_core()
        return core.occluded(*_rays(origins, directions, t_max), _check.progress(progress))

    def measure(self, kind: Literal["point", "distance", "horizontal", "vertical", "angle", "area", "sphere", "cylinder", "plane", "volume"], places: Sequence[Any], *,
                reach: float = 0.0, base: str = "", request: Optional[Request] = None, progress: Optional[_check.Progress] = None) -> Measure:
        """Measures on the surface, as splatray-measure does: each value with its interval.

        places: each (x, y, z), which goes to the nearest surface, or ((x, y, z), (dx, dy, dz)), a ray, whose first hit counts: one, two and
        more, two, two, three, or three and more of them; of volumes the outline, or none for all that the region holds. reach: of spheres,
        cylinders and planes, how far around the place, world units. base: of volumes, what the surface is compared with: "z=HEIGHT",
        "plane=X,Y,Z,NX,NY,NZ", "corners" (the plane through the places on the surface) or "earlier=FILE". request: its region (keep_box,
        drop_box, cut).
        """
        core = self._open_core()
        if isinstance(places, (str, bytes)) or not isinstance(places, Iterable):
            raise TypeError(f"places: found {places!r}, expected a list of places")
        asked = Request() if request is None else request
        points, values = core.measure(kind, [_place(place) for place in places], float(reach), base, asked._core, _check.progress(progress))
        return Measure(points, {name: MeasureValue(*rest) for name, *rest in values})


def _rays(origins: Any, directions: Any, t_max: Any) -> Tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Origins and directions as many and of one type, and where rays end: one number of each, or none."""
    single = all(getattr(value, "dtype", None) == np.float32 for value in (origins, directions))
    number_type = np.float32 if single else np.float64
    given = [_check.array(name, value, number_type) for name, value in (("origins", origins), ("directions", directions))]
    count = max((len(value) for value in given if value.ndim == 2), default=1)
    origins, directions = (_check.rows(name, np.broadcast_to(value, (count, 3)) if value.shape == (3,) else value, number_type)
                           for name, value in zip(("origins", "directions"), given))
    if len(origins) != len(directions):
        raise ValueError(f"found {len(origins)} origins and {len(directions)} directions, expected as many of each")
    ends = _check.numbers("t_max", np.zeros(0) if t_max is None else np.atleast_1d(t_max), np.float64)
    return origins, directions, ends


def _place(place: Any) -> Tuple[Tuple[float, ...], Optional[Tuple[float, ...]]]:
    """A place and, of a ray, its direction."""
    try:
        numbers = np.asarray(place, dtype=np.float64)
    except (TypeError, ValueError):
        numbers = np.zeros(0)
    if numbers.shape == (3,):
        return tuple(numbers.tolist()), None
    if numbers.shape == (2, 3):
        return tuple(numbers[0].tolist()), tuple(numbers[1].tolist())
    raise ValueError(f"places: found {place!r}, expected (x, y, z) or ((x, y, z), (dx, dy, dz))")


def _check_objects(core: _core.Scene, materials: Optional[Mapping[str, Material]]) -> None:
    for name in materials if isinstance(materials, Mapping) else ():
        if name not in core.objects:
            raise ValueError(f"materials: found object {name!r}, expected one of {core.objects}")


@takes_fields(OPENING)
def open(files: Union[Path, Sequence[Path]], *, materials: Optional[Mapping[str, Material]] = None, request: Optional[Request] = None,
         progress: Optional[_check.Progress] = None, **fields: "Unpack[OpeningFields]") -> Scene:
    """Reads a scene, model or scan, or several in one scene, or a folder of scans.

    materials: by object's name, in place of the file's. request: what else is asked for of the scene.
    """
    if isinstance(files, (str, bytes, os.PathLike)) or not isinstance(files, Iterable):
        files = [files]
    paths = [_check.path("files", path) for path in files]
    for path in paths:
        if not os.path.exists(path):
            raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), path)
    return Scene(_core.open(paths, _opening("open", request, fields | {"materials": materials})._core, _check.progress(progress)))


def _opening(function: str, request: Optional[Request], fields: Mapping[str, Any]) -> Request:
    checked(function, fields, OPENING + ["materials"])
    return (Request() if request is None else request.replace())._set(fields)


def make_picture(request: Request, *, progress: Optional[_check.Progress] = None) -> Image:
    """The picture of the files that the request names as `inputs`."""
    if not isinstance(request, Request):
        raise TypeError(f"request: found {request!r}, expected a splatray.Request")
    return Image(_core.make_picture(request._core, _check.progress(progress)))


@takes_fields(OPENING)
def make_scene(objects: Union[Points, Mesh, Sequence[Union[Points, Mesh]]], *, materials: Optional[Mapping[str, Material]] = None,
               request: Optional[Request] = None, progress: Optional[_check.Progress] = None, **fields: "Unpack[OpeningFields]") -> Scene:
    """A scene of arrays, which are copied: one object or several, points and meshes. up: z unless given.

    materials: by object's name, in place of the objects' own. request: what else is asked for of the scene.
    """
    listed = [objects] if isinstance(objects, (Points, Mesh)) else objects
    if isinstance(listed, (str, bytes)) or not isinstance(listed, Iterable):
        raise TypeError(f"objects: found {objects!r}, expected splatray.Points or splatray.Mesh, one or several")
    arrays = []
    for item in listed:
        if not isinstance(item, (Points, Mesh)):
            raise TypeError(f"objects: found {item!r}, expected splatray.Points or splatray.Mesh")
        arrays.append(item._to_core())
    asked = _opening("make_scene", request, fields | {"materials": materials})
    return Scene(_core.make_scene(arrays, asked._core, _check.progress(progress)))


@takes_fields(OPENING)
def points(xyz: Any, *, normals: Any = None, colors: Any = None, radii: Any = None, attributes: Optional[Mapping[str, Any]] = None,
           name: str = "points", material: Optional[Material] = None, scanned: Optional[bool] = None,
           progress: Optional[_check.Progress] = None, **fields: "Unpack[OpeningFields]") -> Scene:
    """A scene of one object of points: make_scene(Points(...)), which says what the arrays are. up: z unless given."""
    return make_scene(Points(xyz, normals, colors, radii, attributes, name, material, scanned), progress=progress,
                      request=_opening("points", None, fields))
