# SPDX-License-Identifier: MIT
"""rhw.diff: what pixels see, attributes at pixels, and the gradients of both."""

import resource

import numpy as np
import pytest

import rhw
import rhw.diff as dr
from diff_reference import check_gradient, rasterize, soup

SIZE = 36, 48
SEEDS = range(6)


def random_like(array, seed=9):
    return np.random.default_rng(seed).normal(size=np.shape(array)).astype(np.float32)


@pytest.mark.parametrize("behind", [False, True])
@pytest.mark.parametrize("seed", SEEDS)
def test_values_are_those_of_the_formulas(seed, behind):
    pos, tri = soup(seed, behind=behind)
    rast, rast_db = dr.rasterize(pos, tri, SIZE)
    assert (rast[..., 3] > 0).mean() > 0.1
    for image in range(2):
        values, slopes = rasterize(pos[image], tri, rast[image, ..., 3])
        # Positions are rounded to 1/256 pixel, which moves weights by what they change on such a way, seen from each side.
        room = 4e-5 + np.abs(slopes).sum(-1, keepdims=True) / 64
        if not behind:
            assert (np.abs(rast[image] - values)[..., :2] <= room).all()
        near = room[..., 0] < 2e-3
        assert near.any()
        assert np.abs(rast[image] - values)[near].max() < 0.02
        assert np.abs(rast_db[image] - slopes)[near].max() < 2e-3
    assert rast[..., :2].min() >= 0
    assert (rast[..., 0] + rast[..., 1]).max() <= 1 + 1e-6


def test_conventions():
    """Row 0 is below, pixel centres lie at .5, u and v are the weights of the first two vertices, ids begin at 1."""
    pos = np.array([[[-1, -1, -0.5, 1], [1, -1, 0.25, 1], [-1, 1, 0.25, 1]]], np.float32)
    rast, rast_db = dr.rasterize(pos, [[0, 1, 2]], (4, 8))
    assert rast[0, 0, 0].tolist() == pytest.approx([1 - 1 / 16 - 1 / 8, 1 / 16, -0.5 + 0.75 * 3 / 16, 1])
    assert rast_db[0, 0, 0].tolist() == pytest.approx([-1 / 8, -1 / 4, 1 / 8, 0])
    assert rast[0, 3, 7].tolist() == [0, 0, 0, 0]


def test_the_nearest_is_seen_and_peeled():
    layers = np.array([0.5, -0.25, 0.75, 0.0])
    pos = np.array([[[-1, -1, z, 1], [3, -1, z, 1], [-1, 3, z, 1]] for z in layers], np.float32).reshape(1, -1, 4)
    tri = np.arange(12).reshape(4, 3)
    with dr.DepthPeeler(pos, tri, SIZE) as peeler:
        seen = [peeler.rasterize_next_layer()[0] for _ in range(5)]
    for k, triangle in enumerate(np.argsort(layers)):
        assert (seen[k][..., 3] == triangle + 1).all()
        assert np.abs(seen[k][..., 2] - layers[triangle]).max() < 1e-6
    assert not seen[4].any()


def test_peeling_finds_all_layers():
    pos, tri = soup(3)
    alone = sum((dr.rasterize(pos, tri[k:k + 1], SIZE)[0][..., 3] > 0).astype(int) for k in range(len(tri)))
    layers = 0
    with dr.DepthPeeler(pos, tri, SIZE) as peeler:
        while (seen := peeler.rasterize_next_layer()[0][..., 3] > 0).any():
            layers = layers + seen.astype(int)
    assert (layers == alone).all()


