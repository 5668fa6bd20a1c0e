# SPDX-License-Identifier: MIT
"""Compares the files of a data set with its manifest."""

from __future__ import annotations

import hashlib
import os
import sys
from typing import Any, Dict, Iterator, Optional, Tuple

from . import manifest, store
from .errors import Failure
from .plan import FORMAT


def verify(folder: str, quiet: bool) -> int:
    """Says a line for each file that is not what it was, a model's transforms.json among them; the exit status."""
    path = store.manifest_path(folder)
    try:
        about = store.read(path)
    except FileNotFoundError:
        unfinished = os.path.exists(store.plan_path(folder))
        raise Failure(f"{folder}: " + ("is not finished: its command goes on" if unfinished else
                                       "is no data set: it has no manifest.json")) from None
    if about.get("format") != FORMAT:
        raise Failure(f"{path}: is not of {FORMAT}")
    files = faults = 0
    try:
        for name, sha256 in _hashes(about):
            files += 1
            fault = _fault(folder, name, sha256)
            if fault:
                faults += 1
                print(f"rhw.dataset: {os.path.join(folder, name)}: {fault}", file=sys.stderr)
    except (ArithmeticError, AttributeError, LookupError, RecursionError, TypeError, ValueError):
        raise Failure(f"{path}: is damaged") from None
    if faults:
        raise Failure(f"{folder}: {faults} of {files} files are not those of the manifest")
    if not quiet:
        print(f"{folder}: {files} files are those of the manifest", flush=True)
    return 0


def _hashes(about: Dict[str, Any]) -> Iterator[Tuple[str, str]]:
    """The files of the set; what follows from the manifest has its hash from there."""
    for model in about["models"]:
        if not model["views"] or not all(map(store.is_record, model["views"])):
            raise ValueError
        for view in model["views"]:
            yield from view["sha256"].items()
        cameras = manifest.transforms(about["size"], model["views"])
        yield store.transforms_path("", model["name"]), hashlib.sha256(cameras).hexdigest()


def _fault(folder: str, name: str, sha256: str) -> Optional[str]:
    try:
        return None if store.digest(os.path.join(folder, name)) == sha256 else "has changed"
    except FileNotFoundError:
        return "is missing"
    except OSError as error:
        return f"cannot be read: {error.strerror}"
