# SPDX-License-Identifier: MIT
"""Arguments as arrays of the shape and type that the extension takes, or an exception that names argument and rule."""

from __future__ import annotations

import os
from typing import Any, List, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from . import _rhw

#: The most rows and columns of anything that is drawn.
MOST = _rhw.max_target_size

Size = Union[int, Tuple[int, int]]


def _of_dlpack(value: Any, name: str) -> NDArray[Any]:
    cpu = 1  # kDLCPU of dlpack.h
    if tuple(value.__dlpack_device__())[:1] != (cpu,):
        raise TypeError(f"{name}: must lie in main memory, not on a device")
    return np.from_dlpack(value)


def _is_masked(value: Any, depth: int = 6) -> bool:
    """Whether it is an array with masked elements, or a list that has one, or the masked element, within lists in lists."""
    if isinstance(value, (list, tuple)):
        if len(value) > 0 and isinstance(value[0], (int, float)):
            return any(element is np.ma.masked for element in value)
        return depth > 0 and any(_is_masked(element, depth - 1) for element in value)
    return isinstance(value, np.ma.MaskedArray) and bool(np.any(np.ma.getmaskarray(value)))  # type: ignore[no-untyped-call]


def read(value: Any, name: str) -> NDArray[Any]:
    """The array of an argument: NumPy's own, a buffer, or by DLPack one of another library that lies in main memory."""
    if _is_masked(value):
        raise ValueError(f"{name}: must have no masked elements; the method filled of a masked array gives them numbers")
    if isinstance(value, np.ndarray):
        return np.asarray(value)  # of what looks different what it is
    try:
        if hasattr(value, "__dlpack__") and not hasattr(value, "__array__"):
            return _of_dlpack(value, name)
        return np.asarray(value)
    except Exception as error:
        told = str(error)
        raise TypeError(told if told.startswith(f"{name}: ") else f"{name}: cannot be read as an array: {line(told)}") from error


def packed(array: NDArray[Any], dtype: Any) -> NDArray[Any]:
    """The array with elements of that type one behind the other, where the processor wants them: the same one if it has."""
    return np.require(array, dtype, ["C_CONTIGUOUS", "ALIGNED"])


def _shape_text(shape: Sequence[Optional[int]]) -> str:
    inner = ", ".join("N" if extent is None else str(extent) for extent in shape)
    return f"({inner},)" if len(shape) == 1 else f"({inner})"


def _check_shape(array: NDArray[Any], name: str, shape: Sequence[Optional[int]]) -> None:
    fits = array.ndim == len(shape) and all(
        wanted is None or wanted == got for wanted, got in zip(shape, array.shape))
    if not fits:
        raise ValueError(f"{name}: must have the shape {_shape_text(shape)}, not {array.shape}")


def any_floats(value: Any, name: str, shape: Sequence[Optional[int]], dtype: Any = np.float32) -> NDArray[Any]:
    """A contiguous array of floats, NaN and infinity among them; None in `shape` is any extent."""
    array = read(value, name)
    if array.dtype.kind not in "fiu":
        raise TypeError(f"{name}: must be of numbers, not {array.dtype}")
    _check_shape(array, name, shape)
    with np.errstate(over="ignore"):
        return packed(array, dtype)


def floats(value: Any, name: str, shape: Sequence[Optional[int]], dtype: Any = np.float32) -> NDArray[Any]:
    """A contiguous array of finite floats."""
    return finite(any_floats(value, name, shape, dtype), name)


def finite(array: NDArray[Any], name: str) -> NDArray[Any]:
    """A contiguous array of integers, float32 or float64, where every number of it is one."""
    if array.dtype.kind == "f" and not _rhw.is_finite(array.reshape(-1)):
        raise ValueError(f"{name}: every number must be finite, as {array.dtype} too")
    return array


