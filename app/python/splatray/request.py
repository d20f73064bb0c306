"""What is asked for: values of named fields, the same as the options of splatray-render."""

from __future__ import annotations

import difflib
import inspect
import os
from collections.abc import Iterable, Mapping
from typing import Any, Callable, List, TypeVar

import numpy as np

from . import _check, _core
from ._table import FIELDS, FILES, OPENING, PICTURES, annotation_of
from .camera import Camera
from .look import Light, Material

Function = TypeVar("Function", bound=Callable[..., Any])
SEPARATORS = {"resolution": "x", "orbit": "x", "tile": "/"}


def text_of(name: str, value: Any) -> str:
    """The text of a field's value."""
    if isinstance(value, (bool, np.bool_)):
        return "on" if value else "off"
    kind, words = FIELDS[name].kind, FIELDS[name].value
    if isinstance(value, str):
        if kind != "text":
            raise TypeError(f"{name}: found {value!r}, expected a number")
        return value
    if isinstance(value, os.PathLike):
        return _check.path(name, value)
    if isinstance(value, Iterable):
        return SEPARATORS.get(name, ",").join(text_of(name, item) for item in value)
    if kind == "text" and ("FILE" in words or "NAME" in words):
        raise TypeError(f"{name}: found {value!r}, expected a text such as {words}")
    number = _check.number(name, value)
    if kind == "whole":
        return str(_check.whole(name, value, int(FIELDS[name].least), int(FIELDS[name].most)))
    return repr(int(number)) if number == int(number) and abs(number) < 2**53 and isinstance(value, (int, np.integer)) else repr(number)


class Request:
    """What is asked for of a scene and its picture; a value. Fields are named as the options of splatray-render, with _ for -:

        request = splatray.Request(inputs=["scan.laz"], resolution=(1280, 720), samples=64, lights=[splatray.sun((0, 0, 1))])
        image = splatray.make_picture(request)

    camera: a Camera, in place of eye, target, camera_up, fov and ortho_height. lights: Lights, in place of the scene's. materials: a dict
    of objects' names to Materials. All that is not set is left to what suits the scene.
    """

    def __init__(self, **fields: Any) -> None:
        self._core = _core.Request()
        self._set(fields)

    def _set(self, fields: Mapping[str, Any]) -> "Request":
        for name, value in fields.items():
            if value is None:
                continue
            if name == "camera":
                self._core.set_camera(_check_type(Camera, name, value)._to_core())
            elif name == "lights":
                self._set_lights(value)
            elif name == "materials":
                self._add_materials(value)
            elif name not in FIELDS:
                raise TypeError(f"found a field {name!r}{meant(name, [*FIELDS, 'camera', 'lights', 'materials'])}")
            elif FIELDS[name].repeated:
                self._set_values(name, value)
            else:
                self._core.set(name, text_of(name, value))
        return self

    def _set_values(self, name: str, values: Any) -> None:
        single = isinstance(values, (str, bytes, os.PathLike)) or not isinstance(values, Iterable)
        for i, value in enumerate([values] if single else values):
            (self._core.add if i else self._core.set)(name, text_of(name, value))

    def _set_lights(self, lights: Any) -> None:
        if isinstance(lights, str) or not isinstance(lights, Iterable):
            raise TypeError(f"lights: found {lights!r}, expected a list of splatray.Light")
        self._core.set("lights", "none")
        for light in lights:
            kind, text = _check_type(Light, "lights", light)._to_field()
            self._core.add(kind, text)

    def _add_materials(self, materials: Any) -> None:
        if not isinstance(materials, Mapping):
            raise TypeError(f"materials: found {materials!r}, expected a dict of object names to materials")
        for name, value in materials.items():
            self._core.add_material(_check.text("materials", name), _check_type(Material, "materials", value)._to_core())

    def replace(self, **fields: Any) -> "Request":
        """A copy with other values of these fields."""
        return Request._of_core(self._core.copy())._set(fields)

    def get(self, name: str) -> List[str]:
        """The texts of a field; empty if it is unset and has no default in numbers."""
        return self._core.get(name)

    def json(self) -> str:
        """All that is set, as splatray-render --request reads it."""
        return self._core.json()

    @classmethod
    def from_json(cls, text: str) -> "Request":
        return cls._of_core(_core.Request.from_json(_check.text("text", text)))

    @classmethod
    def of_picture(cls, path: Any) -> "Request":
        """What a picture that a splatray program wrote keeps."""
        return cls._of_core(_core.Request.of_picture(_check.path("path", path)))

    @classmethod
    def _of_core(cls, core: _core.Request) -> "Request":
        made = cls()
        made._core = core
        return made

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Request) and self.json() == other.json()

    def __reduce__(self) -> Any:
        return Request.from_json, (self.json(),)

    def __repr__(self) -> str:
        return f"splatray.Request.from_json({self.json()!r})"


def _check_type(kind: type, name: str, value: Any) -> Any:
    if not isinstance(value, kind):
        raise TypeError(f"{name}: found {value!r}, expected a splatray.{kind.__name__}")
    return value


def takes_fields(names: List[str]) -> Callable[[Function], Function]:
    """Makes these fields part of what a function's signature and docstring say of its last parameter, `**fields`."""

    def decorate(function: Function) -> Function:
        signature = inspect.signature(function)
        own = [parameter for parameter in signature.parameters.values() if parameter.kind != inspect.Parameter.VAR_KEYWORD]
        ours = [inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=None, annotation=annotation_of(FIELDS[name]))
                for name in names if name not in signature.parameters]
        function.__signature__ = signature.replace(parameters=own + ours)  # type: ignore[attr-defined]
        lines = [f"    {name}: {FIELDS[name].help}." for name in names if name not in signature.parameters]
        function.__doc__ = f"{inspect.cleandoc(function.__doc__ or '')}\n\nFields; None leaves one to what suits the scene:\n" + "\n".join(lines)
        return function

    return decorate


def meant(name: str, names: Iterable[str]) -> str:
    """The end of a sentence about a name that is none of `names`: the nearest of them, or all where none is near."""
    near = difflib.get_close_matches(name, names, 1)
    return f"; did you mean {near[0]!r}?" if near else f", expected one of {', '.join(names)}"


def checked(function: str, fields: Mapping[str, Any], names: Iterable[str]) -> Mapping[str, Any]:
    """The fields, all of which must be among `names`."""
    for name in fields:
        if name not in names:
            raise TypeError(f"{function}() found the argument {name!r}{meant(name, names)}")
    return fields

