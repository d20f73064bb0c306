"""Pictures."""

from __future__ import annotations

from typing import Any, Optional, Tuple

import numpy as np

from . import _check, _core

TONES = ("soft", "neutral", "agx", "none")


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
        """float32 (height, width): distance from the eye, world units, inf on a miss. None unless rendered with channels=True."""
        return self._core.depth

    @property
    def normal(self) -> Optional[np.ndarray]:
        """float32 (height, width, 3): unit normal in world space, 0 on a miss. None unless rendered with channels=True."""
        return self._core.normal

    @property
    def object(self) -> Optional[np.ndarray]:
        """int32 (height, width): index into Scene.objects, -1 on a miss. None unless rendered with channels=True."""
        return self._core.object

    def save(self, path: Any, exposure: float = 0.0, tone: str = "neutral") -> None:
        """Writes .png (sRGB, 8 bit) or .exr (linear float, with all channels).

        exposure: brightness of a .png, stops. tone: how what is brighter than a display can be is brought below 1: neutral, agx, soft or
        none.
        """
        stops, curve = _check.number("exposure", exposure), _check.choice("tone", tone, TONES)
        try:
            self._core.save(_check.path("path", path), stops, curve)
        except RuntimeError as error:
            raise OSError(str(error)) from None

    def png(self, exposure: float = 0.0, tone: str = "neutral") -> bytes:
        """The bytes of the .png."""
        return self._core.png(_check.number("exposure", exposure), _check.choice("tone", tone, TONES))

    def __reduce__(self) -> Tuple[Any, ...]:
        return _image_of, (self.pixels, self.depth, self.normal, self.object)

    def _repr_png_(self) -> bytes:
        return self.png()

    def __array__(self, dtype: Any = None, copy: Optional[bool] = None) -> np.ndarray:
        pixels = self.pixels if dtype is None else self.pixels.astype(dtype, copy=False)
        return pixels.copy() if copy else pixels

    def __repr__(self) -> str:
        return f"<splatray.Image {self.width} x {self.height}>"


def _image_of(pixels: np.ndarray, depth: Optional[np.ndarray], normal: Optional[np.ndarray], object: Optional[np.ndarray]) -> Image:
    """The image of its arrays, for pickle and copy."""
    return Image(_core.image_of(*(None if array is None else np.ascontiguousarray(array) for array in (pixels, depth, normal, object))))
