"""Vulkan devices."""

from __future__ import annotations

from typing import List, NamedTuple

from . import _core


class Device(NamedTuple):
    """A Vulkan device; refused: why it cannot be used, empty where it can."""

    name: str
    type: str
    driver: str
    refused: str


def devices() -> List[Device]:
    """All devices, by number; none without Vulkan (Debian's packages libvulkan1 and mesa-vulkan-drivers).
    The device "cpu", which is taken where none of them is a GPU, needs none."""
    return [Device(*device) for device in _core.devices()]
