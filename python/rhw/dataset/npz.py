# SPDX-License-Identifier: MIT
"""Arrays as the bytes of a .npz that numpy.load reads.

numpy.savez writes headers whose length depends on its version, and a ZIP file has times. Here they have none, and nothing is
compressed: the bytes depend on the arrays alone.
"""

from __future__ import annotations

import io
import struct
import zipfile
from typing import Any, Dict

import numpy as np
from numpy.typing import NDArray

_EPOCH = (1980, 1, 1, 0, 0, 0)  # the first day that a ZIP file can name


def encode(arrays: Dict[str, NDArray[Any]]) -> bytes:
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_STORED) as archive:
        for name, array in arrays.items():
            entry = zipfile.ZipInfo(name + ".npy", _EPOCH)
            entry.create_system = 3  # Unix, wherever it is written
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, _npy(array))
    return file.getvalue()


def _npy(array: NDArray[Any]) -> bytes:
    """Version 1.0 of numpy's format, in little endian, its numbers on a multiple of 64."""
    little = np.ascontiguousarray(array, array.dtype.newbyteorder("<"))
    about = f"{{'descr': {little.dtype.str!r}, 'fortran_order': False, 'shape': {little.shape}, }}"
    about += " " * (-(10 + len(about) + 1) % 64) + "\n"
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(about)) + about.encode("ascii") + little.tobytes()
