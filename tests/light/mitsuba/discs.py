"""Splats of a scene file as polygons, for renderers that know no discs."""

import struct

import numpy as np

HEADER, ENTRY = 48, 64
OCT_SCALE = 32767
CORNERS = 24


def read_discs(path):
    """The discs of a scene file (engine/file/scene_file.h; shaders/layout.h has the words of a splat).

    Returns centres (N, 3) in world units, unit normals (N, 3), radii (N,), world units, and objects (N,)."""
    data = open(path, "rb").read()
    (sections,) = struct.unpack_from("<I", data, 32)
    section = {}
    for i in range(sections):
        name, offset, size = struct.unpack_from("<24s16xQQ", data, HEADER + i * ENTRY)
        section[name.rstrip(b"\0")] = data[offset:offset + size]
    *origin, unit = struct.unpack_from("<4d", section[b"root"])
    x, y, z, w = np.frombuffer(section[b"data_pool"], "<u4").reshape(-1, 4).T
    centres = np.stack([x >> 11, (x & 0x7FF) << 10 | y >> 22, y & 0x1FFFFF], 1) * unit + origin
    u = (z & 0xFFFF).astype(np.int64) - OCT_SCALE
    v = (z >> 16).astype(np.int64) - OCT_SCALE
    height = OCT_SCALE - np.abs(u) - np.abs(v)
    fold = np.maximum(-height, 0)
    normals = np.stack([u + np.where(u < 0, fold, -fold), v + np.where(v < 0, fold, -fold), height], 1).astype(float)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    squared = (np.uint32(0x40000000) | (w >> 16) << 14).astype("<u4").view("<f4").astype(float)
    return centres, normals, np.sqrt(squared) * unit, w & 0xFFFF


def polygons(centres, normals, radii):
    """Vertices and triangles of discs as regular polygons of the same area."""
    helper = np.where(np.abs(normals[:, :1]) > 0.5, [[0.0, 1.0, 0.0]], [[1.0, 0.0, 0.0]])
    u = np.cross(helper, normals)
    u /= np.linalg.norm(u, axis=1, keepdims=True)
    v = np.cross(normals, u)
    angles = 2.0 * np.pi * np.arange(CORNERS) / CORNERS
    wide = radii * np.sqrt(2.0 * np.pi / (CORNERS * np.sin(2.0 * np.pi / CORNERS)))
    rim = (np.cos(angles)[None, :, None] * u[:, None] + np.sin(angles)[None, :, None] * v[:, None]) * wide[:, None, None]
    vertices = (centres[:, None] + rim).reshape(-1, 3)
    fan = np.array([[0, i, i + 1] for i in range(1, CORNERS - 1)])
    triangles = (np.arange(len(centres))[:, None, None] * CORNERS + fan[None]).reshape(-1, 3)
    return vertices, triangles
