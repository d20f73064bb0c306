"""Pictures."""

from __future__ import annotations

from typing import Any, Dict, Optional, Tuple

import numpy as np

from . import _check, _core


class Image:
    """A picture; rows from the top. The arrays are views of it, not copies."""

    def __init__(self, core: _core.Image) -> None:
        if not isinstance(core, _core.Image):
            raise TypeError("images are made by Scene.render")
        self._core = core

    @property
    def width(self) -> int:
        """Pixels."""
        return self._core.width

    @property
    def height(self) -> int:
        """Pixels."""
        return self._core.height

    @property
    def pixels(self) -> np.ndarray:
        """float32 (height, width, 4): linear radiance r, g, b, and coverage 0..1."""
        return self._core.pixels

    @property
    def depth(self) -> Optional[np.ndarray]:
        """float32 (height, width): distance from the eye, world units, inf on a miss. None unless rendered with aov="depth,normal,id"."""
        return self._core.depth

    @property
    def normal(self) -> Optional[np.ndarray]:
        """float32 (height, width, 3): unit normal in world space, 0 on a miss. None unless rendered with aov="depth,normal,id"."""
        return self._core.normal

    @property
    def object(self) -> Optional[np.ndarray]:
        """int32 (height, width): index into Scene.objects, -1 on a miss. None unless rendered with aov="depth,normal,id"."""
        return self._core.object

    @property
    def error(self) -> Optional[np.ndarray]:
        """float32 (height, width): estimated error of the radiance. None unless rendered with aov="error"."""
        return self._core.error

    @property
    def albedo(self) -> Optional[np.ndarray]:
        """float32 (height, width, 3): base colour, linear, 0 to 1. None unless rendered with aov="albedo"."""
        return self._core.albedo

    @property
    def choices(self) -> Dict[str, str]:
        """What was not asked for and suits the scene: fields that ask for the same, and their values."""
        return dict(self._core.choices)

    @property
    def lod_error(self) -> str:
        """Rendered with lod_error=True: what the points of a scan in levels that were not read change, such as
        "mean +2.03 % (+0.09 to +3.96), PSNR 31.8 dB (29.0 to 42.5)", with 95 %; empty where all were read."""
        return self._core.lod_error

    @property
    def exposure(self) -> float:
        """Brightness of a .png, stops: as asked for, or what suits the picture; can be set."""
        return self._core.exposure

    @exposure.setter
    def exposure(self, stops: float) -> None:
        self._core.exposure = _check.number("exposure", stops)

    @property
    def tone(self) -> str:
        """How a .png shows what is brighter than a display can be: neutral, agx, soft or none; can be set."""
        return self._core.tone

    @tone.setter
    def tone(self, name: str) -> None:
        self._core.tone = _check.text("tone", name)

    def save(self, path: Any) -> None:
        """Writes .png (sRGB, 8 bit, through exposure and tone) or .exr (linear float, with all channels)."""
        try:
            self._core.save(_check.path("path", path))
        except RuntimeError as error:
            raise OSError(str(error)) from None

    def png(self) -> bytes:
        """The bytes of the .png."""
        return self._core.png()

    def __reduce__(self) -> Tuple[Any, ...]:
        return _image_of, (self.pixels, self.depth, self.normal, self.object, self.error, self.albedo, self.exposure, self.tone)

    def __eq__(self, other: object) -> bool:
        """Whether all channels, exposure and tone are the same."""
        if not isinstance(other, Image):
            return NotImplemented
        return all(np.array_equal(mine, theirs) for mine, theirs in zip(self.__reduce__()[1], other.__reduce__()[1]))

    __hash__ = None  # type: ignore[assignment]

    def _repr_png_(self) -> bytes:
        return self.png()

    def __array__(self, dtype: Any = None, copy: Optional[bool] = None) -> np.ndarray:
        pixels = self.pixels if dtype is None else self.pixels.astype(dtype, copy=False)
        return pixels.copy() if copy else pixels

    def __repr__(self) -> str:
        return f"<splatray.Image {self.width} x {self.height}>"


def _image_of(pixels: np.ndarray, depth: Optional[np.ndarray], normal: Optional[np.ndarray], object: Optional[np.ndarray],
              error: Optional[np.ndarray], albedo: Optional[np.ndarray], exposure: float, tone: str) -> Image:
    """The image of its arrays, for pickle and copy."""
    arrays = (None if array is None else np.ascontiguousarray(array) for array in (pixels, depth, normal, object, error, albedo))
    return Image(_core.image_of(*arrays, exposure, tone))
