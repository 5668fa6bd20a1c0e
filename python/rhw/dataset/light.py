# SPDX-License-Identifier: MIT
"""The panorama that lights a data set: read once by a process, and known again when it has changed."""

from __future__ import annotations

import functools
import os
from dataclasses import dataclass

from .. import _rhw
from ..environment import Environment
from . import store
from .errors import Failure


@dataclass(frozen=True)
class Light:
    """sha256: of the file. rotation: degrees about what is up."""

    path: str
    sha256: str
    rotation: float


@functools.lru_cache(maxsize=1)
def _read(path: str, sha256: str) -> Environment:
    try:
        environment = Environment(path)
    except _rhw.Error as error:
        raise Failure(str(error)) from None
    if store.digest(path) != sha256:
        raise Failure(f"{path}: has changed while it was read")
    return environment


def find(path: str, rotation: float) -> Light:
    """Of a file that is one: nothing is begun with another."""
    store.check_name(path, "panoramas")
    found = Light(path, store.digest(path), rotation)
    _read(os.path.abspath(path), found.sha256)
    return found


def take(light: Light, path: str, folder: str) -> Environment:
    """What to draw with. path: of the file today, from the root."""
    sha256 = store.digest(path)
    if sha256 != light.sha256:
        raise Failure(f"{path}: has changed since {folder} was begun; take another folder")
    return _read(path, sha256)
