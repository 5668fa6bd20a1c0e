# SPDX-License-Identifier: MIT
"""How a cube is turned, from one picture of it: the best of many guesses follow the gradients of their quaternions.

usage: 08_pose.py OUT.png
"""

import sys

import numpy as np
import torch

import rhw
import rhw.torch as dr

SIZE, GUESSES, KEPT, STEPS = 96, 96, 8, 120
CORNERS = [[x, y, z, 1] for z in (-0.5, 0.5) for y in (-0.5, 0.5) for x in (-0.5, 0.5)]
QUADS = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
SIDES = [[1, 0.2, 0.1], [0.2, 0.8, 0.2], [0.1, 0.3, 1], [1, 0.9, 0.1], [0.9, 0.3, 0.9], [0.1, 0.9, 0.9]]

vertices, colors = torch.tensor(CORNERS), torch.tensor(SIDES)
tri = torch.tensor([[q[0], q[i], q[i + 1]] for q in QUADS for i in (1, 2)], dtype=torch.int32)
tri_colors = torch.arange(6, dtype=torch.int32).repeat_interleave(2)[:, None].repeat(1, 3)  # a side has one colour
near, far, lens = 1.0, 10.0, 0.35
projection = torch.tensor([[1 / lens, 0, 0, 0], [0, 1 / lens, 0, 0],
                           [0, 0, (near + far) / (near - far), 2 * near * far / (near - far)], [0, 0, -1, 0]])
glctx = dr.RasterizeContext()


def turned(q):
    """Model to camera, by quaternions (B, 4) of any length."""
    w, x, y, z = torch.nn.functional.normalize(q, dim=1).unbind(1)
    nil, one = torch.zeros_like(w), torch.ones_like(w)
    rows = [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), nil,
            2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x), nil,
            2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y), -3 * one, nil, nil, nil, one]
    return torch.stack(rows, 1).reshape(-1, 4, 4)


def draw(q):
    pos = vertices @ (projection @ turned(q)).transpose(1, 2)
    rast, _ = dr.rasterize(glctx, pos, tri, resolution=[SIZE, SIZE])
    color, _ = dr.interpolate(colors[None], rast, tri_colors)
    return dr.antialias(color, rast, pos, tri)


def compare(q):
    return torch.mean((draw(q) - reference)**2, dim=(1, 2, 3))


def degrees(q):
    """The turns that are left."""
    cosine = torch.abs(torch.nn.functional.normalize(q, dim=1) @ torch.nn.functional.normalize(wanted, dim=1)[0])
    return np.degrees(2 * np.arccos(cosine.clamp(max=1).numpy()))


random = np.random.default_rng(8)
wanted = torch.tensor(random.normal(size=(1, 4)), dtype=torch.float32)
reference = draw(wanted)
guesses = torch.tensor(random.normal(size=(GUESSES, 4)), dtype=torch.float32)
found = guesses[compare(guesses).argsort()[:KEPT]].requires_grad_()
pictures = [draw(guesses[:1]), draw(found[:1].detach())]
optimizer = torch.optim.Adam([found], lr=3e-2)
scheduler = torch.optim.lr_scheduler.LambdaLR(optimizer, lambda step: 0.02**(step / STEPS))
for step in range(STEPS + 1):
    losses = compare(found)
    best = losses.argmin()  # others may stay where another side of the cube looks alike
    left = degrees(found.detach())[best]
    if step % 20 == 0:
        print(f"step {step}: loss {losses[best].item():.6f}, {left:.2f} degrees left")
    optimizer.zero_grad()
    losses.sum().backward()
    optimizer.step()
    scheduler.step()
assert left < 0.5

pictures += [draw(found[best][None].detach()), reference]
picture = torch.cat(pictures, dim=2)[0].flip(0).numpy()  # row 0 is the lowest
rgb = np.rint(255 * np.clip(picture, 0, 1)).astype(np.uint8)
rhw.write_png(sys.argv[1], np.concatenate([rgb, np.full_like(rgb[..., :1], 255)], -1))
