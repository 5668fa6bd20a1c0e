# SPDX-License-Identifier: MIT
"""Light from a picture of all that surrounds."""

from __future__ import annotations

import os
from typing import Any, Dict, Optional, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from . import _arrays, _rhw


class Environment:
    """A panorama that lights models, read once for any number of pictures.

    >>> sky = rhw.Environment("studio.hdr")
    >>> model.render(640, environment=sky, environment_rotation=90, background="environment")

    light: the path of a Radiance HDR or OpenEXR file, or of a TIFF, DDS or KTX2 of floats; or (H, W, 3) or (H, W, 4)
      floats of linear light, rows from straight up to straight down; the middle column looks along +x, the one a
      quarter further along +z. Its numbers may be of any unit: they are scaled. What no light can be, as negative
      numbers, becomes black.
    texels: (H, W, 4) float32, read-only: what is used of it. A pickle has them.
    """

    def __init__(self, light: Union[str, "os.PathLike[str]", NDArray[Any]]):
        self._panorama = _panorama(light, "light")
        self.texels: NDArray[Any] = np.asarray(_rhw.panorama_texels(self._panorama))

    def __reduce__(self) -> Tuple[Any, ...]:
        return Environment, (self.texels,)

    def __copy__(self) -> "Environment":
        return self  # nothing of it changes

    def __deepcopy__(self, memo: Dict[int, Any]) -> "Environment":
        return self

    def __repr__(self) -> str:
        return f"<rhw.Environment: {self.texels.shape[1]} x {self.texels.shape[0]}>"


def _panorama(light: Any, name: str) -> Any:
    """What the extension draws with."""
    if isinstance(light, (str, bytes, os.PathLike)):
        path = _arrays.path(light, name)
        if not os.path.exists(path):
            raise FileNotFoundError(2, "no such file", path)
        return _rhw.panorama_read(os.fsencode(path))
    array = _arrays.read(light, name)
    if array.dtype.kind != "f":
        raise TypeError(f"{name}: must be a path, or floats of linear light, not {array.dtype}")
    if not _arrays.is_image(array, (3, 4)):
        raise ValueError(f"{name}: must have the shape (H, W, 3) or (H, W, 4), of 1 to {_arrays.MOST} rows and columns, "
                         f"not {array.shape}")
    if not np.isfinite(array[:, :, :3]).any():
        raise ValueError(f"{name}: must be of numbers: none is finite")
    full = np.ones(array.shape[:2] + (4,), np.float32)
    with np.errstate(over="ignore"):
        full[:, :, :3] = array[:, :, :3]
    return _rhw.panorama(full)


def chosen(given: Any) -> Optional[Any]:
    """The argument `environment` of render, for the extension."""
    if given is None:
        return None
    return given._panorama if isinstance(given, Environment) else _panorama(given, "environment")
