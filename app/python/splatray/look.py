"""Materials and lights."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Optional, Tuple

from . import _check, _core

Color = Tuple[float, float, float]
Vector = Tuple[float, float, float]


@dataclass(frozen=True)
class Material:
    """What an object is made of. Colours are linear, 0..1.

    diffuse: reflectance, times the points' colours where they have some. specular, shininess: share of light in Phong's highlight, and
    its exponent. mirror, tint: share of light mirrored, and its colour; of glass, transmittance of each crossing. ior: index of refraction
    of glass, whose object must be closed with normals outwards. two_sided: both faces are seen. hidden: no ray hits it. Of path tracing, None for what
    follows from these, the numbers of the look "paper": metallic, roughness (glTF's), coat, coat_roughness (a clear layer), 0..1; emission: radiance sent out.
    """

    diffuse: Color = (0.64, 0.61, 0.57)
    specular: float = 0.05
    shininess: float = 40.0
    tint: Color = (1.0, 1.0, 1.0)
    mirror: float = 0.0
    ior: float = 1.5
    glass: bool = False
    two_sided: bool = True
    hidden: bool = False
    metallic: Optional[float] = None
    roughness: Optional[float] = None
    coat: Optional[float] = None
    coat_roughness: Optional[float] = None
    emission: Optional[Color] = None

    def __post_init__(self) -> None:
        for field in fields(self):
            value = getattr(self, field.name)
            if value is None and field.default is None:
                continue
            if field.name in ("diffuse", "tint", "emission"):
                value = _check.color(field.name, value)
            elif field.name in ("glass", "two_sided", "hidden"):
                value = bool(value)
            else:
                value = _check.number(field.name, value)
            object.__setattr__(self, field.name, value)

    def _to_core(self) -> _core.Material:
        core = _core.Material()
        for field in fields(self):
            setattr(core, field.name, getattr(self, field.name))
        return core

    @classmethod
    def _of_core(cls, core: _core.Material) -> "Material":
        return cls(**{field.name: getattr(core, field.name) for field in fields(cls)})


def material(name: str) -> Material:
    """The material of a name: matte, glossy, mirror, gold, copper, glass or ruby."""
    return Material._of_core(_core.named_material(_check.text("name", name)))


@dataclass(frozen=True)
class Light:
    """A light; point_light(), spot_light() and sun() make them. power: intensity of a point light, irradiance of a sun, linear r, g, b.
    size: radius of a point light in world units, angular diameter of a sun in degrees. Of spots, target: what it shines at, and cone:
    degrees from there to where it is dark. range: how far a point light shines, world units, 0 for any distance.
    """

    position: Vector
    power: Color
    point: bool = False
    size: float = 0.0
    target: Optional[Vector] = None
    cone: float = 0.0
    range: float = 0.0

    def __post_init__(self) -> None:
        object.__setattr__(self, "position", _check.vector("position", self.position))
        object.__setattr__(self, "power", _check.color("power", self.power))
        for name in ("size", "cone", "range"):
            object.__setattr__(self, name, _check.number(name, getattr(self, name)))
        if self.target is not None:
            object.__setattr__(self, "target", _check.vector("target", self.target))

    def _to_field(self) -> Tuple[str, str]:
        def text(*numbers: float) -> str:
            return ",".join(map(repr, numbers))

        if not self.point:
            return "sun", text(*self.position, *self.power, self.size)
        words = ["point:" if self.target is None else "spot:", f"at={text(*self.position)},power={text(*self.power)}"]
        if self.target is not None:
            words.append(f",to={text(*self.target)},cone={text(self.cone)}")
        words += [f",{name}={text(value)}" for name, value in (("radius", self.size), ("range", self.range)) if value != 0.0]
        return "light", "".join(words)


def point_light(position: Vector, power: Color, radius: float = 0.0) -> Light:
    """A light at a place; power: irradiance times distance^2, a number or r, g, b. radius: world units; above 0 shadows are soft."""
    return Light(position, power, True, radius)


def spot_light(position: Vector, target: Vector, power: Color, cone: float = 30.0, radius: float = 0.0, range: float = 0.0) -> Light:
    """A light at a place that shines at a target; cone: degrees from there to where it is dark; else as point_light()."""
    return Light(position, power, True, radius, target, cone, range)


def sun(direction: Vector, power: Color = (3.14, 3.14, 3.14), diameter: float = 0.0) -> Light:
    """Light from `direction`, of any length; power: irradiance of what faces it, a number or r, g, b. diameter: degrees, the real sun's is 0.5."""
    return Light(direction, power, False, diameter)