def converted(array: NDArray[Any], name: str, kind: np.dtype[Any]) -> NDArray[Any]:
    """The same numbers in another type: integers that it has, or floats as near as it has them."""
    if kind.kind == "f":
        with np.errstate(over="ignore"):
            return array.astype(kind)
    limits = np.iinfo(kind)
    if array.dtype.kind == "f":
        within = (array >= limits.min) & (array < float(limits.max) + 1) & (array == np.rint(array))
    else:
        within = (array >= limits.min) & (array <= limits.max)
    if not within.all():
        raise ValueError(f"{name}: must be of numbers that {kind} has, not {array[~within].flat[0]}")
    return array.astype(kind)


def indices(value: Any, name: str, shape: Sequence[Optional[int]], count: int) -> NDArray[Any]:
    """A contiguous array of uint32, each below `count`."""
    array = read(value, name)
    if array.dtype.kind not in "iu":
        raise TypeError(f"{name}: must be of integers, not {array.dtype}")
    _check_shape(array, name, shape)
    if array.size and (int(array.min()) < 0 or int(array.max()) >= count):
        worst = int(array.min()) if int(array.min()) < 0 else int(array.max())
        raise ValueError(f"{name}: must lie between 0 and {count - 1}, the last of {count} vertices, not {worst}")
    return packed(array, np.uint32)


def empty(shape: Tuple[int, ...]) -> NDArray[Any]:
    """A contiguous array of float32 with any numbers, on memory of a former one where there is some."""
    return np.asarray(_rhw.empty(shape))


def texels(value: Any, name: str) -> NDArray[Any]:
    """A contiguous (H, W, 4) array of uint8 of an image with 1, 3 or 4 channels."""
    if isinstance(value, (str, bytes)):
        raise TypeError(f"{name}: must be an array of uint8, not the path {value!r}")
    array = read(value, name)
    if array.dtype != np.uint8:
        raise TypeError(f"{name}: must be of uint8, not {array.dtype}")
    if array.ndim == 2:
        array = array[:, :, None]
    if array.ndim != 3 or array.shape[2] not in (1, 3, 4) or array.size == 0:
        raise ValueError(f"{name}: must have the shape (H, W), (H, W, 3) or (H, W, 4), not {array.shape}")
    if array.shape[2] == 4:
        return array.copy()  # at once: by parts a gigabyte takes twice as long, and no Ctrl-C ends it meanwhile
    full = np.full(array.shape[:2] + (4,), 255, np.uint8)
    full[:, :, :3] = array
    return full


def is_image(array: NDArray[Any], channels: Sequence[int]) -> bool:
    """Whether it has the shape (H, W, C), with so many channels, and as many rows and columns as pictures may have."""
    return array.ndim == 3 and array.shape[2] in channels and 1 <= min(array.shape[:2]) <= max(array.shape[:2]) <= MOST


def line(told: str, most: int = 200) -> str:
    """A text for a message: on one line, and short."""
    words = " ".join(told.split())
    return words if len(words) <= most else words[:most - 3] + "..."


def text(value: Any) -> str:
    """A value for a message."""
    return line(repr(value), 60)


def choice(value: Any, name: str, choices: Sequence[str]) -> int:
    """The place of a name among those there are."""
    if not isinstance(value, str) or value not in choices:
        raise ValueError(f"{name}: {text(value)} is not one of {', '.join(choices)}")
    return choices.index(value)


def number(value: Any, name: str, least: float, most: float) -> float:
    """A number in a range, both ends included."""
    try:
        if isinstance(value, (str, bytes, bytearray)) or _is_masked(value):
            raise TypeError
        found = float(value)
    except (TypeError, ValueError, OverflowError):
        raise TypeError(f"{name}: must be a number, not {text(value)}") from None
    if not least <= found <= most:
        raise ValueError(f"{name}: must lie between {least:g} and {most:g}, not {found:g}")
    return found


def is_whole(value: Any) -> bool:
    """Whether it is a whole number; True and False are none."""
    return isinstance(value, (int, np.integer)) and not isinstance(value, bool)


