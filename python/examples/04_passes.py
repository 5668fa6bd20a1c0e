# SPDX-License-Identifier: MIT
"""A million triangles without a model: colours, distances and ids of a field of heights in one pass.

usage: 04_passes.py OUT.png
"""

import sys

import numpy as np

import rhw
from rhw.pipeline import Buffer, Pass, Pipeline, Texture

N, SIZE = 708, (640, 420)


def look(eye, target, up, lens):
    """World to clip space: a camera at `eye`, whose pictures show `lens` times the distance, half up and half down."""
    back = (eye - target) / np.linalg.norm(eye - target)
    right = np.cross(up, back) / np.linalg.norm(np.cross(up, back))
    view = np.eye(4)
    view[:3, :3] = right, np.cross(back, right), back
    view[:3, 3] = -view[:3, :3] @ eye
    near, far = 0.5, 8.0
    projection = np.zeros((4, 4))
    projection[0, 0], projection[1, 1] = SIZE[1] / SIZE[0] / lens, 1 / lens
    projection[2, 2:] = far / (near - far), near * far / (near - far)
    projection[3, 2] = -1
    return projection @ view


y, x = np.mgrid[0:N, 0:N] / (N - 1) * 4 - 2
z = 0.30 * np.sin(3 * x + 0.7) * np.cos(2.3 * y) + 0.10 * np.sin(7.1 * x * y) * np.exp(-x * x - y * y)
vertices = np.stack([x, y, z], axis=-1).reshape(-1, 3).astype(np.float32)
a = (np.arange(N - 1)[:, None] * N + np.arange(N - 1)).ravel()
faces = np.concatenate([np.stack([a, a + 1, a + N], 1), np.stack([a + 1, a + N + 1, a + N], 1)])

# Light from the slope, colours from the height.
slope = np.stack([-np.gradient(z, x[0], axis=1), -np.gradient(z, y[:, 0], axis=0), np.ones_like(z)], axis=-1)
sun = np.array([-0.7, 0.3, 0.65])
light = np.clip((slope @ sun) / np.linalg.norm(slope, axis=-1) / np.linalg.norm(sun), 0, 1)[..., None]
height = ((z - z.min()) / (z.max() - z.min()))[..., None]
tint = (1 - height) * [0.05, 0.18, 0.35] + height * [0.85, 0.75, 0.5]
rgba = np.concatenate([tint * (0.15 + 0.85 * light), np.ones_like(light)], axis=-1).reshape(-1, 4)

positions, indices, colors = Buffer(vertices), Buffer(faces, np.uint32), Buffer(rgba, np.float32)
matrix = look(np.array([2.0, -4.0, 2.6]), np.array([0.1, 0.0, -0.35]), np.array([0, 0, 1.0]), 0.5)

targets = {"color": Texture(SIZE, "rgba8_srgb"), "distance": Texture(SIZE, "r32_float"),
           "triangle": Texture(SIZE, "r32_uint")}
with Pass(targets, depth=True, clear={"color": (0.9, 0.9, 0.88, 1)}, samples=1) as draw:
    draw(Pipeline(targets, colors="float32"), positions, indices, colors=colors, matrix=matrix)

# Lines of equal distance, every tenth of a unit, on what is seen.
picture = targets["color"].array
seen = targets["triangle"].array > 0
step = np.floor(targets["distance"].array * 10)
edge = np.zeros(seen.shape, bool)
edge[1:] |= (step[1:] != step[:-1]) & seen[1:] & seen[:-1]
picture[edge, :3] //= 2
rhw.write_png(sys.argv[1], picture)
print(f"{draw.stats['triangles_in']} triangles, {len(np.unique(targets['triangle'].array)) - 1} of them seen")
