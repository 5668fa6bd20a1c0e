# SPDX-License-Identifier: MIT
"""Rasterization with gradients, for those who learn from images: NumPy arrays in and out, every gradient by a function.

The operations, shapes and conventions are those of nvdiffrast; rhw.torch has them for autograd.

    >>> rast, rast_db = rhw.diff.rasterize(pos, tri, (256, 256))
    >>> color, _ = rhw.diff.interpolate(attributes, rast, tri)
    >>> image = rhw.diff.antialias(color, rast, pos, tri)
    >>> to_color, to_pos = rhw.diff.antialias_grad(color, rast, pos, tri, image - reference)
    >>> to_attributes, to_rast, _ = rhw.diff.interpolate_grad(attributes, rast, tri, to_color)
    >>> to_pos += rhw.diff.rasterize_grad(pos, tri, rast, to_rast)

B images of H rows and W columns are drawn at once. Positions are clip coordinates as in OpenGL: x, y and z from -w to w, y
upwards, and row 0 is the lowest. Arrays are float32, and indices are whole numbers. NaN and infinity are refused, but for
pixels that see no triangle: there a gradient that is not finite counts as 0. Coordinates of textures may be anything.
`pos` of the shape (B, V, 4) has the vertices of every image; (V, 4) is one set for all, and `ranges` (B, 2) then says which
triangles an image has, by the first and their number.

Nothing depends on how many threads work, gradients neither: where many pixels add to one vertex or texel, they do so one
after the other in the order of the picture, in double precision. `context` says how many threads there are, else all cores
work. The interpreter's lock is released meanwhile; Ctrl-C ends a call within a moment.
"""

from __future__ import annotations

from typing import Any, Callable, List, Optional, Sequence, Tuple

import numpy as np
from numpy.typing import NDArray

from . import _rhw, _threads
from ._arrays import MOST, any_floats, choice, empty, flag, floats, indices, listed, read, text, whole


def _size(resolution: Any) -> Tuple[int, int]:
    try:
        height, width = tuple(resolution)
    except (TypeError, ValueError):
        raise TypeError(f"resolution: must be (height, width), not {text(resolution)}") from None
    return whole(height, "resolution", 1, MOST), whole(width, "resolution", 1, MOST)


def _batched(value: Any, name: str, columns: Optional[int], images: Optional[int] = None) -> Tuple[NDArray[Any], bool]:
    """An array (B, N, columns), or (N, columns) with True; (1, N, columns) is shared where there are more images."""
    array = read(value, name)
    array = floats(array, name, (None, columns) if array.ndim == 2 else (None, None, columns))
    if array.shape[-2] < 1:
        raise ValueError(f"{name}: must have at least one vertex")
    if array.ndim == 2:
        return array, True
    if images is not None and array.shape[0] not in (1, images):
        raise ValueError(f"{name}: must have 1 or {images} images, not {array.shape[0]}")
    return array, images is not None and array.shape[0] == 1


def _rast(value: Any, name: str = "rast") -> NDArray[Any]:
    array = floats(value, name, (None, None, None, 4))
    if array.size == 0 or max(array.shape[1:3]) > MOST:
        raise ValueError(f"{name}: must have at least one pixel and at most {MOST} rows and columns, not {array.shape}")
    return array


def _like(value: Any, name: str, array: NDArray[Any]) -> NDArray[Any]:
    return floats(value, name, array.shape)


def _seen(rast: NDArray[Any]) -> Callable[[], NDArray[Any]]:
    return lambda: rast[..., 3:] >= 1


def _gradient(value: Any, name: str, shape: Sequence[int], used: Callable[[], NDArray[Any]],
              channels: Optional[int] = None) -> NDArray[Any]:
    """The gradient of what pixels have. Where it is not finite, and nothing depends on it, it counts as 0.

    used: which pixels anything depends on, (B, H, W, 1); channels: how many of theirs, None: all.
    """
    array = any_floats(value, name, shape)
    if _rhw.is_finite(array):
        return array
    wild = ~np.isfinite(array)
    if (wild[..., :channels] & used()).any():
        raise ValueError(f"{name}: every number must be finite where something is drawn")
    return np.where(wild, np.float32(0), array)


def _mesh(tri: NDArray[Any], vertices: int, shape: Sequence[int], context: Optional[_rhw.Context]) -> Tuple[Any, ...]:
    images, height, width = shape[:3]
    # A copy, which nobody changes once its numbers were checked.
    return tri.copy(), vertices, images, height, width, _threads.chosen(context).threads


