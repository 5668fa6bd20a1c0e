#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Milliseconds of the operations of rhw.diff: 16 pictures of 512 by 512, a sphere of 49,928 triangles, least of five.

usage: bench/diff_speed.py [THREADS...], with rhw installed or PYTHONPATH=BUILD/python
"""

import sys
import time

import numpy as np

import rhw
import rhw.diff as dr

IMAGES, SIDES, SIZE = 16, 158, (512, 512)


def sphere():
    """A grid around a sphere, its poles included."""
    t, p = np.meshgrid(np.linspace(0, np.pi, SIDES + 1), np.linspace(0, 2 * np.pi, SIDES + 1), indexing="ij")
    vertices = np.stack([np.sin(t) * np.cos(p), np.cos(t), np.sin(t) * np.sin(p)], -1).reshape(-1, 3)
    a = (np.arange(SIDES)[:, None] * (SIDES + 1) + np.arange(SIDES)).ravel()
    faces = [np.stack([a, a + 1, a + SIDES + 1], 1), np.stack([a + 1, a + SIDES + 2, a + SIDES + 1], 1)]
    return vertices.astype(np.float32), np.concatenate(faces).astype(np.uint32)


def milliseconds(function, **keywords):
    def once():
        start = time.perf_counter()
        function(**keywords)
        return time.perf_counter() - start

    return min(once() for _ in range(5)) * 1e3


attributes, tri = sphere()
pos = np.ones((IMAGES, len(attributes), 4), np.float32)
for image in range(IMAGES):
    pos[image, :, :3] = attributes * [0.8, 0.8, 0.3] + [0.01 * image, 0, 0]
rast, rast_db = dr.rasterize(pos, tri, SIZE)
color, _ = dr.interpolate(attributes, rast, tri)
uv, uv_da = dr.interpolate(attributes[:, :2].copy(), rast, tri, rast_db, "all")
texture = np.random.default_rng(1).random((1, 512, 512, 3), np.float32)
topology = dr.antialias_construct_topology_hash(tri)

print(f"{IMAGES} x {SIZE[0]} x {SIZE[1]}, {len(tri)} triangles; milliseconds for all, least of five")
for threads in [int(argument) for argument in sys.argv[1:]] or [0]:
    context = rhw.Context(threads=threads)
    rows = [(dr.rasterize, dict(pos=pos, tri=tri, resolution=SIZE)),
            (dr.rasterize_grad, dict(pos=pos, tri=tri, rast=rast, to_rast=rast)),
            (dr.interpolate, dict(attr=attributes, rast=rast, tri=tri)),
            (dr.interpolate_grad, dict(attr=attributes, rast=rast, tri=tri, to_values=color)),
            (dr.texture, dict(tex=texture, uv=uv, uv_da=uv_da)),
            (dr.texture_grad, dict(tex=texture, uv=uv, to_values=color, uv_da=uv_da)),
            (dr.antialias, dict(color=color, rast=rast, pos=pos, tri=tri, topology_hash=topology)),
            (dr.antialias_grad, dict(color=color, rast=rast, pos=pos, tri=tri, to_result=color, topology_hash=topology))]
    for function, keywords in rows:
        print(f"{context.threads} threads  {function.__name__:17} {milliseconds(function, context=context, **keywords):8.1f}")
