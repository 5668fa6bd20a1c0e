# SPDX-License-Identifier: MIT
"""rhw.torch: the gradients of rhw.diff arrive where autograd puts them, by the names of nvdiffrast.torch."""

import numpy as np
import pytest

import rhw.diff as diff
from conftest import SANITIZED
from diff_reference import soup

if SANITIZED:
    pytest.skip("torch is not made for a sanitizer that is loaded before it", allow_module_level=True)
torch = pytest.importorskip("torch", reason="torch is not here: script/bootstrap learn")
dr = pytest.importorskip("rhw.torch")

SIZE = 24, 32


@pytest.fixture
def scene():
    pos, tri = soup(1)
    random = np.random.default_rng(1)
    uv, tex = random.uniform(0, 1, (1, pos.shape[1], 2)), random.normal(size=(1, 16, 16, 3))
    floats = [torch.tensor(a, dtype=torch.float32, requires_grad=True) for a in (pos, uv, tex)]
    return [*floats, torch.tensor(tri, dtype=torch.int32)]


def test_the_chain_is_that_of_the_arrays(scene):
    """The picture of a textured mesh, as programs for nvdiffrast make it, and the chain of rhw.diff by hand."""
    pos, uv, tex, tri = scene
    glctx = dr.RasterizeCudaContext()
    rast, rast_db = dr.rasterize(glctx, pos, tri, resolution=SIZE)
    at, at_da = dr.interpolate(uv, rast, tri, rast_db=rast_db, diff_attrs="all")
    color = dr.texture(tex, at, at_da, filter_mode="linear-mipmap-linear", max_mip_level=3)
    image = dr.antialias(color, rast, pos, tri, pos_gradient_boost=2.0)
    (image ** 2).sum().backward()

    a = [t.detach().numpy() for t in (pos, uv, tex, tri, rast, rast_db, at, at_da, color, image)]
    pos_, uv_, tex_, tri_, rast_, db_, at_, da_, color_, image_ = a
    assert np.array_equal(diff.antialias(color_, rast_, pos_, tri_), image_)
    to_color, to_pos = diff.antialias_grad(color_, rast_, pos_, tri_, 2 * image_)
    to_tex, to_at, to_da, _, _ = diff.texture_grad(tex_, at_, to_color, da_, max_mip_level=3)
    to_uv, to_rast, to_db = diff.interpolate_grad(uv_, rast_, tri_, to_at, db_, to_da, "all")
    to_pos = 2 * to_pos + diff.rasterize_grad(pos_, tri_, rast_, to_rast, to_db)
    for tensor, gradient in [(tex, to_tex), (uv, to_uv), (pos, to_pos)]:
        assert gradient.any() and np.allclose(tensor.grad.numpy(), gradient, rtol=1e-6, atol=1e-6)


def test_slopes_may_be_left_out_of_the_gradient(scene):
    pos, _, _, tri = scene
    glctx = dr.RasterizeGLContext(output_db=True, device="cpu")
    _, rast_db = dr.rasterize(glctx, pos, tri, SIZE, grad_db=False)
    rast_db.sum().backward()
    assert not pos.grad.any()
    dr.rasterize(glctx, pos, tri, SIZE)[1].sum().backward()
    assert pos.grad.any()


def test_levels_of_ones_own_get_gradients(scene):
    _, _, tex, _ = scene
    uv = torch.rand(1, 5, 6, 2)
    level = torch.full((1, 5, 6), 1.5, requires_grad=True)
    mip = [torch.rand(1, 16 >> k, 16 >> k, 3, requires_grad=True) for k in (1, 2, 3)]
    dr.texture(tex, uv, mip_level_bias=level, mip=mip, max_mip_level=2).sum().backward()
    assert mip[0].grad.sum().item() == pytest.approx(45) and mip[1].grad.sum().item() == pytest.approx(45)
    assert mip[2].grad is None and not tex.grad.any() and level.grad.any()

    tex.grad = None
    made = dr.texture_construct_mip(tex)
    assert torch.equal(dr.texture(tex, uv, mip_level_bias=level, mip=made), dr.texture(tex, uv, mip_level_bias=level))
    dr.texture(tex, uv, mip_level_bias=level, mip=made).sum().backward()
    assert tex.grad.sum().item() == pytest.approx(90, rel=1e-5)


def test_peeling(scene):
    pos, _, _, tri = scene
    glctx = dr.RasterizeContext(threads=2)
    with dr.DepthPeeler(glctx, pos, tri, SIZE) as peeler:
        first, _ = peeler.rasterize_next_layer()
        second, _ = peeler.rasterize_next_layer()
        with pytest.raises(RuntimeError, match="peels depth"):
            dr.rasterize(glctx, pos, tri, SIZE)
    assert torch.equal(first, dr.rasterize(glctx, pos, tri, SIZE)[0])
    assert (second[..., 2] > first[..., 2])[second[..., 3] > 0].all()
    second[..., 0].sum().backward()
    assert pos.grad.any()
    with pytest.raises(RuntimeError, match="belongs into"):
        peeler.rasterize_next_layer()


def test_mistakes_are_told(scene):
    pos, uv, _, tri = scene
    with pytest.raises(TypeError, match="^pos: must be a torch.Tensor, not list$"):
        dr.rasterize(dr.RasterizeContext(), [[0]], tri, SIZE)
    with pytest.raises(ValueError, match="^rast_db: must be given where diff_attrs is$"):
        dr.interpolate(uv, dr.rasterize(dr.RasterizeContext(), pos, tri, SIZE)[0], tri, diff_attrs="all")
    dr.set_log_level(0)
    assert dr.get_log_level() == 0


