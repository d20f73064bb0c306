"""Cameras."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any, Optional, Tuple

from . import _check, _core

if TYPE_CHECKING:
    from .scene import Scene

Vector = Tuple[float, float, float]


@dataclass(frozen=True)
class Camera:
    """A camera in world space.

    eye, target: where it is and what it looks at. up: direction towards the picture's top, not parallel to the view. fov: vertical
    field of view, degrees, between 0 and 180. ortho_height: above 0 for an orthographic picture of this height in world units.
    lens_shift: where the point straight ahead lies, from the picture's middle to the right and down, in widths and heights of the
    picture. pixel_aspect: a pixel's width over its height, 0.01 to 100. panorama: all directions from the eye, equirectangular, with the
    target in the middle; pictures are then the largest within the size asked for that are twice as wide as high. Arrays become tuples
    of floats.
    """

    eye: Vector
    target: Vector
    up: Vector = (0.0, 0.0, 1.0)
    fov: float = 30.0
    ortho_height: float = 0.0
    lens_shift: Tuple[float, float] = (0.0, 0.0)
    pixel_aspect: float = 1.0
    panorama: bool = False

    def __post_init__(self) -> None:
        for name in ("eye", "target", "up"):
            object.__setattr__(self, name, _check.vector(name, getattr(self, name)))
        for name in ("fov", "ortho_height", "pixel_aspect"):
            object.__setattr__(self, name, _check.number(name, getattr(self, name)))
        object.__setattr__(self, "lens_shift", _check.vector("lens_shift", self.lens_shift, 2))

    @classmethod
    def from_pose(cls, pose: Any, K: Any, size: Tuple[int, int]) -> "Camera":
        """The camera of a pose and intrinsics as OpenCV has them, for pictures of this size or its shape.

        pose: (4, 4), camera to world, a rotation and a translation; the camera looks along its z, x is right and y down. K: (3, 3), rows
        of fx 0 cx, 0 fy cy, 0 0 1, pixels; the centre of the top left one is at (0, 0). size: (width, height), pixels. Exact off-centre
        and with fx other than fy. For cameras of OpenGL, Blender and NeRF (y up, z back) give `pose @ np.diag([1, -1, -1, 1])`; of
        COLMAP, whose corner of the top left pixel is at (0, 0), subtract 0.5 from cx and cy. The target is 1 ahead.
        """
        width, height = _check.size(size)
        return cls._of_core(_core.camera_from_pose(_check.matrix("pose", pose, 4), _check.matrix("K", K, 3), width, height))

    @classmethod
    def _of_core(cls, core: _core.Camera) -> "Camera":
        return cls(*(getattr(core, field.name) for field in fields(cls)))

    def _to_core(self) -> _core.Camera:
        camera = _core.Camera()
        for field in fields(self):
            setattr(camera, field.name, getattr(self, field.name))
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
    return Camera._of_core(core.frame(*angles, _check.number("aspect", aspect)))