def test_ranges_are_batches_of_their_own():
    pos, tri = soup(4, images=1)
    rast, rast_db = dr.rasterize(pos[0], tri, SIZE, [[0, 5], [5, 9], [3, 0]])
    for image, (first, count) in enumerate([(0, 5), (5, 9)]):
        alone, alone_db = dr.rasterize(pos, tri[first:first + count], SIZE)
        alone[..., 3] += first * (alone[..., 3] > 0)
        assert np.array_equal(rast[image], alone[0]) and np.array_equal(rast_db[image], alone_db[0])
    assert not rast[2].any()
    to_rast, to_db = random_like(rast), random_like(rast_db)
    parts = [dr.rasterize_grad(pos, tri, rast[i:i + 1], to_rast[i:i + 1], to_db[i:i + 1])[0] for i in range(3)]
    assert np.allclose(dr.rasterize_grad(pos[0], tri, rast, to_rast, to_db), sum(parts), rtol=1e-4, atol=1e-3)


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("slopes", [False, True])
def test_gradient_of_positions(seed, slopes):
    pos, tri = soup(seed)
    rast, rast_db = dr.rasterize(pos, tri, SIZE)
    rast[np.abs(rast_db).sum(-1) > 1] = 0  # of triangles seen almost on edge differences say nothing
    to_rast, to_db = random_like(rast), random_like(rast_db) if slopes else None

    def loss(moved):
        total = 0.0
        for image in range(2):
            values, db = rasterize(moved[image], tri, rast[image, ..., 3])
            total += (values[..., :2] * to_rast[image, ..., :2]).sum() + ((db * to_db[image]).sum() if slopes else 0)
        return total

    gradient = dr.rasterize_grad(pos, tri, rast, to_rast, to_db)
    assert not gradient[..., 2].any() and np.abs(gradient).max() > 0.1
    check_gradient(loss, pos, gradient, seed)


@pytest.mark.parametrize("shared", [False, True])
@pytest.mark.parametrize("diff_attrs", [None, "all", [2, 0, 2]])
@pytest.mark.parametrize("seed", SEEDS)
def test_interpolation(seed, diff_attrs, shared):
    pos, tri = soup(seed)
    attr = np.random.default_rng(seed).normal(size=((1 if shared else 2), pos.shape[1], 4)).astype(np.float32)
    rast, rast_db = dr.rasterize(pos, tri, SIZE)
    selected = [] if diff_attrs is None else range(4) if diff_attrs == "all" else diff_attrs

    def formula(attr, rast, rast_db):
        a = np.stack([attr[i % len(attr)][tri[np.maximum(rast[i, ..., 3].astype(int) - 1, 0)]] for i in range(2)])
        seen = (rast[..., 3] > 0)[..., None]
        along_u, along_v = a[..., 0, :] - a[..., 2, :], a[..., 1, :] - a[..., 2, :]
        values = rast[..., :1] * along_u + rast[..., 1:2] * along_v + a[..., 2, :]
        slopes = [rast_db[..., k, None] * along_u[..., list(selected)] + rast_db[..., 2 + k, None] * along_v[..., list(selected)]
                  for k in range(2)]
        return np.where(seen, values, 0), np.where(seen, np.stack(slopes, -1).reshape(seen.shape[:3] + (-1,)), 0)

    values, slopes = dr.interpolate(attr, rast, tri, rast_db, diff_attrs)
    wanted = formula(attr, rast, rast_db)
    assert values.shape == wanted[0].shape and slopes.shape == wanted[1].shape
    assert np.allclose(values, wanted[0], atol=1e-5) and np.allclose(slopes, wanted[1], rtol=1e-4, atol=1e-4)

    assert np.array_equal(dr.interpolate(attr[..., :1], rast, tri)[0], values[..., :1])  # one alone

    to_values, to_slopes = random_like(values), random_like(slopes, 10)
    to_attr, to_rast, to_db = dr.interpolate_grad(attr, rast, tri, to_values, rast_db, to_slopes, diff_attrs)

    def loss(attr, rast, rast_db):
        v, s = formula(attr, rast, rast_db)
        return (v * to_values).sum() + (s * to_slopes).sum()

    double = [np.float64(array) for array in (attr, rast, rast_db)]
    check_gradient(lambda a: loss(a, *double[1:]), attr, to_attr, seed)
    assert not to_rast[..., 2:].any()

    def moved(uv):
        return loss(double[0], np.concatenate([uv, double[1][..., 2:]], -1), double[2])

    check_gradient(moved, rast[..., :2], to_rast[..., :2], seed)
    if selected:
        check_gradient(lambda db: loss(*double[:2], db), rast_db, to_db, seed)
    else:
        assert to_db is None


