# SPDX-License-Identifier: MIT
"""Everything about a pixel: colours, depth, normals, and which triangle it shows.

usage: 01_outputs.py MODEL OUT.png
"""

import sys

import numpy as np

import rhw

model = rhw.load(sys.argv[1])
pictures = model.render((480, 360), rhw.Camera.orbit(215, 22, margin=10), samples=16, background=(232, 228, 220),
                        outputs=("color", "distance", "normal", "object"))
seen = pictures["object"] > 0

distance = pictures["distance"]
near, far = distance[seen].min(), distance[seen].max()
grey = np.where(seen, 255 - 200 * (np.where(seen, distance, near) - near) / (far - near), 0)
normals = np.where(seen[..., None], 127.5 + 127.5 * pictures["normal"][..., :3], 0)
scattered = pictures["object"][..., None] * np.array([2654435761, 2246822519, 3266489917]) % 200 + 55
objects = np.where(seen[..., None], scattered, 0)

tiles = [pictures["color"][..., :3], grey[..., None].repeat(3, axis=2), normals, objects]
rows = [np.concatenate(tiles[:2], axis=1), np.concatenate(tiles[2:], axis=1)]
rhw.write_png(sys.argv[2], np.concatenate(rows).astype(np.uint8))
