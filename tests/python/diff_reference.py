# SPDX-License-Identifier: MIT
"""The formulas of rhw.diff in double, for triangles that are known, and the slopes of any function by differences."""

import numpy as np


def soup(seed, images=2, vertices=24, triangles=14, behind=False):
    """Random triangles around the view, which share vertices; some reach behind the eye where asked."""
    random = np.random.default_rng(seed)
    pos = random.normal(size=(images, vertices, 4))
    pos[..., 3] = random.uniform(0.7, 2.5, (images, vertices))
    if behind:
        pos[:, ::7, 3] = random.uniform(-0.5, 0.2, (images, len(pos[0, ::7])))
    tri = np.array([random.choice(vertices, 3, replace=False) for _ in range(triangles)])
    return pos.astype(np.float32), tri


def rasterize(pos, tri, ids):
    """u, v, z/w, id and the slopes of u and v, where `ids` (H, W) has numbers of triangles + 1, of one image."""
    height, width = ids.shape
    pos = np.asarray(pos, np.float64)
    p = pos[tri[np.maximum(ids.astype(int) - 1, 0)]]
    y, x = np.mgrid[0:height, 0:width]
    r = np.stack([(2 * x + 1) / width - 1, (2 * y + 1) / height - 1, np.ones(ids.shape)], -1)
    q = p[..., [0, 1, 3]]
    n = np.stack([np.cross(q[..., (k + 1) % 3, :], q[..., (k + 2) % 3, :]) for k in range(3)], -2)
    e = np.einsum("hwkc,hwc->hwk", n, r)
    total, sides = e.sum(-1), n.sum(-2)
    weights = e / total[..., None]
    zw = (weights * p[..., 2]).sum(-1) / (weights * p[..., 3]).sum(-1)
    slopes = [(n[..., k, axis] - weights[..., k] * sides[..., axis]) / total * 2 / (width, height)[axis]
              for k in range(2) for axis in range(2)]
    seen = (ids > 0)[..., None]
    rast = np.stack([weights[..., 0], weights[..., 1], zw, ids], -1)
    return np.where(seen, rast, 0), np.where(seen, np.stack(slopes, -1), 0)


def differences(function, argument, direction, step=1e-5):
    """The slope of a function of arrays along a direction."""
    return (function(argument + step * direction) - function(argument - step * direction)) / (2 * step)


def check_gradient(function, argument, gradient, seed=0, count=8, rtol=2e-4):
    """Whether the gradient foretells what happens to the function's number along random directions, and one place each."""
    random = np.random.default_rng(seed)
    argument, gradient = np.asarray(argument, np.float64), np.asarray(gradient, np.float64)
    assert gradient.shape == argument.shape and np.isfinite(gradient).all()
    for k in range(count):
        direction = random.normal(size=argument.shape)
        if k % 2:  # the place where it says most, and others
            place = np.argsort(-np.abs(gradient), axis=None)[k // 2]
            direction = np.zeros(argument.size)
            direction[place] = 1
            direction = direction.reshape(argument.shape)
        wanted, told = differences(function, argument, direction), (gradient * direction).sum()
        assert abs(told - wanted) <= rtol * (np.abs(gradient * direction).sum() + 1e-3), (k, told, wanted)