def _ranges(ranges: Any, triangles: int) -> NDArray[Any]:
    array = indices(ranges, "ranges", (None, 2), triangles + 1)
    if len(array) == 0 or (array.sum(axis=1, dtype=np.int64) > triangles).any():
        raise ValueError(f"ranges: there must be one, and each end at or before {triangles}, the number of triangles")
    return array.copy()


# Rasterization ---------------------------------------------------------------------------------------------------------


def _rasterize(pos: Any, tri: Any, resolution: Any, ranges: Any, context: Optional[_rhw.Context],
               before: Optional[NDArray[Any]], depths: bool) -> Tuple[NDArray[Any], NDArray[Any], Optional[NDArray[Any]]]:
    size = _size(resolution)
    pos, shared = _batched(pos, "pos", 4)
    if shared and ranges is None:
        raise ValueError("ranges: must be given where pos has the shape (V, 4)")
    tri = indices(tri, "tri", (None, 3), pos.shape[-2])
    whole(len(tri), "tri: number of triangles", 0, 2**24)  # what a float counts to
    ranges = _ranges(ranges, len(tri)) if shared else None
    shape = (len(ranges) if shared else len(pos), *size)
    is_drawn = len(tri) > 0 and shape[0] > 0
    rast, rast_db = (empty(shape + (4,)) if is_drawn else np.zeros(shape + (4,), np.float32) for _ in range(2))
    found = np.ones(shape, np.float32) if depths else None
    if is_drawn:
        context = _threads.chosen(context)
        _rhw.diff_rasterize(context, _mesh(tri, pos.shape[-2], shape, context), pos, shared, ranges, rast, rast_db, before,
                            found)
    return rast, rast_db, found


def rasterize(pos: Any, tri: Any, resolution: Any, ranges: Any = None, *,
              context: Optional[_rhw.Context] = None) -> Tuple[NDArray[Any], NDArray[Any]]:
    """What every pixel sees.

    pos: (B, V, 4), or (V, 4) with `ranges`; tri: (T, 3); resolution: (H, W)

    Returns `rast` (B, H, W, 4) with u, v, z/w and the triangle's number + 1, all 0 where there is none; and `rast_db`
    (B, H, W, 4) with du/dX, du/dY, dv/dX, dv/dY per pixel. u, v and 1 - u - v are the weights of the triangle's vertices in
    space. Of triangles at equal depth the first is seen. Pixels and weights are those of the library, of positions rounded
    to 1/256 pixel (docs/exactness.md).
    """
    return _rasterize(pos, tri, resolution, ranges, context, None, False)[:2]


def rasterize_grad(pos: Any, tri: Any, rast: Any, to_rast: Any, to_rast_db: Any = None, *,
                   context: Optional[_rhw.Context] = None) -> NDArray[Any]:
    """The gradient of `pos` from those of `rast` and, where given, `rast_db`.

    As in nvdiffrast, z/w and the triangle's number have none, nor has z. Positions are taken as they are, not rounded.
    """
    rast = _rast(rast)
    pos, shared = _batched(pos, "pos", 4)
    if not shared and len(pos) != len(rast):
        raise ValueError(f"pos: must have {len(rast)} images, as rast has, not {len(pos)}")
    tri = indices(tri, "tri", (None, 3), pos.shape[-2])
    result: NDArray[Any] = empty(pos.shape)
    _rhw.diff_rasterize_grad(_mesh(tri, pos.shape[-2], rast.shape, context), pos, shared, rast,
                             _gradient(to_rast, "to_rast", rast.shape, _seen(rast), 2),
                             None if to_rast_db is None else _gradient(to_rast_db, "to_rast_db", rast.shape, _seen(rast)), result)
    return result


class DepthPeeler:
    """One layer after the other: what is seen, then what lies behind that, and so on.

        >>> with rhw.diff.DepthPeeler(pos, tri, (256, 256)) as peeler:
        ...     for _ in range(3):
        ...         rast, rast_db = peeler.rasterize_next_layer()

    The arguments are those of rasterize. What lies at the depth of the layer before is left out.
    """

    def __init__(self, pos: Any, tri: Any, resolution: Any, ranges: Any = None, *,
                 context: Optional[_rhw.Context] = None) -> None:
        self._arguments = pos, tri, resolution, ranges, context
        self._depths: Optional[NDArray[Any]] = None

    def __enter__(self) -> "DepthPeeler":
        return self

    def __exit__(self, *exception: Any) -> None:
        self._depths = None

    def rasterize_next_layer(self) -> Tuple[NDArray[Any], NDArray[Any]]:
        """As rasterize, of the next layer."""
        rast, rast_db, self._depths = _rasterize(*self._arguments, self._depths, True)
        return rast, rast_db


