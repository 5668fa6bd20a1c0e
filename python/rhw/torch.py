# SPDX-License-Identifier: MIT
"""rhw.diff for PyTorch's autograd, with the names and arguments of nvdiffrast.torch.

    import rhw.torch as dr          # in place of: import nvdiffrast.torch as dr

A program written for that runs on the CPU, once its tensors are made there: torch without CUDA knows no 'cuda'. Tensors on
another device are copied here and results back. What the operations do, and what shapes they have, is in help(rhw.diff);
gradients are theirs, to the last bit the same for any number of threads. Gradients have no gradients of their own: to ask
for a second derivative is an error.
"""

# torch's Function says nothing of its subclasses' arguments and results.
# mypy: disable-error-code="override, no-any-return, misc, no-untyped-call"
from __future__ import annotations

import functools
from typing import Any, Callable, List, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import NDArray
import torch
from torch.autograd import Function

from . import _arrays, _rhw, diff

__all__ = ["DepthPeeler", "RasterizeContext", "RasterizeCudaContext", "RasterizeGLContext", "antialias",
           "antialias_construct_topology_hash", "get_log_level", "interpolate", "rasterize", "set_log_level", "texture",
           "texture_construct_mip"]

_log_level = 1


def get_log_level() -> int:
    """What set_log_level set last; 1 before."""
    return _log_level


def set_log_level(level: int) -> None:
    """Kept for programs that call it: there is nothing to log here. What goes wrong is raised."""
    global _log_level
    _log_level = int(level)


class RasterizeContext:
    """Threads that rasterize. Contexts of OpenGL and CUDA are other names of it, whose arguments have no meaning here.

    threads: 1 to 64; 0: as many as the process has cores
    """

    def __init__(self, output_db: bool = True, mode: str = "automatic", device: Any = None, *, threads: int = 0) -> None:
        self.context = _rhw.Context(threads=threads)
        self.active_depth_peeler: Optional[DepthPeeler] = None

    def set_context(self) -> None:
        """Nothing: a context of OpenGL would be made current."""

    def release_context(self) -> None:
        """Nothing, likewise."""


class RasterizeCudaContext(RasterizeContext):
    """RasterizeContext."""

    def __init__(self, device: Any = None, *, threads: int = 0) -> None:
        super().__init__(device=device, threads=threads)


class RasterizeGLContext(RasterizeContext):
    """RasterizeContext."""


def _array(tensor: Optional[torch.Tensor]) -> Optional[NDArray[Any]]:
    return None if tensor is None else tensor.detach().cpu().numpy()


def _tensor(array: Optional[NDArray[Any]], like: torch.Tensor) -> Optional[torch.Tensor]:
    return None if array is None else torch.from_numpy(array).to(like.device)


def _check(**tensors: Any) -> None:
    for name, tensor in tensors.items():
        if not isinstance(tensor, torch.Tensor):
            raise TypeError(f"{name}: must be a torch.Tensor, not {type(tensor).__name__}")


def _check_optional(**tensors: Any) -> None:
    _check(**{name: tensor for name, tensor in tensors.items() if tensor is not None})


def _check_context(glctx: Any) -> None:
    if not isinstance(glctx, RasterizeContext):
        raise TypeError(f"glctx: must be a RasterizeContext, not {type(glctx).__name__}")


def _plain(value: Any) -> Any:
    """A tensor as the array, else what it is."""
    return _array(value) if isinstance(value, torch.Tensor) else value


# Second derivatives ----------------------------------------------------------------------------------------------------


class _Gradient(Function):
    """A gradient that has none of its own. In the graph it leads to what it depends on."""

    @staticmethod
    def forward(ctx: Any, gradient: torch.Tensor, *causes: torch.Tensor) -> torch.Tensor:
        return gradient.clone()

    @staticmethod
    def backward(ctx: Any, *gradients: torch.Tensor) -> Any:
        raise RuntimeError("rhw.torch: tried to differentiate twice; its gradients have no gradients")


def _differentiated_once(backward: Callable[..., Any]) -> Callable[..., Any]:
    """Gives a backward function the saved tensors, and refuses its second derivative. torch's once_differentiable says nothing of
    one that is lost where the gradient on the way back is a constant, as that of a sum."""
    @functools.wraps(backward)
    def refusing(ctx: Any, *gradients: Any) -> Any:
        saved = ctx.saved_tensors
        with torch.no_grad():
            results = backward(ctx, saved, *gradients)
        if not torch.is_grad_enabled():
            return results
        causes = [tensor for tensor in (*saved, *gradients) if tensor is not None and tensor.requires_grad]
        return tuple(None if result is None else _Gradient.apply(result, *causes) for result in results)

    return refusing


# Rasterization ---------------------------------------------------------------------------------------------------------