def test_bytes_do_not_depend_on_threads():
    pos, tri = soup(5, images=3, vertices=1500, triangles=2000)
    attr = random_like(np.zeros((1, 1500, 3)))
    found = []
    for threads in (1, 2, 5):
        context = rhw.Context(threads=threads)
        rast, db = dr.rasterize(pos, tri, SIZE, context=context)
        values, slopes = dr.interpolate(attr, rast, tri, db, "all", context=context)
        grads = dr.interpolate_grad(attr, rast, tri, random_like(values), db, random_like(slopes), "all", context=context)
        to_pos = dr.rasterize_grad(pos, tri, rast, grads[1], grads[2], context=context)
        found.append([array.tobytes() for array in (rast, db, values, slopes, *grads, to_pos)])
    assert found[0] == found[1] == found[2]


def test_many_images_add_to_one_position():
    """Images that share positions: the sum of their gradients, of which most are a part of 2^-24 of the first."""
    pos = np.array([[-1, -1, 0, 1], [3, -1, 0, 1], [-1, 3, 0, 1]], np.float32)
    images = 20000
    rast, _ = dr.rasterize(pos, [[0, 1, 2]], (1, 1), np.tile([[0, 1]], (images, 1)))
    to_rast = np.zeros_like(rast)
    to_rast[:, ..., :2] = 1e-3
    to_rast[0, ..., :2] = 2e4
    of_one = dr.rasterize_grad(pos, [[0, 1, 2]], rast[:1], np.ones_like(rast[:1])).astype(np.float64)
    wanted = of_one * (2e4 + (images - 1) * np.float64(np.float32(1e-3)))
    assert of_one.any()
    assert np.allclose(dr.rasterize_grad(pos, [[0, 1, 2]], rast, to_rast), wanted, rtol=1e-6)


GOOD = dict(pos=np.zeros((1, 3, 4), np.float32), tri=[[0, 1, 2]], resolution=(4, 4))


@pytest.mark.parametrize("wrong, line", [
    (dict(pos=np.zeros((1, 3, 3))), "pos: must have the shape (N, N, 4), not (1, 3, 3)"),
    (dict(pos=np.zeros((3, 4))), "ranges: must be given where pos has the shape (V, 4)"),
    (dict(pos=np.full((1, 3, 4), np.nan)), "pos: every number must be finite, as float32 too"),
    (dict(tri=[[0, 1, 3]]), "tri: must lie between 0 and 2, the last of 3 vertices, not 3"),
    (dict(tri=[[0, 1, 2.5]]), "tri: must be of integers, not float64"),
    (dict(tri=np.broadcast_to(np.arange(3, dtype=np.uint8), (2**24 + 1, 3))),
     "tri: number of triangles: must lie between 0 and 16777216, not 16777217"),
    (dict(resolution=(0, 4)), "resolution: must lie between 1 and 16384, not 0"),
    (dict(resolution=4), "resolution: must be (height, width)"),
    (dict(pos=np.zeros((3, 4)), ranges=[[0, 2]]), "ranges: must lie between 0 and 1"),
    (dict(pos=np.zeros((3, 4)), ranges=[[1, 1]]), "ranges: there must be one, and each end at or before 1, the number of triangles"),
])
def test_mistakes_are_told(wrong, line):
    with pytest.raises((TypeError, ValueError)) as told:
        dr.rasterize(**{**GOOD, **wrong})
    assert str(told.value).startswith(line)


def test_nothing_is_drawn_of_nothing():
    rast, rast_db = dr.rasterize(GOOD["pos"], np.zeros((0, 3), int), (4, 4))
    assert not rast.any() and not rast_db.any()
    nonsense = np.full((1, 4, 4, 4), 1e9, np.float32)
    assert not dr.interpolate(np.ones((3, 2)), nonsense, [[0, 1, 2]])[0].any()
    assert not dr.rasterize_grad(GOOD["pos"], [[0, 1, 2]], nonsense, nonsense).any()