# Attributes ------------------------------------------------------------------------------------------------------------


# What _rhw.diff_interpolate takes, but for its results.
_Interpolation = Tuple[Tuple[Any, ...], NDArray[Any], int, bool, NDArray[Any], Optional[NDArray[Any]], NDArray[Any]]


def _interpolation(attr: Any, rast: Any, tri: Any, rast_db: Any, diff_attrs: Any,
                   context: Optional[_rhw.Context]) -> Tuple[NDArray[Any], bool, NDArray[Any], _Interpolation]:
    """What the calls of both directions begin with."""
    rast = _rast(rast)
    attr, shared = _batched(attr, "attr", None, len(rast))
    channels = whole(attr.shape[-1], "attr: number of attributes", 1, 1024)
    tri = indices(tri, "tri", (None, 3), attr.shape[-2])
    if diff_attrs is None:
        selected = np.zeros(0, np.uint32)
    elif isinstance(diff_attrs, str) and diff_attrs == "all":
        selected = np.arange(channels, dtype=np.uint32)
    else:
        places = listed(diff_attrs, "diff_attrs", "'all' or a list of numbers")
        selected = np.array([whole(a, "diff_attrs", 0, channels - 1) for a in places], np.uint32)
    if len(selected) > 1024:
        raise ValueError("diff_attrs: must be 1024 at most")
    if len(selected) and rast_db is None:
        raise ValueError("rast_db: must be given where diff_attrs is")
    rast_db = _like(rast_db, "rast_db", rast) if len(selected) else None
    mesh = _mesh(tri, attr.shape[-2], rast.shape, context)
    return attr, shared, rast, (mesh, attr, channels, shared, rast, rast_db, selected)


def interpolate(attr: Any, rast: Any, tri: Any, rast_db: Any = None, diff_attrs: Any = None, *,
                context: Optional[_rhw.Context] = None) -> Tuple[NDArray[Any], NDArray[Any]]:
    """Attributes of vertices at pixels, and their slopes.

    attr: (B, V, A), or (1, V, A) or (V, A) for all images; diff_attrs: those whose slopes are wanted, or "all"

    Returns (B, H, W, A), and (B, H, W, 2 D) with d/dX and d/dY per pixel of each of the D in `diff_attrs`.
    """
    _, _, rast, arguments = _interpolation(attr, rast, tri, rast_db, diff_attrs, context)
    values = empty(rast.shape[:3] + (arguments[2],))
    slopes = empty(rast.shape[:3] + (2 * len(arguments[6]),))
    _rhw.diff_interpolate(*arguments, values, slopes)
    return values, slopes


def interpolate_grad(attr: Any, rast: Any, tri: Any, to_values: Any, rast_db: Any = None, to_slopes: Any = None,
                     diff_attrs: Any = None, *, context: Optional[_rhw.Context] = None,
                     ) -> Tuple[NDArray[Any], NDArray[Any], Optional[NDArray[Any]]]:
    """The gradients of `attr`, `rast` and, with slopes, `rast_db`, from those of what interpolate gives."""
    attr, _, rast, arguments = _interpolation(attr, rast, tri, rast_db, diff_attrs, context)
    slopes = 2 * len(arguments[6])
    to_values = _gradient(to_values, "to_values", rast.shape[:3] + (arguments[2],), _seen(rast))
    if slopes:
        to_slopes = _gradient(to_slopes, "to_slopes", rast.shape[:3] + (slopes,), _seen(rast))
    else:
        to_slopes = np.empty(rast.shape[:3] + (0,), np.float32)
    to_attr, to_rast = empty(attr.shape), empty(rast.shape)
    to_rast_db = empty(rast.shape) if slopes else None
    _rhw.diff_interpolate_grad((*arguments, to_values, to_slopes), to_attr, to_rast, to_rast_db)
    return to_attr, to_rast, to_rast_db


# Textures --------------------------------------------------------------------------------------------------------------

_FILTERS = ("nearest", "linear", "linear-mipmap-nearest", "linear-mipmap-linear")
_BOUNDARIES = ("cube", "wrap", "clamp", "zero")