class _Rasterize(Function):
    @staticmethod
    def forward(ctx: Any, draw: Callable[[], Tuple[NDArray[Any], NDArray[Any]]], context: _rhw.Context, pos: torch.Tensor,
                tri: torch.Tensor, grad_db: bool) -> Tuple[Any, ...]:
        rast, rast_db = (_tensor(array, pos) for array in draw())
        ctx.save_for_backward(pos, tri, rast)
        ctx.context, ctx.grad_db = context, grad_db
        return rast, rast_db

    @staticmethod
    @_differentiated_once
    def backward(ctx: Any, saved: Tuple[Any, ...], to_rast: torch.Tensor, to_rast_db: torch.Tensor) -> Tuple[Any, ...]:
        pos, tri, rast = saved
        gradient = diff.rasterize_grad(_array(pos), _array(tri), _array(rast), _array(to_rast),
                                       _array(to_rast_db) if ctx.grad_db else None, context=ctx.context)
        return None, None, _tensor(gradient, pos), None, None


def rasterize(glctx: RasterizeContext, pos: torch.Tensor, tri: torch.Tensor, resolution: Union[Sequence[int], torch.Tensor],
              ranges: Optional[torch.Tensor] = None, grad_db: bool = True) -> Tuple[torch.Tensor, torch.Tensor]:
    """rhw.diff.rasterize; without `grad_db` the slopes give no gradient to `pos`."""
    _check_context(glctx)
    _check(pos=pos, tri=tri)
    _check_optional(ranges=ranges)
    if glctx.active_depth_peeler is not None:
        raise RuntimeError("rasterize: the context peels depth; call rasterize_next_layer, or leave the DepthPeeler first")

    def draw() -> Tuple[NDArray[Any], NDArray[Any]]:
        return diff.rasterize(_array(pos), _array(tri), resolution, _array(ranges), context=glctx.context)

    return _Rasterize.apply(draw, glctx.context, pos, tri, grad_db)


class DepthPeeler:
    """rhw.diff.DepthPeeler, with the arguments of rasterize. A context has one at a time."""

    def __init__(self, glctx: RasterizeContext, pos: torch.Tensor, tri: torch.Tensor,
                 resolution: Union[Sequence[int], torch.Tensor], ranges: Optional[torch.Tensor] = None, grad_db: bool = True) -> None:
        _check_context(glctx)
        _check(pos=pos, tri=tri)
        _check_optional(ranges=ranges)
        self._glctx, self._pos, self._tri, self._grad_db = glctx, pos, tri, grad_db
        self._peeler = diff.DepthPeeler(_array(pos), _array(tri), resolution, _array(ranges), context=glctx.context)

    def __enter__(self) -> "DepthPeeler":
        if self._glctx.active_depth_peeler is not None:
            raise RuntimeError("DepthPeeler: the context has one already")
        self._glctx.active_depth_peeler = self
        return self

    def __exit__(self, *exception: Any) -> None:
        self._glctx.active_depth_peeler = None
        self._peeler.__exit__(*exception)

    def rasterize_next_layer(self) -> Tuple[torch.Tensor, torch.Tensor]:
        """As rasterize, of the next layer."""
        if self._glctx.active_depth_peeler is not self:
            raise RuntimeError("rasterize_next_layer: belongs into `with DepthPeeler(...)`")
        return _Rasterize.apply(self._peeler.rasterize_next_layer, self._glctx.context, self._pos, self._tri, self._grad_db)


# Attributes ------------------------------------------------------------------------------------------------------------


class _Interpolate(Function):
    @staticmethod
    def forward(ctx: Any, attr: torch.Tensor, rast: torch.Tensor, tri: torch.Tensor, rast_db: Optional[torch.Tensor],
                diff_attrs: Any) -> Tuple[Any, ...]:
        ctx.save_for_backward(attr, rast, tri, rast_db)
        ctx.diff_attrs = diff_attrs
        values, slopes = diff.interpolate(_array(attr), _array(rast), _array(tri), _array(rast_db), diff_attrs)
        return _tensor(values, attr), _tensor(slopes, attr)

    @staticmethod
    @_differentiated_once
    def backward(ctx: Any, saved: Tuple[Any, ...], to_values: torch.Tensor, to_slopes: torch.Tensor) -> Tuple[Any, ...]:
        attr, rast, tri, rast_db = saved
        to_attr, to_rast, to_rast_db = diff.interpolate_grad(_array(attr), _array(rast), _array(tri), _array(to_values),
                                                             _array(rast_db), _array(to_slopes), ctx.diff_attrs)
        return _tensor(to_attr, attr), _tensor(to_rast, attr), None, _tensor(to_rast_db, attr), None


def interpolate(attr: torch.Tensor, rast: torch.Tensor, tri: torch.Tensor, rast_db: Optional[torch.Tensor] = None,
                diff_attrs: Union[None, str, Sequence[int], torch.Tensor] = None) -> Tuple[torch.Tensor, torch.Tensor]:
    """rhw.diff.interpolate."""
    _check(attr=attr, rast=rast, tri=tri)
    _check_optional(rast_db=rast_db)
    return _Interpolate.apply(attr, rast, tri, rast_db, _plain(diff_attrs))


# Textures --------------------------------------------------------------------------------------------------------------


