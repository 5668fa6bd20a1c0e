# SPDX-License-Identifier: MIT
"""A mesh from arrays: a tube along a knot, coloured along its way.

usage: 02_mesh.py OUT.png
"""

import sys

import numpy as np

import rhw

if len(sys.argv) != 2:
    sys.exit(__doc__)
ALONG, AROUND = 600, 48
t = np.linspace(0, 2 * np.pi, ALONG, endpoint=False)
way = np.stack([(2 + np.cos(3 * t)) * np.cos(2 * t), (2 + np.cos(3 * t)) * np.sin(2 * t), np.sin(3 * t)], axis=1)

ahead = np.roll(way, -1, axis=0) - np.roll(way, 1, axis=0)
aside = np.cross(ahead, way)
above = np.cross(aside, ahead)
aside, above = (each / np.linalg.norm(each, axis=1, keepdims=True) for each in (aside, above))

a = np.linspace(0, 2 * np.pi, AROUND, endpoint=False)[:, None]
normals = np.cos(a) * aside[:, None] + np.sin(a) * above[:, None]
vertices = way[:, None] + 0.38 * normals

i, k = np.meshgrid(np.arange(ALONG), np.arange(AROUND), indexing="ij")
corner = lambda di, dk: ((i + di) % ALONG * AROUND + (k + dk) % AROUND).ravel()
faces = np.concatenate([np.stack([corner(0, 0), corner(1, 0), corner(1, 1)], 1),
                        np.stack([corner(0, 0), corner(1, 1), corner(0, 1)], 1)])
colors = 0.5 + 0.45 * np.cos(t[:, None] + np.array([0, 2.1, 4.2]))

model = rhw.Model(vertices.reshape(-1, 3), faces, normals=normals.reshape(-1, 3), colors=colors.repeat(AROUND, axis=0),
                  color=(1, 1, 1), roughness=0.3, up="z")
model.render((640, 420), rhw.Camera.orbit(30, 35, margin=8), samples=16, ground=True,
             background=(240, 240, 238)).save(sys.argv[1])