def _texels(value: Any, name: str, cube: bool) -> NDArray[Any]:
    array = floats(value, name, (None,) * (5 if cube else 4))
    sides = array.shape[-3:-1]
    if array.size == 0 or max(array.shape[-3:]) > MOST or (cube and (array.shape[1] != 6 or sides[0] != sides[1])):
        raise ValueError(f"{name}: must have the shape {'(B, 6, N, N, C)' if cube else '(B, H, W, C)'}, not {array.shape}")
    return array


def _every_other(texels: NDArray[Any], axis: int) -> List[NDArray[Any]]:
    """The texels with even and with odd numbers along an axis."""
    along = np.moveaxis(texels, axis, 0)
    return [np.moveaxis(along[k::2], 0, axis) for k in (0, 1)]


def _halved(texels: NDArray[Any]) -> NDArray[Any]:
    """The next level: means of 2 by 2 texels, or of two where the level is one texel high or wide."""
    for axis in (-3, -2):
        extent = texels.shape[axis]
        if extent > 1:
            if extent % 2:
                raise ValueError(f"tex: sides that are halved must be even, not {extent}; max_mip_level limits how often")
            even, odd = _every_other(texels, axis)
            mean, half = empty(even.shape), empty(even.shape)
            np.multiply(even, np.float32(0.5), out=mean)
            np.add(mean, np.multiply(odd, np.float32(0.5), out=half), out=mean)
            texels = mean
    return texels


def texture_construct_mip(tex: Any, max_mip_level: Optional[int] = None, cube_mode: bool = False) -> List[NDArray[Any]]:
    """The levels above `tex`, each the mean of the one before, down to one texel or `max_mip_level`."""
    levels = [_texels(tex, "tex", flag(cube_mode, "cube_mode"))]
    most = MOST if max_mip_level is None else whole(max_mip_level, "max_mip_level", 0, MOST)
    while len(levels) <= most and max(levels[-1].shape[-3:-1]) > 1:
        levels.append(_halved(levels[-1]))
    return levels[1:]


def _level_shape(tex: NDArray[Any], level: int) -> Tuple[int, ...]:
    return tex.shape[:-3] + tuple(max(side >> level, 1) for side in tex.shape[-3:-1]) + tex.shape[-1:]


def texture_construct_mip_grad(to_tex: Any, to_mip: Sequence[Any]) -> NDArray[Any]:
    """The gradient of the texture from its own and those of the levels that were made of it."""
    to_tex = read(to_tex, "to_tex")
    to_tex = floats(to_tex, "to_tex", (None,) * (5 if to_tex.ndim == 5 else 4))
    levels = [to_tex]
    for k, level in enumerate(listed(to_mip, "to_mip", "a list of arrays"), 1):
        levels.append(floats(level, f"to_mip[{k - 1}]", _level_shape(to_tex, k)))
    return _collected(levels)


def _collected(levels: List[NDArray[Any]]) -> NDArray[Any]:
    gradient = levels.pop()
    while levels:
        below = levels.pop()
        for axis in (-2, -3):
            if below.shape[axis] > 1:
                wider = empty(gradient.shape[:axis] + (2 * gradient.shape[axis],) + gradient.shape[axis:][1:])
                for part in _every_other(wider, axis):
                    np.multiply(gradient, np.float32(0.5), out=part)
                gradient = wider
        gradient = np.add(below, gradient, out=empty(below.shape))
    return gradient


# What _rhw.diff_texture takes, but for its result.
_Sampling = Tuple[Tuple[Any, ...], NDArray[Any], Optional[NDArray[Any]], Optional[NDArray[Any]]]


