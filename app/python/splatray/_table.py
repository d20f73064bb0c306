"""The table of fields, as Python has it: names, groups and types. Needs nothing but the core."""

from __future__ import annotations

from typing import Dict, List

from . import _core

FIELDS: Dict[str, _core.FieldInfo] = {field.name.replace("-", "_"): field for field in _core.fields()}
LIGHTS = ("light", "sun", "area_light", "lights")  #: that the argument lights stands for
#: Fields of how a scene is read and made.
OPENING: List[str] = [name for name, field in FIELDS.items() if field.opens]
#: Fields of a picture of it.
PICTURES: List[str] = [name for name, field in FIELDS.items() if field.renders and name not in LIGHTS]

#: Fields of files that are made of it.
FILES: List[str] = PICTURES + [name for name, field in FIELDS.items() if field.group == "Output" and name not in ("output", "aov")]


def annotation_of(field: _core.FieldInfo) -> str:
    """The type of a field's value, for people and type checkers."""
    if field.repeated:
        return "Optional[Union[str, Sequence[str]]]"
    names = field.value.split("|")
    if len(names) > 1 and all(name == name.lower() for name in names) and field.kind != "flag":
        return f"Optional[Literal[{', '.join(map(repr, names))}]]"
    return {"flag": "Optional[bool]", "number": "Optional[float]", "whole": "Optional[int]"}.get(
        field.kind, "Optional[Union[str, float, Sequence[float], PathLike[str]]]")


def stub() -> str:
    """_fields.pyi: the types of the fields that open() and points(), render(), and make() take."""
    lines = ["from os import PathLike", "from typing import Literal, Optional, Sequence, TypedDict, Union", ""]
    for name, fields in (("OpeningFields", OPENING), ("PictureFields", PICTURES), ("FileFields", FILES)):
        lines += ["", f"class {name}(TypedDict, total=False):"]
        lines += [f"    {field}: {annotation_of(FIELDS[field])}" for field in fields] + [""]
    return "\n".join(lines)
