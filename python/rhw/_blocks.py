# SPDX-License-Identifier: MIT
"""Numbers and arrays in the memory of a block, where the shader's layout has them (std140 and std430 of GLSL)."""

from __future__ import annotations

from typing import Any, Iterator, List, Mapping, NamedTuple, Optional, Tuple

import numpy as np
from numpy.typing import NDArray

from . import _arrays

_FLOAT, _INT, _UINT, _ARRAY, _STRUCT = range(5)  # rhw_shader_type_kind of the extension


class Type(NamedTuple):
    """A type of a block as the extension tells it; rhw/spirv.h has the meaning of each number."""
    kind: int
    bits: int
    rows: int
    columns: int
    is_row_major: bool
    stride: int
    length: int
    size: int
    element: Any
    members: Tuple[Tuple[str, int, Any], ...]
    name: str

    @property
    def is_struct(self) -> bool:
        return self.kind == _STRUCT


def members(kind: Type) -> Iterator[Tuple[str, int, Type]]:
    for name, offset, told in kind.members:
        yield name, offset, Type(*told)


def _number_type(kind: Type) -> np.dtype[Any]:
    return np.dtype(f"{'fiu'[kind.kind]}{kind.bits // 8}")


def _leaf(kind: Type) -> Tuple[Type, List[int], List[int]]:
    """What arrays have at last, their extents, and the bytes from element to element of each."""
    extents: List[int] = []
    strides: List[int] = []
    while kind.kind == _ARRAY:
        extents.append(kind.length)
        strides.append(kind.stride)
        kind = Type(*kind.element)
    return kind, extents, strides


def _numbers(value: Any, name: str, shape: Tuple[int, ...], dtype: np.dtype[Any]) -> NDArray[Any]:
    array = _arrays.read(value, name)
    if array.dtype.kind == "b" and dtype.kind != "f":
        array = array.astype(np.uint8)
    if array.dtype.kind not in "fiu":
        raise TypeError(f"{name}: must be of numbers, not {array.dtype}")
    if array.shape != shape:
        wanted = f"have the shape {shape}" if shape else "be one number"
        raise ValueError(f"{name}: must {wanted}, not {array.shape or _arrays.text(value)}")
    array = _arrays.converted(array, name, dtype)
    if dtype.kind == "f" and not np.isfinite(array).all():
        raise ValueError(f"{name}: every number must be finite, as {dtype} too")
    return array


def write(kind: Type, value: Any, name: str, memory: NDArray[Any], offset: int) -> None:
    """Puts a value where a type stands in bytes. Structs are dictionaries; matrices are (rows, columns)."""
    leaf, extents, strides = _leaf(kind)
    if kind.is_struct:
        _write_struct(kind, value, name, memory, offset)
    elif leaf.is_struct:
        parts = _arrays.listed(value, name, f"a list of {kind.length}")
        if len(parts) != kind.length:
            raise ValueError(f"{name}: must have {kind.length} elements, not {len(parts)}")
        for i, part in enumerate(parts):
            write(Type(*kind.element), part, f"{name}[{i}]", memory, offset + i * kind.stride)
    else:
        dtype = _number_type(leaf)
        if leaf.columns > 1:
            extents += [leaf.rows, leaf.columns]
            strides += [leaf.stride, dtype.itemsize] if leaf.is_row_major else [dtype.itemsize, leaf.stride]
        elif leaf.rows > 1:
            extents.append(leaf.rows)
            strides.append(dtype.itemsize)
        shape = tuple(extents)
        place: NDArray[Any] = np.ndarray(shape, dtype, memory, offset, tuple(strides))
        place[...] = _numbers(value, name, shape, dtype)


def _write_struct(kind: Type, value: Any, name: str, memory: NDArray[Any], offset: int) -> None:
    if not isinstance(value, Mapping):
        raise TypeError(f"{name}: must be a dictionary of its members, not {_arrays.text(value)}")
    left = dict(value)
    for member, at, inner in members(kind):
        if member not in left:
            raise ValueError(f"{name}.{member}: missing")
        write(inner, left.pop(member), f"{name}.{member}", memory, offset + at)
    for other in left:
        names = ", ".join(member for member, _, _ in kind.members)
        raise ValueError(f"{name}: has no member {_arrays.text(other)}; it has {names}")


def array_of(kind: Type) -> Optional[Tuple[np.dtype[Any], int]]:
    """The numbers of a storage block that is one array, and how many of them there are from element to element."""
    if len(kind.members) != 1:
        return None
    _, _, told = kind.members[0]
    leaf, _, strides = _leaf(Type(*told))
    if leaf.is_struct or not strides:
        return None
    dtype = _number_type(leaf)
    return dtype, strides[0] // dtype.itemsize
