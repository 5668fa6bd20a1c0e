# SPDX-License-Identifier: MIT
"""What passes and programs read and write: buffers, textures and samplers."""

from __future__ import annotations

from typing import Any, Dict, Optional, Tuple

import numpy as np
from numpy.typing import NDArray

from . import _arrays, _rhw, _threads
from ._arrays import Size

#: Texel formats: channels and NumPy's type of each.
FORMATS: Dict[str, Tuple[int, Any]] = {
    "r8_unorm": (1, np.uint8), "rg8_unorm": (2, np.uint8), "rgba8_unorm": (4, np.uint8), "rgba8_srgb": (4, np.uint8),
    "r16_unorm": (1, np.uint16), "rgba16_unorm": (4, np.uint16), "r16_float": (1, np.float16),
    "rgba16_float": (4, np.float16), "r32_float": (1, np.float32), "rg32_float": (2, np.float32),
    "rgba32_float": (4, np.float32), "r32_uint": (1, np.uint32), "d32_float": (1, np.float32)}

_FILTERS = ("linear", "nearest")
_ADDRESSES = ("repeat", "mirror", "clamp", "border")


def _type_of(dtype: Any) -> np.dtype[Any]:
    try:
        return np.dtype(dtype).newbyteorder("=")
    except Exception as error:
        raise TypeError(f"dtype: must be a type of numbers: {_arrays.line(str(error))}") from error


class Buffer:
    """An array that passes read: positions, colours, faces.

    data: an array, which is copied; or a shape, for zeros of `dtype`.
    array: the memory that is drawn from, of the same shape; write to it between passes.
    """

    def __init__(self, data: Any, dtype: Any = None, *, context: Optional[_rhw.Context] = None):
        is_shape = _arrays.is_whole(data) or (isinstance(data, tuple) and all(map(_arrays.is_whole, data)))
        source = np.zeros(0) if is_shape else _arrays.read(data, "data")
        kind = _type_of(dtype) if dtype is not None else np.dtype(np.float32) if is_shape else source.dtype.newbyteorder("=")
        shape = (data if isinstance(data, tuple) else (int(data),)) if is_shape else source.shape
        if kind.kind not in "fiu" or (not is_shape and source.dtype.kind not in "fiu"):
            raise TypeError(f"data: must be of numbers, not {kind if is_shape else source.dtype}")
        count = 1
        for extent in shape:
            if extent < 0:
                raise ValueError(f"data: no extent may be negative, not {shape}")
            count *= int(extent)
        if count == 0:
            raise ValueError(f"data: must have elements, not the shape {tuple(shape)}")
        if count > 2**56:
            raise ValueError(f"data: there is no memory for the shape {_arrays.text(tuple(shape))}")
        source = source if is_shape else _arrays.converted(source, "data", kind)
        self._context = _threads.chosen(context)
        self._resource = _rhw.buffer(self._context, count * kind.itemsize)
        memory = np.asarray(self._resource.memory)
        self.array: NDArray[Any] = memory[:count * kind.itemsize].view(kind).reshape(shape)
        if not is_shape:
            np.copyto(self.array, source)

    def __len__(self) -> int:
        return len(self.array)

    def __repr__(self) -> str:
        return f"rhw.pipeline.Buffer({self.array.shape}, {self.array.dtype})"


class Texture:
    """Texels that passes draw into or sample.

    size: (width, height), or one number for both.
    format: one of FORMATS; d32_float is that of depth tests.
    mips: with levels for sampling, see generate_mips.
    array: the texels of the first level, (H, W) or (H, W, channels), rows from top to bottom. Rows stand 64 bytes
    apart or a multiple of that; numpy.ascontiguousarray packs them.
    """

    def __init__(self, size: Size, format: str = "rgba8_srgb", *, mips: bool = False,
                 context: Optional[_rhw.Context] = None):
        self.size = _arrays.size(size)
        _arrays.choice(format, "format", tuple(FORMATS))
        self.format = format
        levels = _arrays.flag(mips, "mips")
        self._context = _threads.chosen(context)
        width, height = self.size
        self._resource, pitch = _rhw.texture(self._context, _rhw.formats[format], width, height, levels)
        channels, kind = FORMATS[format]
        item = np.dtype(kind).itemsize
        shape: Tuple[int, ...] = (height, width) if channels == 1 else (height, width, channels)
        strides = (pitch, channels * item, item)[:len(shape)]
        self.array: NDArray[Any] = NDArray[Any](shape, kind, np.asarray(self._resource.memory), 0, strides)

    @classmethod
    def of(cls, image: Any, *, srgb: bool = True, context: Optional[_rhw.Context] = None) -> "Texture":
        """A texture of an image, (H, W), (H, W, 3) or (H, W, 4) uint8, with its levels. srgb: colours, not numbers."""
        texels = _arrays.texels(image, "image")
        texture = cls((texels.shape[1], texels.shape[0]), "rgba8_srgb" if _arrays.flag(srgb, "srgb") else "rgba8_unorm", mips=True,
                      context=context)
        texture.array[...] = texels
        texture.generate_mips()
        return texture

    def generate_mips(self) -> None:
        """Makes the smaller levels of what is in the first, after it was written. Formats that filters read."""
        _rhw.generate_mips(self._resource)

    def __repr__(self) -> str:
        return f"rhw.pipeline.Texture({self.size}, {self.format!r})"


class Sampler:
    """How textures are read.

    filter: 'linear' or 'nearest'. address: 'repeat', 'mirror', 'clamp' or 'border', which is 0, 0, 0, 0.
    anisotropy: 1 to 16 samples.
    """

    def __init__(self, filter: str = "linear", address: str = "repeat", anisotropy: float = 1.0, *,
                 context: Optional[_rhw.Context] = None):
        samples = _arrays.number(anisotropy, "anisotropy", 1, 16)
        self._context = _threads.chosen(context)
        self._resource = _rhw.sampler(self._context, _arrays.choice(filter, "filter", _FILTERS),
                                      _arrays.choice(address, "address", _ADDRESSES), samples)
