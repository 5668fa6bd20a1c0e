# SPDX-License-Identifier: MIT
"""The folder of a data set: what lies where, and files that are there whole and are not written twice.

Pictures lie in DIR/MODEL/. DIR/.rhw/ keeps the plan and, beside the description of each model, a record of each view with
the hashes of its files, which is written after them: a view that has one is finished.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import time
from typing import Any, Dict, Iterable, List, NamedTuple, Set, Tuple

from .. import _arrays, _files
from .errors import Failure, Mistake

RECORDS = ".rhw"

_ABANDONED_SECONDS = 3600  # others may be at what is younger


class ViewNames(NamedTuple):
    """What a view's files are called, with the outputs in each, and its record."""

    files: Dict[str, List[str]]
    record: str


def plan_path(folder: str) -> str:
    return os.path.join(folder, RECORDS, "plan.json")


def model_path(folder: str, name: str) -> str:
    return os.path.join(folder, RECORDS, name, "model.json")


def manifest_path(folder: str) -> str:
    return os.path.join(folder, "manifest.json")


def transforms_path(folder: str, name: str) -> str:
    return os.path.join(folder, name, "transforms.json")


def check_name(path: str, what: str) -> None:
    """Refuses one that JSON cannot have."""
    try:
        path.encode()
    except UnicodeEncodeError:
        raise Mistake(f"{_arrays.text(path)}: the names of {what} must be UTF-8") from None


def encode(value: Any) -> bytes:
    """JSON by rules that do not depend on the machine: Python writes the shortest digits that give a float back."""
    return (json.dumps(value, ensure_ascii=False, allow_nan=False) + "\n").encode()


def read(path: str) -> Dict[str, Any]:
    """A file with a JSON object."""
    with open(path, "rb") as file:
        data = file.read()
    try:
        value = json.loads(data)
    except ValueError as error:
        raise Failure(f"{path}: is not JSON: {error}") from None
    except RecursionError:
        raise Failure(f"{path}: is damaged: lists in lists without end") from None
    if not isinstance(value, dict):
        raise Failure(f"{path}: must be a JSON object")
    return value


def digest(path: str) -> str:
    """The SHA-256 of a file."""
    sha = hashlib.sha256()
    with open(path, "rb") as file:
        while data := file.read(1 << 20):
            sha.update(data)
    return sha.hexdigest()


def put(path: str, data: bytes) -> None:
    """Writes a file, unless it is there with these bytes. A link to others gives way: they may be another file of the set."""
    try:
        if os.path.isfile(path):
            with open(path, "rb") as file:
                if file.read() == data:
                    return
    except FileNotFoundError:  # of another that draws the same view
        pass
    except OSError:
        if not os.path.islink(path):
            raise
    if os.path.islink(path):
        with contextlib.suppress(FileNotFoundError):  # of another that draws the same view
            os.unlink(path)
    _files.write(path, data)


def begin(path: str, data: bytes) -> None:
    """Writes a file, unless it is there, with whatever bytes: of several who begin it at once, all but one find it."""
    with contextlib.suppress(FileExistsError), _files.replacing(path, new=True) as file:
        file.write(data)


def places(folder: str, name: str) -> Tuple[str, str]:
    """Where a model's pictures lie, and their records."""
    return os.path.join(folder, name), os.path.join(folder, RECORDS, name)


def listing(folder: str, name: str) -> Set[str]:
    """Names of all files there are of a model, of its pictures and of its records."""
    found: Set[str] = set()
    for place in places(folder, name):
        try:
            found.update(os.listdir(place))
        except FileNotFoundError:
            pass
    return found


def has(folder: str, name: str, view: ViewNames) -> bool:
    """Whether a view is finished."""
    place, records = places(folder, name)
    return os.path.exists(os.path.join(records, view.record)) and all(
        os.path.exists(os.path.join(place, file)) for file in view.files)


def is_record(record: Dict[str, Any]) -> bool:
    """Whether it has what a record has."""
    numbers = all(isinstance(record.get(key), float) for key in ("fx", "fy", "cx", "cy"))
    tables = all(isinstance(record.get(key), dict) and record[key] for key in ("files", "sha256"))
    return numbers and tables and "camera_to_world" in record and "name" in record


def changed(folder: str, name: str, view: ViewNames) -> List[str]:
    """The files of a finished view that are not what its record says; the record, where it is none."""
    place, records = places(folder, name)
    try:
        record = read(os.path.join(records, view.record))
    except Failure:
        record = {}
    if not is_record(record):
        return [os.path.join(records, view.record)]
    paths = {file: os.path.join(place, file) for file in view.files}
    return [path for file, path in paths.items()
            if not os.path.isfile(path) or digest(path) != record["sha256"].get(f"{name}/{file}")]


def sweep(folder: str, names: Iterable[str]) -> None:
    """Removes what killed runs had begun to write."""
    for place in (folder, os.path.join(folder, RECORDS), *(place for name in names for place in places(folder, name))):
        for file in os.listdir(place):
            if file.startswith(_files.TEMPORARY):
                path = os.path.join(place, file)
                with contextlib.suppress(FileNotFoundError):  # of another that sweeps, or that has finished it
                    if time.time() - os.stat(path).st_mtime > _ABANDONED_SECONDS:
                        os.unlink(path)
