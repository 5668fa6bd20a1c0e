# SPDX-License-Identifier: MIT
"""rhw.diff: silhouettes, which move with vertices, and the gradients of colours and positions."""

import numpy as np
import pytest

import rhw
import rhw.diff as dr
from diff_reference import check_gradient, soup

SIZE = 36, 48


def projected(p):
    return (p[..., :2] / p[..., 3:] + 1) * 0.5 * (SIZE[1], SIZE[0])


def cross(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def formula(color, rast, pos, tri):
    """Pair by pair, as the docstrings say it: slow, in double, with edges found by sets of vertices."""
    result = np.float64(color).copy()
    sharing = {}
    for t, corners in enumerate(tri):
        for k in range(3):
            sharing.setdefault(frozenset((corners[k - 2], corners[k - 1])), []).append(corners[k])
    for image, y, x, axis in np.ndindex(len(rast), *SIZE, 2):
        here, there = (image, y, x), (image, y + axis, x + 1 - axis)
        if there[1] >= SIZE[0] or there[2] >= SIZE[1] or rast[here][3] == rast[there][3]:
            continue
        near, other = here, there
        if rast[here][3] == 0 or (rast[there][3] > 0 and rast[there][2] <= rast[here][2]):
            near, other = there, here
        corners = tri[int(rast[near][3]) - 1]
        start, end = (np.array([p[2] + 0.5, p[1] + 0.5]) for p in (near, other))
        at = projected(pos[image if len(pos) > 1 else 0])
        best = None
        for k in range(3):
            a, b = corners[k - 2], corners[k - 1]
            sides = [cross(start, end, at[v]) for v in (a, b)]
            if (sides[0] > 0) == (sides[1] > 0):
                continue
            spot = at[a] + (at[b] - at[a]) * sides[0] / (sides[0] - sides[1])
            distance = (spot - start) @ (end - start)
            if best is None or distance > best[0]:
                best = distance, k
        if best is None or not -1 / 16 < best[0] < 17 / 16:
            continue
        distance, k = np.clip(best[0], 0, 1), best[1]
        a, b = corners[k - 2], corners[k - 1]
        way = np.abs(at[b] - at[a])
        beyond = [v for v in sharing[frozenset((a, b))] if v != corners[k]]
        if way[1 - axis] < way[axis]:
            continue
        if beyond and (cross(at[a], at[b], at[beyond[0]]) > 0) != (cross(at[a], at[b], at[corners[k]]) > 0):
            continue
        to, by, share = (other, near, distance - 0.5) if distance > 0.5 else (near, other, 0.5 - distance)
        result[to] += share * (np.float64(color[by]) - color[to])
    return result


def scene(seed):
    pos, tri = soup(seed, triangles=10)
    strip = np.array([[0, 1, 2], [2, 1, 3], [2, 3, 4]])  # and some that share edges
    tri = np.concatenate([strip, tri])
    rast, _ = dr.rasterize(pos, tri, SIZE)
    color = np.random.default_rng(seed).normal(size=rast.shape[:3] + (3,)).astype(np.float32)
    return color, rast, pos, tri


@pytest.mark.parametrize("seed", range(3))
def test_values_are_those_of_the_formulas(seed):
    color, rast, pos, tri = scene(seed)
    assert len({frozenset(e) for t in tri for e in (t[:2], t[1:], t[::2])}) > 3
    result = dr.antialias(color, rast, pos, tri)
    assert (result != color).any(-1).sum() > 100
    assert np.abs(result - formula(color, rast, np.float64(pos), tri)).max() < 1e-4


@pytest.mark.parametrize("seed", range(3))
def test_gradients(seed):
    color, rast, pos, tri = scene(seed)
    to_result = np.random.default_rng(seed + 9).normal(size=color.shape).astype(np.float32)
    to_color, to_pos = dr.antialias_grad(color, rast, pos, tri, to_result)
    whole = (np.float64(to_color) * color).sum()
    assert whole == pytest.approx((np.float64(dr.antialias(color, rast, pos, tri)) * to_result).sum(), rel=1e-4)
    assert not to_pos[..., 2].any() and np.abs(to_pos).max() > 1

    def loss(moved):
        return (formula(color, rast, moved, tri) * to_result).sum()

    check_gradient(loss, pos, to_pos, seed, count=6)


def test_a_square_covers_what_it_covers():
    """Half a pixel more of an upright edge is half a pixel more of colour, and the gradient says so.

    Without the row at the top: beside the edge it sees the triangle of the other half, which ends at the diagonal first.
    """
    def drawn(right):
        pos = np.array([[[-0.5, -0.5, 0, 1], [right, -0.5, 0, 1], [right, 0.5, 0, 1], [-0.5, 0.5, 0, 1]]], np.float32)
        tri = [[0, 1, 2], [0, 2, 3]]
        rast, _ = dr.rasterize(pos, tri, (32, 32))
        color = (rast[..., 3:] > 0).astype(np.float32)
        return pos, tri, rast, color, dr.antialias(color, rast, pos, tri)

    for right in np.linspace(0.3, 0.5, 21):
        pos, tri, rast, color, result = drawn(right)
        assert result[:, 8:23].sum() == pytest.approx((right + 0.5) * 16 * 15, abs=0.01)
        _, to_pos = dr.antialias_grad(color, rast, pos, tri, (np.arange(32)[None, :, None, None] < 23) + 0 * color)
        assert to_pos[0, 1:3, 0].sum() == pytest.approx(16 * 15, rel=1e-4)


def test_topology_of_any_numbers():
    """Edges of vertices whose numbers have two, some or nearly all of 32 bits, against a table of them."""
    random = np.random.default_rng(2)
    for shift in (0, 2, 15, 16, 20, 29):
        tri = random.integers(0, 3, (90, 3)) + (random.integers(0, 3, (90, 3)) << shift)
        edges = {}
        for corner in range(90 * 3):
            ends = frozenset(tri[corner // 3, [(corner + 1) % 3, (corner + 2) % 3]].tolist())
            edges.setdefault(ends, []).append(corner)
        wanted = np.full(270, 2**32 - 1, np.uint32)
        for corners in edges.values():
            if len(corners) > 1:
                wanted[corners] = tri.reshape(-1)[corners[1:] + corners[:1]]
        assert np.array_equal(dr.antialias_construct_topology_hash(tri), wanted.reshape(-1, 3)), shift


def test_topology():
    assert dr.antialias_construct_topology_hash([[0, 1, 2], [2, 1, 3]]).tolist() == [
        [3, 2**32 - 1, 2**32 - 1], [2**32 - 1, 2**32 - 1, 0]]
    fan = dr.antialias_construct_topology_hash([[0, 1, 2], [0, 1, 3], [1, 0, 4]])
    assert fan[:, 2].tolist() == [3, 4, 2]
    assert dr.antialias_construct_topology_hash(np.zeros((0, 3), int)).shape == (0, 3)


def test_shared_positions_collect_from_all_images():
    color, rast, pos, tri = scene(1)
    one = pos[0]
    rast, _ = dr.rasterize(one, tri, SIZE, [[0, 6], [6, 7]])
    grads = dr.antialias_grad(color, rast, one, tri, color)
    parts = [dr.antialias_grad(color[i:i + 1], rast[i:i + 1], one[None], tri, color[i:i + 1]) for i in range(2)]
    assert np.array_equal(grads[0], np.concatenate([part[0] for part in parts]))
    assert np.allclose(grads[1], parts[0][1][0] + parts[1][1][0], rtol=1e-5, atol=1e-5)


def test_bytes_do_not_depend_on_threads():
    color, rast, pos, tri = scene(2)
    found = []
    for threads in (1, 2, 5):
        context = rhw.Context(threads=threads)
        result = dr.antialias(color, rast, pos, tri, context=context)
        found.append([a.tobytes() for a in (result, *dr.antialias_grad(color, rast, pos, tri, result, context=context))])
    assert found[0] == found[1] == found[2]


@pytest.mark.parametrize("wrong, line", [
    (dict(color=np.zeros((1, 4, 5, 3))), "color: must have the shape (1, 4, 4, N), not (1, 4, 5, 3)"),
    (dict(color=np.zeros((1, 4, 4, 0))), "color: number of channels: must lie between 1 and 16384, not 0"),
    (dict(pos=np.zeros((2, 3, 4))), "pos: must have 1 images, as rast has, not 2"),
    (dict(topology_hash=np.zeros((2, 3), np.uint32)), "topology_hash: must have the shape (1, 3), not (2, 3)"),
])
def test_mistakes_are_told(wrong, line):
    good = dict(color=np.zeros((1, 4, 4, 3)), rast=np.zeros((1, 4, 4, 4)), pos=np.zeros((1, 3, 4)), tri=[[0, 1, 2]])
    with pytest.raises((TypeError, ValueError)) as told:
        dr.antialias(**{**good, **wrong})
    assert str(told.value) == line