def _sampling(tex: Any, uv: Any, uv_da: Any, mip_level_bias: Any, mip: Any, filter_mode: str, boundary_mode: str,
              max_mip_level: Optional[int], context: Optional[_rhw.Context],
              ) -> Tuple[Tuple[NDArray[Any], ...], _Sampling, Tuple[int, ...]]:
    """Levels, the first arguments of the extension, and the shape of what is read."""
    filtering, boundary = choice(filter_mode, "filter_mode", (*_FILTERS, "auto")), choice(boundary_mode, "boundary_mode", _BOUNDARIES)
    if filtering == len(_FILTERS):
        filtering = 1 if uv_da is None and mip_level_bias is None else 3
    cube = boundary_mode == "cube"
    tex, uv = _texels(tex, "tex", cube), any_floats(uv, "uv", (None, None, None, 3 if cube else 2))
    if uv.size == 0 or uv.shape[1] * uv.shape[2] > 2**31:
        raise ValueError(f"uv: must have at least one pixel, not {uv.shape}")
    if tex.shape[0] not in (1, len(uv)):
        raise ValueError(f"tex: must have 1 or {len(uv)} images, not {tex.shape[0]}")
    if filtering >= 2 and uv_da is None and mip_level_bias is None:
        raise ValueError(f"uv_da, mip_level_bias: one of them must be given for {_FILTERS[filtering]}")
    if uv_da is not None:
        uv_da = any_floats(uv_da, "uv_da", uv.shape[:3] + (2 * uv.shape[3],))
    if mip_level_bias is not None:
        mip_level_bias = any_floats(mip_level_bias, "mip_level_bias", uv.shape[:3])
    levels = [tex]
    if filtering >= 2:
        most = None if max_mip_level is None else whole(max_mip_level, "max_mip_level", 0, MOST)
        if mip is None:
            levels += texture_construct_mip(tex, most, cube)
        else:
            for k, level in enumerate(listed(mip, "mip", "a list of arrays")[:most], 1):
                levels.append(floats(level, f"mip[{k - 1}]", _level_shape(tex, k)))
    threads = _threads.chosen(context).threads
    description = (tuple(levels), len(tex), *tex.shape[-3:], filtering, boundary, len(uv), uv.shape[1] * uv.shape[2], threads)
    return tuple(levels), (description, uv, uv_da, mip_level_bias), uv.shape[:3] + tex.shape[-1:]


def texture(tex: Any, uv: Any, uv_da: Any = None, mip_level_bias: Any = None, mip: Optional[Sequence[Any]] = None,
            filter_mode: str = "auto", boundary_mode: str = "wrap", max_mip_level: Optional[int] = None, *,
            context: Optional[_rhw.Context] = None) -> NDArray[Any]:
    """A texture at coordinates.

    tex: (B or 1, H, W, C), of a cube (B or 1, 6, N, N, C) with the faces +x, -x, +y, -y, +z, -z
    uv: (B, h, w, 2), 0 to 1 across the texture, row 0 at v = 0; of a cube directions (B, h, w, 3) of any length
    uv_da: their slopes as interpolate gives them, which choose levels; mip_level_bias: (B, h, w), added to the level
    mip: levels above `tex`; None: means of it, made anew
    filter_mode: 'nearest', 'linear', 'linear-mipmap-nearest', 'linear-mipmap-linear'; 'auto': the last, or 'linear' where
        nothing chooses levels
    boundary_mode: 'wrap', 'clamp', 'zero' or 'cube'

    Returns (B, h, w, C). Where `uv` or `mip_level_bias` is not finite, and where a direction has the length 0, it is 0 and
    has no gradient. Slopes that are NaN choose level 0, infinite ones the last level.
    """
    _, arguments, shape = _sampling(tex, uv, uv_da, mip_level_bias, mip, filter_mode, boundary_mode, max_mip_level, context)
    values = empty(shape)
    _rhw.diff_texture(*arguments, values)
    return values


def texture_grad(tex: Any, uv: Any, to_values: Any, uv_da: Any = None, mip_level_bias: Any = None,
                 mip: Optional[Sequence[Any]] = None, filter_mode: str = "auto", boundary_mode: str = "wrap",
                 max_mip_level: Optional[int] = None, *, context: Optional[_rhw.Context] = None,
                 ) -> Tuple[NDArray[Any], NDArray[Any], Optional[NDArray[Any]], Optional[NDArray[Any]], List[NDArray[Any]]]:
    """The gradients of `tex`, `uv`, `uv_da`, `mip_level_bias` and `mip` from that of what texture gives.

    Where `mip` is None, what its levels would have got is in that of `tex`. Choices of a nearest texel or level have none.
    """
    levels, arguments, shape = _sampling(tex, uv, uv_da, mip_level_bias, mip, filter_mode, boundary_mode, max_mip_level,
                                         context)
    to_levels = tuple(empty(level.shape) for level in levels)
    to_uv = empty(arguments[1].shape)
    to_uv_da, to_bias = (None if array is None else empty(array.shape) for array in arguments[2:])
    _, uv, _, bias = arguments

    def used() -> NDArray[Any]:
        finite: NDArray[Any] = np.isfinite(uv).all(axis=-1, keepdims=True)
        if bias is not None:
            finite &= np.isfinite(bias)[..., None]
        return finite

    _rhw.diff_texture_grad((*arguments, _gradient(to_values, "to_values", shape, used)), to_levels, to_uv, to_uv_da, to_bias)
    to_tex, to_mip = to_levels[0], list(to_levels[1:])
    if mip is None:
        to_tex, to_mip = _collected(list(to_levels)), []
    return to_tex, to_uv, to_uv_da, to_bias, to_mip