def one_triangle():
    pos = torch.tensor([[[-.8, -.8, .2, 1], [.8, -.8, .2, 1], [-.8, .8, .2, 1]]], requires_grad=True)
    return dr.RasterizeCudaContext(), pos, torch.tensor([[0, 1, 2]], dtype=torch.int32)


def test_what_is_not_finite_where_nothing_is_drawn_is_ignored():
    """As in nvdiffrast: a division by what is 0 there gives NaN on the way there, and on the way back."""
    glctx, pos, tri = one_triangle()
    tex = torch.rand(1, 8, 8, 3, requires_grad=True)

    def gradients(mask):
        pos.grad = tex.grad = None
        rast, _ = dr.rasterize(glctx, pos, tri, SIZE)
        at, _ = dr.interpolate(pos, rast, tri)
        seen = rast[..., 3:] > 0
        w = at[..., 3:] if mask is None else torch.where(seen, at[..., 3:], torch.ones(()))
        color = dr.texture(tex, at[..., :2] / w, filter_mode="linear") / w
        color = torch.where(seen, color, torch.zeros(()))
        if mask is None:
            color.register_hook(lambda gradient: torch.where(seen, gradient, gradient / 0))
        image = dr.antialias(color, rast.detach(), pos, tri)
        (image * torch.linspace(0, 1, SIZE[1])[:, None]).sum().backward()
        return pos.grad.clone(), tex.grad.clone()

    for wild, tame in zip(gradients(None), gradients("mask")):
        assert torch.isfinite(wild).all() and wild.any() and torch.allclose(wild, tame, rtol=1e-5, atol=1e-6)


def test_tensors_are_taken_for_numbers():
    glctx, pos, tri = one_triangle()
    size = torch.tensor(SIZE)
    rast, rast_db = dr.rasterize(glctx, pos, tri, size)
    assert torch.equal(rast, dr.rasterize(glctx, pos, tri, tuple(size))[0])
    assert torch.equal(rast, dr.rasterize(glctx, pos[0], tri, SIZE, ranges=torch.tensor([[0, 1]]))[0])
    slopes = dr.interpolate(pos, rast, tri, rast_db, [1, 2])[1]
    for some in (torch.tensor([1, 2]), [torch.tensor(1), torch.tensor(2)], np.array([1, 2])):
        assert torch.equal(dr.interpolate(pos, rast, tri, rast_db, some)[1], slopes)
    tex, uv = torch.rand(1, 8, 8, 3), torch.rand(1, 4, 4, 2)
    limited = dr.texture(tex, uv, uv_da=torch.ones(1, 4, 4, 4), max_mip_level=torch.tensor(1))
    assert torch.equal(limited, dr.texture(tex, uv, uv_da=torch.ones(1, 4, 4, 4), max_mip_level=1))


@pytest.mark.parametrize("told, call", [
    ("glctx: must be a RasterizeContext, not NoneType", lambda c, p, t: dr.rasterize(None, p, t, SIZE)),
    ("glctx: must be a RasterizeContext, not NoneType", lambda c, p, t: dr.DepthPeeler(None, p, t, SIZE)),
    ("ranges: must be a torch.Tensor, not list", lambda c, p, t: dr.rasterize(c, p[0], t, SIZE, ranges=[[0, 1]])),
    ("rast_db: must be a torch.Tensor, not list", lambda c, p, t: dr.interpolate(p, dr.rasterize(c, p, t, SIZE)[0], t, [1], [1])),
    ("uv_da: must be a torch.Tensor, not list", lambda c, p, t: dr.texture(p[None], p[None, ..., :2], uv_da=[1])),
    (r"mip\[0\]: must be a torch.Tensor, not int", lambda c, p, t: dr.texture(p[None], p[None, ..., :2], mip=[1])),
    ("resolution: must be a whole number, not True", lambda c, p, t: dr.rasterize(c, p, t, torch.tensor([True, True]))),
])
def test_what_is_no_tensor_is_told(told, call):
    with pytest.raises(TypeError, match=f"^{told}$"):
        call(*one_triangle())


def test_a_second_derivative_is_refused():
    glctx, pos, tri = one_triangle()
    scale = torch.ones((), requires_grad=True)

    def outputs():
        rast, _ = dr.rasterize(glctx, pos * scale, tri, SIZE)
        yield rast[..., 0]
        at, _ = dr.interpolate(pos * scale, rast, tri)
        yield at
        yield dr.texture(pos[None, ...] * scale, at[..., :2])
        yield dr.antialias(at.detach(), rast.detach(), pos * scale, tri)

    for output in outputs():
        # The gradient on the way back follows from the output, or is the same whatever that is.
        for whole in (output.square().sum(), output.sum()):
            (gradient,) = torch.autograd.grad(whole, pos, create_graph=True)
            with pytest.raises(RuntimeError, match="differentiate twice"):
                (gradient.square().sum() + whole).backward(retain_graph=True)
    (gradient,) = torch.autograd.grad(dr.rasterize(glctx, pos, tri, SIZE)[0][..., 0].sum(), pos, create_graph=True)
    gradient *= 2  # It is no view, which could not be changed.
    with pytest.raises(RuntimeError, match="differentiate twice"):
        torch.autograd.functional.hessian(lambda pos: dr.rasterize(glctx, pos, tri, SIZE)[0][..., 0].sum(), pos)
