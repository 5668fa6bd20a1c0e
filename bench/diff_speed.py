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
from diff_sphere import sphere

IMAGES, SIZE = 16, (512, 512)


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