class _Texture(Function):
    @staticmethod
    def forward(ctx: Any, options: Any, made: Optional[List[NDArray[Any]]], tex: torch.Tensor, uv: torch.Tensor,
                uv_da: Optional[torch.Tensor], bias: Optional[torch.Tensor], *mip: torch.Tensor) -> Any:
        ctx.save_for_backward(tex, uv, uv_da, bias, *mip)
        ctx.options, ctx.made = options, made
        levels = [_array(level) for level in mip] if mip else made
        return _tensor(diff.texture(_array(tex), _array(uv), _array(uv_da), _array(bias), levels, *options), tex)

    @staticmethod
    @_differentiated_once
    def backward(ctx: Any, saved: Tuple[Any, ...], to_values: torch.Tensor) -> Tuple[Any, ...]:
        tex, uv, uv_da, bias, *mip = saved
        levels = [_array(level) for level in mip] if mip else ctx.made
        to_tex, to_uv, to_uv_da, to_bias, to_mip = diff.texture_grad(_array(tex), _array(uv), _array(to_values), _array(uv_da),
                                                                     _array(bias), levels, *ctx.options)
        if not mip:
            to_tex, to_mip = diff.texture_construct_mip_grad(to_tex, to_mip), []
        unread = [None] * (len(mip) - len(to_mip))  # beyond max_mip_level
        return (None, None, *(_tensor(array, tex) for array in (to_tex, to_uv, to_uv_da, to_bias, *to_mip)), *unread)


class _Mip:
    """Levels of a texture that stays as it is."""

    def __init__(self, levels: List[NDArray[Any]]) -> None:
        self.levels = levels


def texture_construct_mip(tex: torch.Tensor, max_mip_level: Optional[int] = None, cube_mode: bool = False) -> _Mip:
    """What the argument `mip` of texture takes, for a texture that stays as it is."""
    _check(tex=tex)
    return _Mip(diff.texture_construct_mip(_array(tex), max_mip_level, cube_mode))


def texture(tex: torch.Tensor, uv: torch.Tensor, uv_da: Optional[torch.Tensor] = None,
            mip_level_bias: Optional[torch.Tensor] = None, mip: Union[None, _Mip, Sequence[torch.Tensor]] = None,
            filter_mode: str = "auto", boundary_mode: str = "wrap", max_mip_level: Optional[int] = None) -> torch.Tensor:
    """rhw.diff.texture; `mip` is what texture_construct_mip gave, or a list of tensors, which get gradients of their own."""
    _check(tex=tex, uv=uv)
    made = mip.levels if isinstance(mip, _Mip) else None
    stack = [] if mip is None or made is not None else _arrays.listed(mip, "mip", "of texture_construct_mip, or a list of tensors")
    _check_optional(uv_da=uv_da, mip_level_bias=mip_level_bias)
    _check(**{f"mip[{k}]": level for k, level in enumerate(stack)})
    return _Texture.apply((filter_mode, boundary_mode, max_mip_level), made, tex, uv, uv_da, mip_level_bias, *stack)


# Silhouettes -----------------------------------------------------------------------------------------------------------


class _Antialias(Function):
    @staticmethod
    def forward(ctx: Any, color: torch.Tensor, rast: torch.Tensor, pos: torch.Tensor, tri: torch.Tensor,
                topology_hash: NDArray[Any], boost: float) -> Any:
        ctx.save_for_backward(color, rast, pos, tri)
        ctx.topology_hash, ctx.boost = topology_hash, boost
        return _tensor(diff.antialias(_array(color), _array(rast), _array(pos), _array(tri), topology_hash), color)

    @staticmethod
    @_differentiated_once
    def backward(ctx: Any, saved: Tuple[Any, ...], to_result: torch.Tensor) -> Tuple[Any, ...]:
        color, rast, pos, tri = map(_array, saved)
        to_color, to_pos = diff.antialias_grad(color, rast, pos, tri, _array(to_result), ctx.topology_hash)
        return _tensor(to_color, to_result), None, _tensor(to_pos, to_result) * ctx.boost, None, None, None


def antialias_construct_topology_hash(tri: torch.Tensor) -> NDArray[Any]:
    """rhw.diff.antialias_construct_topology_hash: what the argument `topology_hash` of antialias takes."""
    _check(tri=tri)
    return diff.antialias_construct_topology_hash(_array(tri))


def antialias(color: torch.Tensor, rast: torch.Tensor, pos: torch.Tensor, tri: torch.Tensor,
              topology_hash: Union[None, NDArray[Any], torch.Tensor] = None, pos_gradient_boost: float = 1.0) -> torch.Tensor:
    """rhw.diff.antialias; gradients of `pos` are multiplied by `pos_gradient_boost`."""
    _check(color=color, rast=rast, pos=pos, tri=tri)
    if topology_hash is None:
        topology_hash = antialias_construct_topology_hash(tri)
    return _Antialias.apply(color, rast, pos, tri, _plain(topology_hash), pos_gradient_boost)
