# SPDX-License-Identifier: MIT
"""The map of a globe from pictures of it: gradients reach the texels through their levels of detail.

usage: 07_earth.py OUT.png
"""

import sys

import numpy as np
import torch

import rhw
import rhw.torch as dr

RINGS, MAP, SIZE, VIEWS, STEPS = 40, (64, 128), 96, 4, 120

random = np.random.default_rng(3)
glctx = dr.RasterizeContext()


def tensor(array):
    return torch.tensor(array, dtype=torch.float32)[None]


def globe():
    """Clip positions without a camera, coordinates of the map, and triangles; the seam's vertices are there twice."""
    v, u = np.mgrid[0:RINGS + 1, 0:2 * RINGS + 1] / np.array([RINGS, 2 * RINGS])[:, None, None]
    vertices = np.stack([np.sin(np.pi * v) * np.cos(2 * np.pi * u), np.cos(np.pi * v), np.sin(np.pi * v) * np.sin(2 * np.pi * u),
                         np.ones_like(u)], -1).reshape(-1, 4)
    a = (np.arange(RINGS)[:, None] * (2 * RINGS + 1) + np.arange(2 * RINGS)).ravel()
    below = a + 2 * RINGS + 1
    tri = np.concatenate([np.stack([a, a + 1, below], 1), np.stack([a + 1, below + 1, below], 1)])
    return tensor(vertices), tensor(np.stack([u, v], -1).reshape(-1, 2)), torch.tensor(tri, dtype=torch.int32)


def continents():
    """A map with land, coasts and ice."""
    v, u = (np.mgrid[0:MAP[0], 0:MAP[1]] + 0.5) / np.array(MAP)[:, None, None]
    x, y, z = np.sin(np.pi * v) * np.cos(2 * np.pi * u), np.cos(np.pi * v), np.sin(np.pi * v) * np.sin(2 * np.pi * u)
    height = np.sin(3 * x + 2 * y) * np.cos(2 * z - 1) + 0.5 * np.sin(7 * z + 3 * x * y) + 0.3 * np.cos(9 * y - 5 * x)
    land = (height > 0.2)[..., None]
    colors = np.where(land, np.stack([0.3 + 0.3 * height, 0.55 - 0.1 * height, 0.2 + 0 * v], -1), [0.05, 0.2, 0.5])
    return tensor(np.where((np.abs(y) > 0.93)[..., None], 0.95, colors))


def views(count):
    """Rotations, seen from 3 before the eye."""
    turns = np.linalg.qr(random.normal(size=(count, 3, 3)))[0]
    turns *= np.linalg.det(turns)[:, None, None]  # no mirrors
    world = np.tile(np.eye(4), (count, 1, 1))
    world[:, :3, :3] = turns
    world[:, 2, 3] = -3
    near, far, lens = 1.0, 10.0, 0.4
    projection = np.array([[1 / lens, 0, 0, 0], [0, 1 / lens, 0, 0],
                           [0, 0, (near + far) / (near - far), 2 * near * far / (near - far)], [0, 0, -1, 0]])
    return tensor(projection @ world)[0]


def draw(matrices, texels):
    rast, rast_db = dr.rasterize(glctx, vertices @ matrices.transpose(1, 2), tri, resolution=[SIZE, SIZE])
    at, at_da = dr.interpolate(uv, rast, tri, rast_db=rast_db, diff_attrs="all")
    color = dr.texture(texels, at, at_da, filter_mode="linear-mipmap-linear", max_mip_level=4)
    return color * torch.clamp(rast[..., 3:], 0, 1)


vertices, uv, tri = globe()
wanted, found = continents(), torch.full((1, *MAP, 3), 0.3, requires_grad=True)
show = views(1)
optimizer = torch.optim.Adam([found], lr=5e-2)
scheduler = torch.optim.lr_scheduler.LambdaLR(optimizer, lambda step: 0.05**(step / STEPS))
pictures = []
for step in range(STEPS + 1):
    if step in (0, 4, STEPS):
        with torch.no_grad():
            pictures.append(draw(show, found))
    noise = -10 * torch.log10(torch.mean((found.detach() - wanted)**2)).item()
    matrices = views(VIEWS)
    loss = torch.mean((draw(matrices, found) - draw(matrices, wanted))**2)
    if step % 20 == 0:
        print(f"step {step}: loss {loss.item():.6f}, the map {noise:.1f} dB")
    optimizer.zero_grad()
    loss.backward()
    optimizer.step()
    scheduler.step()
assert noise > 30

pictures.append(draw(show, wanted))
globes = torch.cat(pictures, dim=2)[0].flip(0).numpy()  # row 0 is the lowest
maps = torch.cat([found.detach(), wanted], dim=2)[0].numpy()  # row 0 is the north
picture = np.concatenate([globes, np.pad(maps, ((0, 0), (0, globes.shape[1] - maps.shape[1]), (0, 0)))])
rgb = np.rint(255 * np.clip(picture, 0, 1)).astype(np.uint8)
rhw.write_png(sys.argv[1], np.concatenate([rgb, np.full_like(rgb[..., :1], 255)], -1))
