# SPDX-License-Identifier: MIT
"""A camera as OpenCV calibrates it: a cross stands where cv2.projectPoints would put each corner of the model's box.

usage: 03_opencv.py MODEL OUT.png
"""

import sys

import numpy as np

import rhw

WIDTH, HEIGHT = 640, 420
fx, fy, cx, cy = 700.0, 690.0, 300.0, 225.0  # not quite in the middle, as no lens is

model = rhw.load(sys.argv[1])
least, most = model.bounds.astype(float)
middle, reach = (least + most) / 2, np.linalg.norm(most - least)

# From the side, above and in front: rows are the camera's x (right), y (down) and z (forward).
forward = -np.array([0.62, 0.45, 0.64]) / np.linalg.norm([0.62, 0.45, 0.64])
right = np.cross(forward, [0, 1, 0])
right /= np.linalg.norm(right)
rotation = np.stack([right, np.cross(forward, right), forward])
translation = -rotation @ middle + [0, 0, 1.6 * reach]
extrinsic = np.concatenate([rotation, translation[:, None]], axis=1)

camera = rhw.Camera.intrinsics(fx, fy, cx, cy, extrinsic)
picture = model.render((WIDTH, HEIGHT), camera, samples=16, background=(240, 240, 238))["color"]

corners = np.array([[x, y, z] for x in (least[0], most[0]) for y in (least[1], most[1]) for z in (least[2], most[2])])
seen = corners @ rotation.T + translation
columns = np.rint(fx * seen[:, 0] / seen[:, 2] + cx).astype(int)
rows = np.rint(fy * seen[:, 1] / seen[:, 2] + cy).astype(int)
for row, column in zip(rows, columns):
    picture[row, max(column - 5, 0):column + 6, :3] = picture[max(row - 5, 0):row + 6, column, :3] = 220, 30, 30
rhw.write_png(sys.argv[2], picture)
