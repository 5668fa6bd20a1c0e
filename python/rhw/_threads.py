# SPDX-License-Identifier: MIT
"""The contexts of each thread, made when they are first needed."""

from __future__ import annotations

import os
import threading
from typing import Dict, Optional

from . import _arrays, _rhw

_local = threading.local()


def _forget() -> None:
    # In a forked child the threads that draw for the parent are not there.
    global _local
    _local = threading.local()


os.register_at_fork(after_in_child=_forget)


def context(threads: int = 0) -> _rhw.Context:
    """The calling thread's own, in which so many threads draw; 0: as many as the process has cores."""
    kept: Dict[int, _rhw.Context] = _local.__dict__.setdefault("contexts", {})
    if threads not in kept:
        kept[threads] = _rhw.Context(threads=threads)
    return kept[threads]


def chosen(given: Optional[_rhw.Context]) -> _rhw.Context:
    """The argument `context` of many functions: None is the calling thread's."""
    if given is None:
        return context()
    if not isinstance(given, _rhw.Context):
        raise TypeError(f"context: must be an rhw.Context, not {_arrays.text(given)}")
    return given