# Silhouettes -----------------------------------------------------------------------------------------------------------


def _order_of_pairs(first: NDArray[Any], second: NDArray[Any]) -> NDArray[Any]:
    """Places of pairs of uint32 from the least on, those of equal ones in their order.

    NumPy sorts 16 bits by counting, and looks for no signal while it sorts: of the pairs at once that took seconds.
    """
    order = np.arange(len(first))
    for column in (second, first):
        for shift in range(0, int(column.max(initial=0)).bit_length(), 16):
            digit = (column >> np.uint32(shift)).astype(np.uint16)
            order = order[digit[order].argsort(kind="stable")]
    return order


def antialias_construct_topology_hash(tri: Any) -> NDArray[Any]:
    """Which vertex lies beyond each edge: (T, 3) uint32, of the edge across from each corner; 2^32 - 1 where none does.

    Where more than two triangles share an edge, each has the next one's vertex.
    """
    tri = indices(tri, "tri", (None, 3), 2**31)
    after, before = tri[:, [1, 2, 0]].reshape(-1), tri[:, [2, 0, 1]].reshape(-1)
    low, high = np.minimum(after, before), np.maximum(after, before)
    order = _order_of_pairs(low, high)
    first = np.ones(len(order), bool)
    for ends in (low[order], high[order]):
        first[1:] &= ends[1:] == ends[:-1]
    first[1:] = ~first[1:]
    group = np.cumsum(first) - 1
    starts = np.flatnonzero(first)
    last = np.append(first[1:], True)[:len(order)]
    following = np.where(last, starts[group], np.arange(len(order)) + 1)
    beyond = tri.reshape(-1)[order[following]]
    beyond[first & last] = 2**32 - 1
    result = np.empty(tri.size, np.uint32)
    result[order] = beyond
    return result.reshape(tri.shape)


# What _rhw.diff_antialias takes, but for its result.
_Silhouettes = Tuple[Tuple[Any, ...], NDArray[Any], int, NDArray[Any], NDArray[Any], bool, NDArray[Any]]


def _silhouettes(color: Any, rast: Any, pos: Any, tri: Any, topology_hash: Any,
                 context: Optional[_rhw.Context]) -> _Silhouettes:
    rast = _rast(rast)
    color = floats(color, "color", rast.shape[:3] + (None,))
    whole(color.shape[-1], "color: number of channels", 1, MOST)
    pos, shared = _batched(pos, "pos", 4)
    if not shared and len(pos) != len(rast):
        raise ValueError(f"pos: must have {len(rast)} images, as rast has, not {len(pos)}")
    tri = indices(tri, "tri", (None, 3), pos.shape[-2])
    if topology_hash is None:
        topology_hash = antialias_construct_topology_hash(tri)
    opposite = indices(topology_hash, "topology_hash", tri.shape, 2**32)
    return _mesh(tri, pos.shape[-2], rast.shape, context), color, color.shape[-1], rast, pos, shared, opposite


def antialias(color: Any, rast: Any, pos: Any, tri: Any, topology_hash: Any = None, *,
              context: Optional[_rhw.Context] = None) -> NDArray[Any]:
    """A picture whose silhouettes lie where the triangles end, and not at the next pixel: they move with `pos`.

    color: (B, H, W, C); rast, pos, tri: of rasterize; topology_hash: of antialias_construct_topology_hash

    Triangles that meet at an edge must name the same vertices, or the edge counts as a silhouette. Triangles with a vertex
    behind the eye are left as they are.
    """
    arguments = _silhouettes(color, rast, pos, tri, topology_hash, context)
    result = empty(arguments[1].shape)
    _rhw.diff_antialias(*arguments, result)
    return result


def antialias_grad(color: Any, rast: Any, pos: Any, tri: Any, to_result: Any, topology_hash: Any = None, *,
                   context: Optional[_rhw.Context] = None) -> Tuple[NDArray[Any], NDArray[Any]]:
    """The gradients of `color` and `pos` from that of what antialias gives; that of z is 0."""
    arguments = _silhouettes(color, rast, pos, tri, topology_hash, context)
    to_color, to_pos = empty(arguments[1].shape), empty(arguments[4].shape)
    _rhw.diff_antialias_grad((*arguments, _gradient(to_result, "to_result", to_color.shape, _seen(arguments[3]))), to_color, to_pos)
    return to_color, to_pos
