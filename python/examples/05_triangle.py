# SPDX-License-Identifier: MIT
"""A triangle that finds its corners and colours from a picture of another, by gradients alone; NumPy is all it takes.

usage: 05_triangle.py OUT.png
"""

import sys

import numpy as np

import rhw
import rhw.diff as dr

SIZE, STEPS = (128, 128), 300
TRI = np.array([[0, 1, 2]])
WANTED = np.array([[-0.8, -0.8, 0, 1], [0.8, -0.8, 0, 1], [-0.8, 0.8, 0, 1]], np.float32)[None], np.eye(3, dtype=np.float32)[None]


def draw(pos, colors):
    rast, _ = dr.rasterize(pos, TRI, SIZE)
    flat, _ = dr.interpolate(colors, rast, TRI)
    return rast, flat, dr.antialias(flat, rast, pos, TRI)


def gradients(pos, colors, wanted):
    """The mean square of the difference, and its gradients."""
    rast, flat, image = draw(pos, colors)
    difference = image - wanted
    to_flat, to_pos = dr.antialias_grad(flat, rast, pos, TRI, 2 * difference / difference.size)
    to_colors, to_rast, _ = dr.interpolate_grad(colors, rast, TRI, to_flat)
    return np.mean(difference**2), to_pos + dr.rasterize_grad(pos, TRI, rast, to_rast), to_colors


class Adam:
    """Kingma and Ba, "Adam: a method for stochastic optimization", 2015."""

    def __init__(self, rate):
        self.rate, self.mean, self.square, self.steps = rate, 0, 0, 0

    def step(self, values, gradient):
        self.steps += 1
        self.mean = 0.9 * self.mean + 0.1 * gradient
        self.square = 0.99 * self.square + 0.01 * gradient**2
        mean, square = self.mean / (1 - 0.9**self.steps), self.square / (1 - 0.99**self.steps)
        return (values - self.rate * mean / (np.sqrt(square) + 1e-8)).astype(np.float32)


wanted = draw(*WANTED)[2]
pos = np.array([[-0.2, -0.5, 0, 1], [0.5, 0.1, 0, 1], [0.1, 0.5, 0, 1]], np.float32)[None]
colors = np.full((1, 3, 3), 0.5, np.float32)
shown = [draw(pos, colors)[2]]
by_pos, by_colors = Adam(0.02), Adam(0.02)
for step in range(STEPS):
    loss, to_pos, to_colors = gradients(pos, colors, wanted)
    to_pos[..., 2:] = 0  # on the screen
    pos, colors = by_pos.step(pos, to_pos), by_colors.step(colors, to_colors)
    by_pos.rate = by_colors.rate = 0.02 * 0.1**(step / STEPS)
    if step % 50 == 0:
        print(f"step {step}: loss {loss:.6f}, corners {np.abs(pos - WANTED[0]).max():.4f} off")
    if step in (40, 80):
        shown.append(draw(pos, colors)[2])
shown += [draw(pos, colors)[2], wanted]
print(f"step {STEPS}: loss {gradients(pos, colors, wanted)[0]:.6f}, corners {np.abs(pos - WANTED[0]).max():.4f} off")
assert np.abs(pos - WANTED[0]).max() < 0.02

picture = np.concatenate([image[0, ::-1] for image in shown], axis=1)  # row 0 is the lowest
rgb = np.rint(255 * np.clip(picture, 0, 1)).astype(np.uint8)
rhw.write_png(sys.argv[1], np.concatenate([rgb, np.full_like(rgb[..., :1], 255)], -1))
