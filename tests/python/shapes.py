"""Small point clouds with closed forms."""

import numpy as np


def sphere(count=20000, center=(0.0, 0.0, 0.0)):
    """Points on the unit sphere about `center`, and their normals: a spiral of equal areas."""
    i = np.arange(count)
    z = 1.0 - (2.0 * i + 1.0) / count
    turn = i * np.pi * (3.0 - np.sqrt(5.0))
    normals = np.stack([np.sqrt(1 - z * z) * np.cos(turn), np.sqrt(1 - z * z) * np.sin(turn), z], axis=1)
    return normals + np.asarray(center), normals


def plane(height=0.0, center=(0.0, 0.0)):
    """Points 0.1 apart on 4 x 4 of the plane z = height, facing up."""
    x, y = np.meshgrid(np.arange(-20, 21) * 0.1 + center[0], np.arange(-20, 21) * 0.1 + center[1])
    points = np.stack([x.ravel(), y.ravel(), np.full(x.size, height)], axis=1)
    return points, np.tile([0.0, 0.0, 1.0], (len(points), 1))
