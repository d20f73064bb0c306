"""What users give, checked and in the types that the core takes: each failure names the argument."""

from __future__ import annotations

import math
import operator
import os
from typing import Any, Callable, List, Optional, Tuple

import numpy as np

Progress = Callable[[str, float], Optional[bool]]


def number(name: str, value: Any) -> float:
    """A finite number."""
    try:
        result = float(value)
    except (TypeError, ValueError, OverflowError):
        raise TypeError(f"{name}: found {value!r}, expected a number") from None
    if not math.isfinite(result):
        raise ValueError(f"{name}: found {value!r}, expected a finite number")
    return result


def whole(name: str, value: Any, least: int, most: int) -> int:
    """A whole number in [least, most]."""
    try:
        result = operator.index(value)
    except TypeError:
        raise TypeError(f"{name}: found {value!r}, expected a whole number") from None
    if not least <= result <= most:
        raise ValueError(f"{name}: found {result}, expected {least} to {most}")
    return result


def text(name: str, value: Any) -> str:
    if not isinstance(value, str):
        raise TypeError(f"{name}: found {value!r}, expected a str")
    return value


def path(name: str, value: Any) -> str:
    """The path of a file or folder."""
    if not isinstance(value, (str, os.PathLike)):
        raise TypeError(f"{name}: found {value!r}, expected a path, a str or an os.PathLike")
    found = os.fsdecode(value)
    if "\0" in found:
        raise ValueError(f"{name}: found {found!r}, expected a path without a zero character")
    return found


def array(name: str, value: Any, dtype: type) -> np.ndarray:
    """Numbers as a contiguous array of this type, copied only where they are not that yet; masked ones are NaN."""
    try:
        found = np.asarray(value)
        if found.dtype.kind not in "fiub":
            raise TypeError
        if np.ma.is_masked(value):
            found = np.ma.filled(value.astype(np.float64), np.nan)
        with np.errstate(over="ignore", invalid="ignore"):
            return np.ascontiguousarray(found, dtype=dtype)
    except (TypeError, ValueError):
        raise TypeError(f"{name}: found {type(value).__name__} that is no array of real numbers") from None


def rows(name: str, value: Any, dtype: type) -> np.ndarray:
    """An array (n, 3)."""
    found = array(name, value, dtype)
    if found.ndim != 2 or found.shape[1] != 3:
        raise ValueError(f"{name}: found an array of shape {found.shape}, expected (n, 3)")
    return found


def vector(name: str, value: Any, length: int = 3) -> Tuple[float, ...]:
    """This many finite numbers."""
    found = array(name, value, np.float64)
    if found.shape != (length,):
        raise ValueError(f"{name}: found an array of shape {found.shape}, expected {length} numbers")
    if not np.isfinite(found).all():
        raise ValueError(f"{name}: found {value!r}, expected finite numbers")
    return tuple(found.tolist())


def numbers(name: str, value: Any, dtype: type) -> np.ndarray:
    """An array (n,)."""
    found = array(name, value, dtype)
    if found.ndim != 1:
        raise ValueError(f"{name}: found an array of shape {found.shape}, expected (n,)")
    return found


def matrix(name: str, value: Any, side: int) -> List[List[float]]:
    """A square matrix as rows."""
    found = array(name, value, np.float64)
    if found.shape != (side, side):
        raise ValueError(f"{name}: found an array of shape {found.shape}, expected ({side}, {side})")
    return found.tolist()


def color(name: str, value: Any) -> Tuple[float, ...]:
    """Three finite numbers, or one for all three."""
    return vector(name, [value] * 3 if np.ndim(value) == 0 else value)


def size(value: Any) -> Tuple[int, int]:
    """A picture's width and height."""
    try:
        width, height = value
    except (TypeError, ValueError):
        raise TypeError(f"size: found {value!r}, expected (width, height)") from None
    return whole("width", width, 1, 32768), whole("height", height, 1, 32768)


def choice(name: str, value: Any, choices: Tuple[str, ...]) -> int:
    """The place of a word among those there are."""
    if text(name, value) not in choices:
        raise ValueError(f"{name}: found {value!r}, expected one of {', '.join(choices)}")
    return choices.index(value)


def progress(value: Any) -> Optional[Progress]:
    if value is not None and not callable(value):
        raise TypeError(f"progress: found {value!r}, expected a function or None")
    return value
