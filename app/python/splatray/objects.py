"""Objects as arrays: points and meshes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any, Dict, Optional, Tuple

import numpy as np

from . import _check, _core
from .look import Material

MOST_COLOR = 1.01  # more than rounding makes of 1


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


def _attributes(given: Any) -> Dict[str, np.ndarray]:
    if given is None:
        return {}
    if not isinstance(given, Mapping):
        raise TypeError(f"attributes: found {given!r}, expected a dict of names to arrays")
    return {_check.text("attributes", name): _check.numbers(f"attributes[{name!r}]", values, np.float64) for name, values in given.items()}


def _indices(triangles: Any, vertices: int) -> np.ndarray:
    """uint32 (n, 3), each below the number of vertices."""
    found = np.asarray(triangles)
    if found.dtype.kind not in "iu":
        raise TypeError(f"triangles: found {found.dtype}, expected an array of whole numbers")
    if found.ndim != 2 or found.shape[1] != 3 or not len(found):
        raise ValueError(f"triangles: found an array of shape {found.shape}, expected (n, 3)")
    wrong = np.argwhere((found < 0) | (found >= vertices))
    if len(wrong):
        raise ValueError(f"triangles: found vertex {found[tuple(wrong[0])]} in triangle {wrong[0][0]}, expected 0 to {vertices - 1}")
    return np.ascontiguousarray(found, dtype=np.uint32)


class _Arrays:
    """What points and meshes share: arrays in the types of the core, checked when the object is made."""

    def _convert(self, positions: str) -> None:
        """Converts all fields but the triangles; `positions` is the name of that of the places."""
        converters = {positions: lambda value: _check.rows(positions, value, np.float64),
                      "normals": lambda value: _check.rows("normals", value, np.float32), "colors": _linear_colors,
                      "radii": lambda value: _check.numbers("radii", value, np.float32), "attributes": _attributes,
                      "name": lambda value: _check.text("name", value), "material": _material, "scanned": bool}
        for name, convert in converters.items():
            value = getattr(self, name, None)
            if value is not None or name in (positions, "attributes"):
                object.__setattr__(self, name, convert(value))
        count = len(getattr(self, positions))
        beside = {name: getattr(self, name, None) for name in ("normals", "colors", "radii")}
        for name, values in (beside | getattr(self, "attributes")).items():
            if values is not None and len(values) != count:
                raise ValueError(f"{name}: found {len(values)}, expected as many as the {count} {'vertices' if positions == 'vertices' else 'points'}")

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        return all(_is_same(getattr(self, field.name), getattr(other, field.name)) for field in fields(self))  # type: ignore[arg-type]

    __hash__ = None  # type: ignore[assignment]


def _is_same(mine: Any, theirs: Any) -> bool:
    if isinstance(mine, dict) and isinstance(theirs, dict):
        return list(mine) == list(theirs) and all(_is_same(mine[name], theirs[name]) for name in mine)
    if isinstance(mine, np.ndarray) and isinstance(theirs, np.ndarray):
        return np.array_equal(mine, theirs, equal_nan=True)
    return type(mine) is type(theirs) and mine == theirs


def _material(value: Any) -> Material:
    if not isinstance(value, Material):
        raise TypeError(f"material: found {value!r}, expected a splatray.Material")
    return value


@dataclass(frozen=True, eq=False)
class Points(_Arrays):
    """An object of points. Arrays may be of any type, stride and order of bytes; those that are of the type named are not copied until a
    scene is made of them.

    xyz: float64 (n, 3), world units; points that are masked or not finite are left out, and Scene.notes says so. normals: float32 (n, 3),
    of any length; zero, masked or NaN: estimated. colors: float32 (n, 3), linear in 0..1, or uint8 and uint16, which are sRGB over the
    type's range; floats up to 1.01 and below 0 are clamped, larger ones refused. radii: float32 (n,), world units; zero, negative or NaN:
    chosen. attributes: names to float64 (n,), at most 31: "intensity", "class" and any others, which color_by shows and hide_class looks at;
    a number that is not finite is 0. scanned: whether they come from a scanner, whose strays are left out and noise is smoothed; None where
    there are no normals.
    """

    xyz: Any
    normals: Any = None
    colors: Any = None
    radii: Any = None
    attributes: Any = None
    name: str = "points"
    material: Optional[Material] = None
    scanned: Optional[bool] = None

    def __post_init__(self) -> None:
        self._convert("xyz")

    def _to_core(self) -> Tuple[Any, ...]:
        return (self.xyz, None, self.normals, self.colors, self.radii, list(self.attributes.items()), self.name,
                self.material and self.material._to_core(), self.scanned)


@dataclass(frozen=True, eq=False)
class Mesh(_Arrays):
    """An object of triangles, the same as a file of them. Points lie at its vertices, or by area where triangles are large or
    `mesh_points` asks for a number of points.

    vertices: float64 (n, 3), world units; triangles with one that is not finite are left out, and Scene.notes says so. triangles: whole
    numbers (m, 3), vertices anticlockwise seen from outside. normals, colors, attributes: of the vertices, as those of Points; interpolated,
    but of attributes that are all whole and at most 65535 a point has the nearest vertex's. material: closed glass is turned outwards.
    """

    vertices: Any
    triangles: Any
    normals: Any = None
    colors: Any = None
    attributes: Any = None
    name: str = "mesh"
    material: Optional[Material] = None

    def __post_init__(self) -> None:
        self._convert("vertices")
        object.__setattr__(self, "triangles", _indices(self.triangles, len(self.vertices)))

    def _to_core(self) -> Tuple[Any, ...]:
        return (self.vertices, self.triangles, self.normals, self.colors, None, list(self.attributes.items()), self.name,
                self.material and self.material._to_core(), None)