def test_gradients_that_are_not_finite_count_where_something_is_drawn_alone():
    pos, tri = soup(3)
    rast, rast_db = dr.rasterize(pos, tri, (8, 8))
    seen = rast[..., 3:] > 0
    tame = np.random.default_rng(3).normal(size=rast.shape)
    wild = np.where(seen, tame, [np.nan, np.inf, -np.inf, 1e300])
    beside = wild.copy()
    beside[..., 2:] = np.nan  # z/w and the triangle's number have no gradient
    tame = np.where(seen, tame, 0)
    calls = [
        ("to_rast", lambda given: dr.rasterize_grad(pos, tri, rast, given, tame)),
        ("to_rast_db", lambda given: dr.rasterize_grad(pos, tri, rast, tame, given)),
        ("to_values", lambda given: dr.interpolate_grad(pos, rast, tri, given)[0]),
        ("to_slopes", lambda given: dr.interpolate_grad(pos, rast, tri, tame, rast_db, given, [1, 2])[2]),
        ("to_result", lambda given: dr.antialias_grad(tame, rast, pos, tri, given)[1]),
        ("to_result", lambda given: dr.antialias_grad(tame, rast, pos, tri, given)[0])]
    for name, call in calls:
        assert call(tame).any() and np.array_equal(call(wild), call(tame))
        with pytest.raises(ValueError, match=f"^{name}: every number must be finite where something is drawn$"):
            call(np.where(seen, np.nan, tame))
    assert np.array_equal(calls[0][1](beside), calls[0][1](tame))


def test_large_arrays_are_used_again():
    """The system clears pages as they are touched: a third of the time of a training went by with that."""
    pos = np.array([[[-0.8, -0.8, 0, 1], [0.8, -0.8, 0, 1], [-0.8, 0.8, 0, 1]]], np.float32)
    tri = np.array([[0, 1, 2]])

    def step():
        rast, _ = dr.rasterize(pos, tri, (1024, 1024))
        at, _ = dr.interpolate(pos[0], rast, tri)
        to_at, to_pos = dr.antialias_grad(at, rast, pos, tri, at)
        return to_pos + dr.rasterize_grad(pos, tri, rast, dr.interpolate_grad(pos[0], rast, tri, to_at)[1])

    first = step()
    step()
    before = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
    assert np.array_equal(step(), first)
    pages_of_rast = 1024 * 1024 * 16 // 4096
    assert resource.getrusage(resource.RUSAGE_SELF).ru_minflt - before < pages_of_rast / 4  # of ten such arrays


@pytest.mark.parametrize("shared", [True, False])
def test_gradients_of_attributes_add_up_in_any_number_of_threads(shared):
    """By the formula in double; with more images than are worked on at a time."""
    pos, tri = soup(5, images=9)
    random = np.random.default_rng(5)
    attr = random.normal(size=(1 if shared else 9, pos.shape[1], 700)).astype(np.float32)
    rast, _ = dr.rasterize(pos, tri, (6, 5))
    to_values = random.normal(size=rast.shape[:3] + (700,))
    wanted = np.zeros((9, pos.shape[1], 700))
    for image, y, x in zip(*np.nonzero(rast[..., 3])):
        u, v, _, number = rast[image, y, x].astype(np.float64)
        for vertex, weight in zip(tri[int(number) - 1], (u, v, 1 - u - v)):
            wanted[image, vertex] += weight * to_values[image, y, x]
    found = [dr.interpolate_grad(attr, rast, tri, to_values, context=rhw.Context(threads=threads)) for threads in (1, 3)]
    assert all(np.array_equal(one, other) for one, other in zip(found[0][:2], found[1][:2]))
    assert np.allclose(found[0][0], wanted.sum(0, keepdims=True) if shared else wanted, rtol=1e-5, atol=1e-5)
