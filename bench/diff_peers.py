#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""rhw.diff beside rasterization pixel by pixel, as PyTorch3D does it on a CPU: 16 pictures of 512 by 512 pixels, a sphere
of 49,928 triangles, rasterize and interpolate 3 attributes. Triangles and attributes are compared in the same run.

usage: bench/diff_peers.py [--threads N] [--size N] [--full], with rhw installed or PYTHONPATH=BUILD/python
  --threads N   of both; default: one for each core
  --size N      rows and columns of a picture; default 512
  --full        all 16 pictures of the peers, which takes minutes; without, one of them (of torch every 16th row of it)
                is timed and multiplied, which the work of a peer allows: it is the same for every pixel

The peers are written from PyTorch3D's documentation: bench/per_pixel.cc, which needs a C++ compiler, and below in torch,
where Python has that. PyTorch3D itself is timed where Python has it.
"""

import argparse
import ctypes
import os
import pathlib
import subprocess
import sys
import tempfile
import time
import warnings

import numpy as np

import rhw
import rhw.diff
from diff_sphere import sphere

IMAGES = 16
TORCH_STEP = 16  # of whose rows one is drawn by torch, without --full
FLAGS = ("-O3", "-march=native", "-shared", "-fPIC", "-pthread")
NEAR, FAR = 1.0, 10.0


def clip_positions(vertices):
    """(16, V, 4): in each picture the sphere, before the eye, is turned further."""
    pos = np.empty((IMAGES, len(vertices), 4), np.float32)
    for image, angle in enumerate(np.linspace(0, 1, IMAGES)):
        c, s = np.cos(angle), np.sin(angle)
        x, y, z = np.array([[1, 0, 0], [0, c, -s], [0, s, c]]) @ vertices.T
        w = 3.2 - z
        depth = ((FAR + NEAR) * w - 2 * FAR * NEAR) / (FAR - NEAR)
        pos[image] = np.stack([2.6 * x, 2.6 * y, depth, w], -1)
    return pos


def screen_corners(pos, tri):
    """(F, 3, 3): of each face's corners x and y of -1 to 1, and the distance along the view."""
    return np.ascontiguousarray(np.concatenate([pos[:, :2] / pos[:, 3:], pos[:, 3:]], 1)[tri])


def seconds(function):
    """Of the clock and of all processors together, which a busy machine changes less; and what comes of it."""
    start = time.perf_counter(), time.process_time()
    result = function()
    return np.array([time.perf_counter() - start[0], time.process_time() - start[1]]), result


# rhw ------------------------------------------------------------------------------------------------


def draw_rhw(pos, tri, attributes, size, threads):
    """Triangles from 0 on (-1: none), attributes and seconds of all pictures: the least of five."""
    context = rhw.Context(threads=threads)

    def draw():
        rast, _ = rhw.diff.rasterize(pos, tri, (size, size), context=context)
        return rast, rhw.diff.interpolate(attributes, rast, tri, context=context)[0]

    runs = [seconds(draw) for _ in range(5)]
    rast, values = runs[-1][1]
    return rast[..., 3].astype(np.int32) - 1, values, np.min([taken for taken, _ in runs], axis=0)


# Pixel by pixel in C++ ------------------------------------------------------------------------------


def load_per_pixel(folder):
    """bench/per_pixel.cc, compiled. None where there is no compiler."""
    library = os.path.join(folder, "per_pixel.so")
    source = pathlib.Path(__file__).with_name("per_pixel.cc")
    try:
        subprocess.run([os.environ.get("CXX", "c++"), *FLAGS, str(source), "-o", library], check=True)
    except FileNotFoundError:
        return None
    return ctypes.CDLL(library)


def pointer(array):
    return array.ctypes.data_as(ctypes.c_void_p)


def draw_per_pixel(library, corners, values_of_corners, size, threads):
    face, depth = np.empty((size, size), np.int32), np.empty((size, size), np.float32)
    weights, values = np.zeros((size, size, 3), np.float32), np.empty((size, size, 3), np.float32)
    library.per_pixel_rasterize(pointer(corners), len(corners), size, size, threads, pointer(face), pointer(depth),
                                pointer(weights))
    library.per_pixel_interpolate(pointer(values_of_corners), 3, size * size, pointer(face), pointer(weights),
                                  pointer(values))
    return face, values


# Pixel by pixel in torch ----------------------------------------------------------------------------


def twice_area(torch, x, y, a, b):
    return (a[:, 0] - x) * (b[:, 1] - y) - (a[:, 1] - y) * (b[:, 0] - x)


def draw_torch_row(torch, corners, boxes, size, row):
    """Faces and weights of a row: every pixel against the box of every face, and what lies in one against its edges."""
    x = (2 * torch.arange(size) + 1) / size - 1
    y = (2 * row + 1) / size - 1
    left, right, bottom, top = boxes
    within = (x[:, None] >= left) & (x[:, None] <= right) & (bottom <= y) & (top >= y)
    pixel, face = torch.nonzero(within, as_tuple=True)
    c = corners[face]
    a, b, d, at = c[:, 0], c[:, 1], c[:, 2], x[pixel]
    parts = torch.stack([twice_area(torch, at, y, b, d), twice_area(torch, at, y, d, a), twice_area(torch, at, y, a, b)], 1)
    parts = parts / parts.sum(1, keepdim=True)
    inside = (parts > 0).all(1)
    pixel, face, over_z = pixel[inside], face[inside], parts[inside] / c[inside][:, :, 2]
    weights = over_z / over_z.sum(1, keepdim=True)
    depth = (weights * c[inside][:, :, 2]).sum(1)
    nearest = torch.full((size,), torch.inf).scatter_reduce(0, pixel, depth, "amin")
    first = depth == nearest[pixel]
    found, found_weights = torch.full((size,), -1), torch.zeros(size, 3)
    found[pixel[first]] = face[first]
    found_weights[pixel[first]] = weights[first]
    return found, found_weights


