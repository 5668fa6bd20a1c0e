# SPDX-License-Identifier: MIT
"""The context of each thread, made when it is first needed."""

from __future__ import annotations

import os
import threading
from typing import Optional

from . import _arrays, _rhw

_local = threading.local()


def _forget() -> None:
    # In a forked child the threads of the parent's contexts are not there.
    global _local
    _local = threading.local()


os.register_at_fork(after_in_child=_forget)


def context() -> _rhw.Context:
    """The calling thread's context."""
    found = getattr(_local, "context", None)
    if found is None:
        found = _local.context = _rhw.Context()
    return found


def chosen(given: Optional[_rhw.Context]) -> _rhw.Context:
    """The argument `context` of many functions: None is the calling thread's."""
    if given is None:
        return context()
    if not isinstance(given, _rhw.Context):
        raise TypeError(f"context: must be an rhw.Context, not {_arrays.text(given)}")
    return given
