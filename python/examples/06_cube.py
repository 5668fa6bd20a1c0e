# SPDX-License-Identifier: MIT
"""A cube from pictures of 16 by 16 pixels: corners and colours that start at random follow the gradients of PyTorch.

usage: 06_cube.py OUT.png
"""

import sys

import numpy as np
import torch

import rhw
import rhw.torch as dr

SMALL, LARGE, VIEWS, STEPS = 16, 160, 8, 400
CORNERS = np.array([[x, y, z] for z in (-0.5, 0.5) for y in (-0.5, 0.5) for x in (-0.5, 0.5)])
QUADS = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
TRI = torch.tensor([[q[0], q[i], q[i + 1]] for q in QUADS for i in (1, 2)], dtype=torch.int32)

random = np.random.default_rng(5)
glctx = dr.RasterizeContext()


def tensor(array):
    return torch.tensor(array, dtype=torch.float32)


def views(count):
    """Model to clip space: cubes turned anyhow, a little off the middle, 3.5 before the eye."""
    turns = np.linalg.qr(random.normal(size=(count, 3, 3)))[0]
    turns *= np.linalg.det(turns)[:, None, None]  # no mirrors
    world = np.tile(np.eye(4), (count, 1, 1))
    world[:, :3, :3] = turns
    world[:, :3, 3] = random.uniform(-0.25, 0.25, (count, 3)) - [0, 0, 3.5]
    near, far, lens = 1.0, 50.0, 0.4
    projection = np.array([[1 / lens, 0, 0, 0], [0, 1 / lens, 0, 0],
                           [0, 0, (near + far) / (near - far), 2 * near * far / (near - far)], [0, 0, -1, 0]])
    return tensor(projection @ world)


def draw(matrices, mesh, size):
    corners, colors = mesh
    pos = torch.cat([corners, torch.ones(8, 1)], 1) @ matrices.transpose(1, 2)
    rast, _ = dr.rasterize(glctx, pos, TRI, resolution=[size, size])
    color, _ = dr.interpolate(colors[None], rast, TRI)
    return dr.antialias(color, rast, pos, TRI)


wanted = tensor(CORNERS), tensor(CORNERS + 0.5)
found = [tensor(CORNERS + random.uniform(-0.4, 0.4, CORNERS.shape)), tensor(random.uniform(0, 1, CORNERS.shape))]
show = views(1)
with torch.no_grad():
    pictures = [draw(show, found, LARGE)]
for values in found:
    values.requires_grad_()
optimizer = torch.optim.Adam(found, lr=2e-2)
scheduler = torch.optim.lr_scheduler.LambdaLR(optimizer, lambda step: 0.02**(step / STEPS))
for step in range(STEPS + 1):
    matrices = views(VIEWS)
    loss = torch.mean((draw(matrices, found, SMALL) - draw(matrices, wanted, SMALL))**2)
    off = torch.mean(torch.linalg.norm(found[0].detach() - wanted[0], dim=1)).item()
    if step % 50 == 0:
        print(f"step {step}: loss {loss.item():.6f}, corners {off:.4f} off")
    optimizer.zero_grad()
    loss.backward()
    optimizer.step()
    scheduler.step()
assert off < 0.02

with torch.no_grad():
    small = draw(show, wanted, SMALL).repeat_interleave(LARGE // SMALL, 1).repeat_interleave(LARGE // SMALL, 2)
    pictures += [draw(show, found, LARGE), draw(show, wanted, LARGE), small]
picture = torch.cat(pictures, dim=2)[0].flip(0).numpy()  # row 0 is the lowest
rgb = np.rint(255 * np.clip(picture, 0, 1)).astype(np.uint8)
rhw.write_png(sys.argv[1], np.concatenate([rgb, np.full_like(rgb[..., :1], 255)], -1))
