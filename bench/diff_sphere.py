# SPDX-License-Identifier: MIT
"""The mesh that rhw.diff is timed with: a grid around a sphere, its poles included."""

import numpy as np

SIDES = 158


def sphere():
    """(25281, 3) float32 vertices of radius 1 and (49928, 3) int32 faces."""
    t, p = np.meshgrid(np.linspace(0, np.pi, SIDES + 1), np.linspace(0, 2 * np.pi, SIDES + 1), indexing="ij")
    vertices = np.stack([np.sin(t) * np.cos(p), np.cos(t), np.sin(t) * np.sin(p)], -1).reshape(-1, 3)
    a = (np.arange(SIDES)[:, None] * (SIDES + 1) + np.arange(SIDES)).ravel()
    faces = [np.stack([a, a + 1, a + SIDES + 1], 1), np.stack([a + 1, a + SIDES + 2, a + SIDES + 1], 1)]
    return vertices.astype(np.float32), np.concatenate(faces).astype(np.int32)