def _scalar(value: Any) -> Any:
    """The number of an array or a tensor without extents; what is none stays as it is."""
    return value.item() if getattr(value, "shape", None) == () and not _is_masked(value) else value


def whole(value: Any, name: str, least: int, most: int) -> int:
    """A whole number in a range, both ends included."""
    value = _scalar(value)
    if not is_whole(value):
        raise TypeError(f"{name}: must be a whole number, not {text(value)}")
    if not least <= value <= most:
        raise ValueError(f"{name}: must lie between {least} and {most}, not {text(int(value))}")
    return int(value)


def one_of(value: Any, name: str, choices: Sequence[int]) -> int:
    """A whole number of a few."""
    value = _scalar(value)
    if not is_whole(value) or value not in choices:
        listed = ", ".join(map(str, choices[:-1])) + f" or {choices[-1]}"
        raise ValueError(f"{name}: must be {listed}, not {text(value)}")
    return int(value)


def flag(value: Any, name: str) -> bool:
    """Yes or no: what else counts as true in Python, as the text 'off' does, is rarely meant so."""
    if not isinstance(value, (bool, np.bool_)):
        raise TypeError(f"{name}: must be True or False, not {text(value)}")
    return bool(value)


def words(value: Any, name: str) -> str:
    """A text as others can have it: in UTF-8, and without a zero, which would end it."""
    if not isinstance(value, str):
        raise TypeError(f"{name}: must be a str, not {text(value)}")
    if "\0" in value or value != shown(value):
        raise ValueError(f"{name}: must be a text in UTF-8 without zeros, not {text(value)}")
    return value


def shown(name: str) -> str:
    """A path for messages, with something else for bytes that are no text."""
    return name.encode("utf-8", "replace").decode("utf-8")


def path(value: Any, name: str) -> str:
    """A path as a text, in which bytes that are none stand as Python's os.fsdecode has them."""
    try:
        found = os.fsdecode(value)
        os.fsencode(found)
    except UnicodeEncodeError:
        raise ValueError(f"{name}: must be a path, not {text(value)}") from None
    except TypeError:
        raise TypeError(f"{name}: must be a path, not {text(value)}") from None
    if "\0" in found:
        raise ValueError(f"{name}: must not have a zero character, as {text(value)} has")
    return found


def listed(value: Any, name: str, what: str) -> List[Any]:
    """What an argument goes through."""
    try:
        return list(value)
    except TypeError:
        raise TypeError(f"{name}: must be {what}, not {text(value)}") from None


def size(value: Any) -> Tuple[int, int]:
    """(width, height), or one number for both."""
    is_pair = isinstance(value, (tuple, list)) or getattr(value, "ndim", None) == 1
    pair = tuple(map(_scalar, value)) if is_pair else (_scalar(value),) * 2
    if len(pair) != 2 or not all(map(is_whole, pair)):
        raise TypeError(f"size: must be (width, height) or one number, not {text(value)}")
    width, height = int(pair[0]), int(pair[1])
    if not (1 <= width <= MOST and 1 <= height <= MOST):
        raise ValueError(f"size: width and height must lie between 1 and {MOST}, not {width}, {height}")
    return width, height


def matrix(value: Any, name: str) -> NDArray[Any]:
    """A (4, 4) matrix of float64 for column vectors; (3, 4) gets its last row."""
    array = read(value, name)
    if array.shape != (3, 4):
        return floats(array, name, (4, 4), np.float64)
    return np.vstack([floats(array, name, (3, 4), np.float64), [0, 0, 0, 1]])


def product(a: NDArray[Any], b: NDArray[Any]) -> NDArray[Any]:
    """a @ b of (4, 4) matrices, summed in a fixed order: libraries for linear algebra choose theirs by the machine."""
    total: NDArray[Any] = a[:, 0, None] * b[None, 0, :]
    for k in range(1, 4):
        total = total + a[:, k, None] * b[None, k, :]
    return total
