# SPDX-License-Identifier: MIT
"""rhw.diff: textures, and the gradients of texels, coordinates, their slopes and the level."""

import numpy as np
import pytest

import rhw
import rhw.diff as dr
from diff_reference import check_gradient
from rhw import _rhw

FILTERS = ["nearest", "linear", "linear-mipmap-nearest", "linear-mipmap-linear"]
BOUNDARIES = ["wrap", "clamp", "zero"]


def scene(seed, cube=False, shared=False):
    random = np.random.default_rng(seed)
    size = (6, 16, 16) if cube else (16, 32)
    tex = random.normal(size=((1 if shared else 2),) + size + (3,)).astype(np.float32)
    uv = random.normal(size=(2, 9, 11, 3)) if cube else random.uniform(-0.6, 1.6, (2, 9, 11, 2))
    uv_da = random.normal(size=uv.shape[:3] + (2 * uv.shape[3],)) * np.exp(random.uniform(-5, 0, (2, 9, 11, 1)))
    bias = random.uniform(-0.5, 0.5, (2, 9, 11))
    return [tex] + [array.astype(np.float32) for array in (uv, uv_da, bias)]


def levels_of(tex):
    """Means of 2 by 2, written without the extension's help."""
    levels = [np.float64(tex)]
    while max(levels[-1].shape[-3:-1]) > 1:
        t = levels[-1]
        h, w = (max(side // 2, 1) for side in t.shape[-3:-1])
        levels.append(t.reshape(*t.shape[:-3], h, t.shape[-3] // h, w, t.shape[-2] // w, t.shape[-1]).mean((-4, -2)))
    return levels


def texel(level, x, y, boundary):
    height, width = level.shape[1:3]
    inside = (x >= 0) & (x < width) & (y >= 0) & (y < height)
    if boundary == "wrap":
        x, y = x % width, y % height
    x, y = np.clip(x, 0, width - 1), np.clip(y, 0, height - 1)
    image = np.arange(len(x))[:, None, None] % len(level)
    return level[image, y, x] * (1.0 if boundary != "zero" else inside[..., None])


def read_level(level, uv, filter_mode, boundary):
    height, width = level.shape[1:3]
    if filter_mode == "nearest":
        x, y = np.floor(uv * (width, height)).astype(int).transpose(3, 0, 1, 2)
        return texel(level, x, y, boundary)
    at = uv * (width, height) - 0.5
    if boundary == "clamp":
        at = np.clip(at, 0, (width - 1, height - 1))
    x, y = np.floor(at).astype(int).transpose(3, 0, 1, 2)
    fx, fy = (at - np.floor(at)).transpose(3, 0, 1, 2)[..., None]
    return sum(texel(level, x + i, y + j, boundary) * (fx if i else 1 - fx) * (fy if j else 1 - fy)
               for i in (0, 1) for j in (0, 1))


def formula(levels, uv, uv_da, bias, filter_mode, boundary):
    """Flat textures. The level is the logarithm of the footprint's greatest stretch, which is a singular value."""
    if "mipmap" not in filter_mode:
        return read_level(levels[0], uv, filter_mode, boundary)
    height, width = levels[0].shape[1:3]
    jacobian = uv_da.reshape(uv.shape[:3] + (2, 2)) * np.array([[width], [height]])
    level = np.clip(np.log2(np.linalg.svd(jacobian, compute_uv=False)[..., 0]) + bias, 0, len(levels) - 1)
    read = np.stack([read_level(t, uv, "linear", boundary) for t in levels])
    grid = tuple(np.indices(level.shape))
    if filter_mode == "linear-mipmap-nearest":
        return read[(np.floor(level + 0.5).astype(int), *grid)]
    low = np.minimum(level.astype(int), len(levels) - 2)
    part = (level - low)[..., None]
    return read[(low, *grid)] * (1 - part) + read[(low + 1, *grid)] * part


@pytest.mark.parametrize("boundary", BOUNDARIES)
@pytest.mark.parametrize("filter_mode", FILTERS)
@pytest.mark.parametrize("seed", range(3))
def test_flat_textures(seed, filter_mode, boundary):
    tex, uv, uv_da, bias = scene(seed, shared=seed == 1)
    values = dr.texture(tex, uv, uv_da, bias, None, filter_mode, boundary)
    double = [np.float64(array) for array in (uv, uv_da, bias)]
    wanted = formula(levels_of(tex), *double, filter_mode, boundary)
    assert np.abs(values - wanted).max() < 2e-5

    to_values = np.random.default_rng(seed).normal(size=values.shape).astype(np.float32)
    to_tex, to_uv, to_da, to_bias, to_mip = dr.texture_grad(tex, uv, to_values, uv_da, bias, None, filter_mode, boundary)

    def loss(levels, uv, uv_da, bias):
        return (formula(levels, uv, uv_da, bias, filter_mode, boundary) * to_values).sum()

    check_gradient(lambda t: loss(levels_of(t), *double), tex, to_tex, seed)
    assert to_mip == []
    if filter_mode == "nearest":
        assert not to_uv.any()
    else:
        check_gradient(lambda a: loss(levels_of(tex), a, *double[1:]), uv, to_uv, seed)
    if filter_mode == "linear-mipmap-linear":
        check_gradient(lambda a: loss(levels_of(tex), double[0], a, double[2]), uv_da, to_da, seed, rtol=1e-3)
        check_gradient(lambda a: loss(levels_of(tex), *double[:2], a), bias, to_bias, seed)
    else:
        assert not to_da.any() and not to_bias.any()


@pytest.mark.parametrize("boundary, ends", [("wrap", [-1e-30, -1.25, 1, 2]), ("clamp", [1, 1e30, -1e30, -0.0])])
def test_nearest_at_the_ends(boundary, ends):
    """Two coordinates that read the last texel of a row of three, and two that read the first, just there or far away."""
    tex, uv = np.float32([[[[5], [6], [7]]]]), np.float32([[[[end, 0.5] for end in ends]]])
    read = dr.texture(tex, uv, filter_mode="nearest", boundary_mode=boundary)
    assert read[0, 0, :, 0].tolist() == [7, 7, 5, 5]


def test_levels_of_ones_own():
    tex, uv, uv_da, _ = scene(7)
    mip = [np.random.default_rng(k).normal(size=(2, 16 >> k, 32 >> k, 3)).astype(np.float32) for k in (1, 2)]
    values = dr.texture(tex, uv, uv_da, mip=mip)
    assert np.abs(values - formula([tex, *mip], np.float64(uv), np.float64(uv_da), 0, "linear-mipmap-linear", "wrap")).max() < 2e-5
    to_tex, _, _, _, to_mip = dr.texture_grad(tex, uv, values, uv_da, mip=mip)
    whole = sum((np.float64(a) * b).sum() for a, b in zip([to_tex, *to_mip], [tex, *mip]))
    assert whole == pytest.approx((np.float64(values)**2).sum(), rel=1e-5)
    assert np.array_equal(dr.texture(tex, uv, uv_da, max_mip_level=2),
                          dr.texture(tex, uv, uv_da, mip=dr.texture_construct_mip(tex, 2)))
    assert np.array_equal(dr.texture(tex, uv, uv_da, max_mip_level=0), dr.texture(tex, uv))


def texel_directions(size):
    """Where the middles of a cube's texels lie, as OpenGL has the faces."""
    t, s = (2 * np.mgrid[0:size, 0:size] + 1) / size - 1
    one = np.ones_like(s)
    return np.stack([np.stack(d, -1) for d in [(one, -t, -s), (-one, -t, s), (s, one, t), (s, -one, -t), (s, -t, one),
                                               (-s, -t, -one)]])


def test_cube_faces():
    tex = scene(1, cube=True)[0][:1]
    directions = texel_directions(16).reshape(1, 96, 16, 3) * 3.0
    for filter_mode in ("nearest", "linear"):
        read = dr.texture(tex, directions, filter_mode=filter_mode, boundary_mode="cube")
        assert np.abs(read.reshape(tex.shape) - tex).max() < 1e-5
    assert not dr.texture(tex, np.zeros((1, 2, 2, 3)), boundary_mode="cube").any()


def test_cube_has_no_seams():
    """Around its edges and corners what is read goes on: a smooth picture of directions stays one."""
    size = 64
    center = texel_directions(size)
    smooth = center / np.linalg.norm(center, axis=-1, keepdims=True)
    random = np.random.default_rng(2)
    edge = np.sign(random.normal(size=(1, 40, 50, 3))) * np.where(random.random((1, 40, 50, 3)) < 0.7, 1, random.random((1, 40, 50, 3)))
    edge += random.normal(size=edge.shape) * 0.01
    read = dr.texture(smooth[None], edge, boundary_mode="cube")
    assert np.abs(read - edge / np.linalg.norm(edge, axis=-1, keepdims=True)).max() < 1.0 / size
    across = np.array([[[[1, 1 + d, 0.3] for d in (-1e-5, 1e-5)]]])
    noise = random.normal(size=(1, 6, 8, 8, 1))
    assert np.ptp(dr.texture(noise, across, boundary_mode="cube")) < 1e-3


@pytest.mark.parametrize("filter_mode", FILTERS)
@pytest.mark.parametrize("seed", range(3))
def test_cube_gradients(seed, filter_mode):
    tex, uv, uv_da, bias = scene(seed, cube=True)
    bias += 3
    options = dict(filter_mode=filter_mode, boundary_mode="cube")
    values = dr.texture(tex, uv, uv_da, bias, **options)
    to_values = np.random.default_rng(seed).normal(size=values.shape).astype(np.float32)
    to_tex, to_uv, to_da, to_bias, _ = dr.texture_grad(tex, uv, to_values, uv_da, bias, **options)
    assert (np.float64(to_tex) * tex).sum() == pytest.approx((np.float64(to_values) * values).sum(), rel=1e-4, abs=1e-3)

    # Values are floats, which forbids small steps, and slopes break at texels: pixels whose two sides agree are compared.
    for array, gradient, name in [(uv, to_uv, "uv"), (uv_da, to_da, "uv_da"), (bias[..., None], to_bias[..., None], "bias")]:
        compared = 0
        for channel in range(array.shape[-1]):
            step = np.zeros(array.shape[-1], np.float32)
            step[channel] = 2e-3
            moved = [dict(uv=uv, uv_da=uv_da, mip_level_bias=bias) for _ in range(2)]
            for sign, arguments in zip((-1, 1), moved):
                key = "mip_level_bias" if name == "bias" else name
                arguments[key] = (array + sign * step).reshape(bias.shape if name == "bias" else array.shape)
            below, above = ((np.float64(dr.texture(tex, **a, **options)) * to_values).sum(-1) for a in moved)
            here = (np.float64(values) * to_values).sum(-1)
            slope = (above - below) / 4e-3
            straight = np.abs(above + below - 2 * here) < 1e-5
            compared += straight.sum()
            assert np.abs(slope - gradient[..., channel])[straight].max() < 2e-2 * (1 + np.abs(slope[straight]).max())
        assert compared > 50
    if filter_mode == "linear-mipmap-linear":
        assert to_bias.any() and to_da.any() and to_uv.any()


@pytest.mark.parametrize("cube", [False, True])
def test_bytes_do_not_depend_on_threads(cube):
    tex, uv, uv_da, bias = scene(3, cube=cube, shared=True)
    options = dict(boundary_mode="cube") if cube else {}
    found = []
    for threads in (1, 2, 5):
        context = rhw.Context(threads=threads)
        values = dr.texture(tex, uv, uv_da, bias, context=context, **options)
        grads = dr.texture_grad(tex, uv, values, uv_da, bias, context=context, **options)
        found.append([values.tobytes()] + [array.tobytes() for array in grads[:4]])
    assert found[0] == found[1] == found[2]


def test_a_million_pixels_add_to_a_texel():
    """Each is a part of 2^-24 of what is there already: sums of floats would not see it."""
    random = np.random.default_rng(4)
    uv = random.uniform(0.3, 0.7, (1, 1000, 1000, 2)).astype(np.float32)
    to_values = random.uniform(0.5e-3, 1.5e-3, (1, 1000, 1000, 1)).astype(np.float32)
    to_values[0, 0, 0] = 2e4
    tex = np.ones((1, 1, 2, 1), np.float32)
    part = np.float64(uv[..., 0]) * 2 - 0.5  # of the second texel
    wanted = [((1 - part) * to_values[..., 0]).sum(), (part * to_values[..., 0]).sum()]
    found = []
    for threads in (1, 3):
        to_tex = dr.texture_grad(tex, uv, to_values, boundary_mode="clamp", context=rhw.Context(threads=threads))[0]
        assert to_tex.reshape(-1) == pytest.approx(wanted, rel=1e-7)
        found.append(to_tex.tobytes())
    assert found[0] == found[1]

    # The slope of the loss, a number of double precision, when the first texel moves.
    moved = [np.array([1 + step, 1.0]) for step in (-1e-3, 1e-3)]
    losses = [((texels[0] * (1 - part) + texels[1] * part) * to_values[..., 0]).sum() for texels in moved]
    assert to_tex[0, 0, 0, 0] == pytest.approx((losses[1] - losses[0]) / 2e-3, rel=1e-7)


@pytest.mark.parametrize("boundary", ["cube", "wrap"])
def test_slopes_that_are_no_numbers_have_no_gradient(boundary):
    tex, uv, uv_da, bias = scene(5, cube=boundary == "cube", shared=True)
    tex = tex[:1].copy()
    broken = np.zeros(uv.shape[:3], bool)
    broken[:, ::2] = True
    for wrong in (np.nan, np.inf):
        uv_da[broken, 1] = wrong
        bias[broken] = 64.5  # so that a level between two is read even where the slopes say the least there is
        results = dr.texture_grad(tex, uv, np.ones(uv.shape[:3] + (3,)), uv_da, bias, boundary_mode=boundary)
        assert np.isfinite(results[1]).all() and results[1].any() and not results[2][broken].any()
        assert np.isfinite(results[3]).all() and np.isfinite(results[0]).all()


@pytest.mark.parametrize("boundary", ["cube", "wrap", "clamp", "zero"])
def test_coordinates_that_are_no_numbers_read_nothing(boundary):
    tex, uv, uv_da, bias = scene(5, cube=boundary == "cube", shared=True)
    to_values = np.ones(uv.shape[:3] + tex.shape[-1:], np.float32)
    whole = dr.texture_grad(tex, uv, to_values, uv_da, bias, boundary_mode=boundary)
    for wrong, broken in ((np.nan, uv[:, ::4, :, 0]), (-np.inf, uv[:, 1::4, :, -1]), (np.nan, bias[:, 2::4])):
        broken[:] = wrong
    nothing = ~(np.isfinite(uv).all(-1) & np.isfinite(bias))
    values = dr.texture(tex, uv, uv_da, bias, boundary_mode=boundary)
    assert not values[nothing].any() and values[~nothing].any() and np.isfinite(values).all()

    to_values[nothing] = np.nan
    results = dr.texture_grad(tex, uv, to_values, uv_da, bias, boundary_mode=boundary)
    to_values[nothing] = 0
    for result, same in zip(results[:4], dr.texture_grad(tex, uv, to_values, uv_da, bias, boundary_mode=boundary)):
        assert np.array_equal(result, same) and np.isfinite(result).all()
    assert not np.array_equal(results[0], whole[0])
    to_values[~nothing] = np.inf
    with pytest.raises(ValueError, match="^to_values: every number must be finite where something is drawn$"):
        dr.texture_grad(tex, uv, to_values, uv_da, bias, boundary_mode=boundary)


@pytest.mark.parametrize("wrong, line", [
    (dict(tex=np.zeros((2, 2, 3))), "tex: must have the shape (N, N, N, N), not (2, 2, 3)"),
    (dict(tex=np.zeros((3, 2, 2, 3))), "tex: must have 1 or 2 images, not 3"),
    (dict(tex=np.zeros((1, 0, 2, 3))), "tex: must have the shape (B, H, W, C), not (1, 0, 2, 3)"),
    (dict(tex=np.zeros((1, 6, 2, 3, 1)), uv=np.zeros((1, 1, 1, 3)), boundary_mode="cube"),
     "tex: must have the shape (B, 6, N, N, C), not (1, 6, 2, 3, 1)"),
    (dict(uv=np.zeros((2, 4, 4, 3))), "uv: must have the shape (N, N, N, 2), not (2, 4, 4, 3)"),
    (dict(filter_mode="cubic"), "filter_mode: 'cubic' is not one of nearest, linear"),
    (dict(boundary_mode="mirror"), "boundary_mode: 'mirror' is not one of cube, wrap"),
    (dict(filter_mode="linear-mipmap-linear"), "uv_da, mip_level_bias: one of them must be given"),
    (dict(tex=np.zeros((1, 6, 4, 3)), mip_level_bias=np.zeros((2, 4, 4))), "tex: sides that are halved must be even, not 3"),
    (dict(mip=[np.zeros((1, 3, 2, 3))], mip_level_bias=np.zeros((2, 4, 4))), "mip[0]: must have the shape (1, 2, 2, 3)"),
])
def test_mistakes_are_told(wrong, line):
    with pytest.raises((TypeError, ValueError)) as told:
        dr.texture(**{**dict(tex=np.zeros((1, 4, 4, 3)), uv=np.zeros((2, 4, 4, 2))), **wrong})
    assert str(told.value).startswith(line)