def draw_torch(torch, corners, values_of_corners, size, rows):
    corners, values_of_corners = torch.from_numpy(corners), torch.from_numpy(values_of_corners)
    warnings.filterwarnings("ignore", "scatter_reduce", UserWarning)  # its interface was new in torch 1.13
    x, y = corners[:, :, 0], corners[:, :, 1]
    boxes = (x.amin(1), x.amax(1), y.amin(1), y.amax(1))
    drawn = [draw_torch_row(torch, corners, boxes, size, row) for row in rows]
    face, weights = torch.stack([each[0] for each in drawn]), torch.stack([each[1] for each in drawn])
    values = (weights[..., None] * values_of_corners[face.clamp(min=0)]).sum(-2)
    return face.numpy(), values.numpy()


# PyTorch3D ------------------------------------------------------------------------------------------


def draw_pytorch3d(torch, corners, values_of_corners, size):
    """One picture. Its x points to the left and its rows go down, so both are turned."""
    from pytorch3d.ops.interp_face_attrs import interpolate_face_attributes
    from pytorch3d.renderer.mesh.rasterize_meshes import rasterize_meshes
    from pytorch3d.structures import Meshes

    turned = torch.from_numpy(corners * np.array([-1, -1, 1], np.float32)).reshape(-1, 3)
    meshes = Meshes([turned], [torch.arange(len(turned)).reshape(-1, 3)])
    face, _, weights, _ = rasterize_meshes(meshes, size, 0.0, 1, perspective_correct=True)
    values = interpolate_face_attributes(face, weights, torch.from_numpy(values_of_corners))
    return face[0, :, :, 0].numpy(), values[0, :, :, 0].numpy()


# The table ------------------------------------------------------------------------------------------


def importable(name):
    try:
        return __import__(name)
    except ImportError:
        return None


def agreement(face, values, other_face, other_values):
    """Percent of pixels with the same triangle, and how far attributes are apart where it is."""
    same = face == other_face
    apart = np.abs(values - other_values)[same & (face >= 0)]
    return 100 * same.mean(), apart.max(initial=0)


class Table:
    """Prints a row for each peer, whose pictures must be those of rhw."""

    def __init__(self, corners, face, values, taken):
        self.agrees = True
        self._corners, self._face, self._values, self._taken = corners, face, values, taken
        print(f"{'':24} {'seconds':>9} {'of processors':>14} {'times':>6}  same triangle, attributes apart by")
        print(f"{'rhw.diff':24} {taken[0]:9.3f} {taken[1]:14.3f} {1:6.0f}")

    def row(self, name, draw, step=1):
        """draw: gives faces and values of a picture, or of every `step`th row of it."""
        total, worst, apart = np.zeros(2), 100.0, 0.0
        for corners, face, values in zip(self._corners, self._face, self._values):
            one, (other, other_values) = seconds(lambda: draw(corners))
            agreed, far = agreement(face[::step], values[::step], other, other_values)
            total, worst, apart = total + one, min(worst, agreed), max(apart, far)
        scaled = total * step * IMAGES / len(self._corners)
        note = "" if scaled[0] == total[0] else f"; from {total[0]:.1f} s of work"
        times = scaled[1] / self._taken[1]
        print(f"{name:24} {scaled[0]:9.1f} {scaled[1]:14.1f} {times:6.0f}  {worst:.2f} %, {apart:.4f}{note}", flush=True)
        self.agrees &= worst > 99


def main():
    parser = argparse.ArgumentParser(usage="%(prog)s [--threads N] [--size N] [--full]")
    parser.add_argument("--threads", type=int, default=0)
    parser.add_argument("--size", type=int, default=512)
    parser.add_argument("--full", action="store_true")
    options = parser.parse_args()
    size, step = options.size, 1 if options.full else TORCH_STEP
    vertices, tri = sphere()
    attributes = vertices * 0.5 + 0.5
    pos = clip_positions(vertices)
    corners = [screen_corners(each, tri) for each in (pos if options.full else pos[:1])]
    of_corners = np.ascontiguousarray(attributes[tri])
    threads = rhw.Context(threads=options.threads).threads
    print(f"{IMAGES} x {size} x {size}, {len(tri)} triangles, {threads} threads: rasterize and interpolate")
    table = Table(corners, *draw_rhw(pos, tri, attributes, size, options.threads))
    with tempfile.TemporaryDirectory() as folder:
        library = load_per_pixel(folder)
        if library:
            table.row("pixel by pixel in C++", lambda c: draw_per_pixel(library, c, of_corners, size, threads))
        else:
            print("pixel by pixel in C++: there is no C++ compiler; CXX names one")
    torch = importable("torch")
    if torch:
        torch.set_num_threads(threads)
        table.row("pixel by pixel in torch", lambda c: draw_torch(torch, c, of_corners, size, range(0, size, step)), step)
    else:
        print("pixel by pixel in torch: Python has no torch")
    if torch and importable("pytorch3d"):
        table.row("PyTorch3D", lambda c: draw_pytorch3d(torch, c, of_corners, size))
    else:
        print("PyTorch3D: Python has no pytorch3d")
    if not table.agrees:
        sys.exit("diff_peers: more than 1 % of the pixels show another triangle")


main()
