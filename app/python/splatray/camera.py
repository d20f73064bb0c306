"""Cameras."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Optional, Tuple

from . import _check, _core

if TYPE_CHECKING:
    from .scene import Scene

Vector = Tuple[float, float, float]


@dataclass(frozen=True)
class Camera:
    """A camera in world space.

    eye, target: where it is and what it looks at. up: direction towards the picture's top, not parallel to the view. fov: vertical
    field of view, degrees, between 0 and 180. ortho_height: above 0 for an orthographic picture of this height in world units.
    """

    eye: Vector
    target: Vector
    up: Vector = (0.0, 0.0, 1.0)
    fov: float = 30.0
    ortho_height: float = 0.0

    def _to_core(self) -> _core.Camera:
        camera = _core.Camera()
        for name in ("eye", "target", "up"):
            setattr(camera, name, _check.vector(name, getattr(self, name)))
        for name in ("fov", "ortho_height"):
            setattr(camera, name, _check.number(name, getattr(self, name)))
        return camera


def frame(scene: Scene, *, azimuth: Optional[float] = None, elevation: Optional[float] = None, fov: Optional[float] = None,
          aspect: float = 16 / 9) -> Camera:
    """A camera that shows the whole scene.

    azimuth: degrees from the front towards the right; the front is where -y points in z-up scenes, +z in y-up ones. elevation:
    degrees above the horizon, -90 to 90. Without both: the scene's own camera, or one that suits its shape. fov: vertical field of
    view, degrees. aspect: width / height of the picture.
    """
    core = scene._open_core()
    angles = [None if value is None else _check.number(name, value)
              for name, value in (("azimuth", azimuth), ("elevation", elevation), ("fov", fov))]
    camera = core.frame(*angles, _check.number("aspect", aspect))
    return Camera(tuple(camera.eye), tuple(camera.target), tuple(camera.up), camera.fov, camera.ortho_height)
