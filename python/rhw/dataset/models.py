# SPDX-License-Identifier: MIT
"""The models of a data set: read once for many views, described, and known again when they have changed."""

from __future__ import annotations

import dataclasses
import hashlib
import json
import os
import threading
from typing import Any, Dict, List, Optional, Tuple

import numpy as np

from .. import _rhw
from ..model import Model, load
from . import store
from .errors import Broken
from .plan import Plan, difference

_MOST_OF_PNG = 65535


def describe(model: Model, sha256: str) -> Dict[str, Any]:
    """What the manifest says of a model, but for its name and path."""
    objects: List[Optional[str]] = [None] * (1 + max(node.object for node in model.nodes))
    nodes, triangle = [], 1
    for node in model.nodes:
        objects[node.object] = node.name
        count = len(model.meshes[node.mesh].faces)
        material = model.materials[model.meshes[node.mesh].material].name
        nodes.append({"name": node.name, "object": node.object, "material": material, "first_triangle": triangle,
                      "triangles": count})
        triangle += count
    low, high = model.bounds.tolist()
    return {"sha256": sha256, "content": _content(model), "format": model.format, "unit": model.unit, "up": model.up,
            "bounds": [low, high], "objects": objects, "nodes": nodes, "warnings": list(model.warnings),
            "unsupported": list(model.unsupported)}


def _content(model: Model) -> str:
    """The SHA-256 of what was read, from the file and from others that it names."""
    sha = hashlib.sha256()

    def add(value: Any) -> None:
        plain = {}
        for field in dataclasses.fields(value):
            inner = getattr(value, field.name)
            if isinstance(inner, np.ndarray):
                plain[field.name] = [str(inner.dtype), inner.shape]
                sha.update(np.ascontiguousarray(inner).data)
            else:
                plain[field.name] = inner
        sha.update(json.dumps(plain).encode())

    for each in (*model.meshes, *model.materials, *model.images, *model.nodes, *model.lights):
        add(each)
    return sha.hexdigest()


def _refuse(plan: Plan, model: Model, about: Dict[str, Any], strict: bool) -> None:
    faults = [*about["warnings"], *about["unsupported"]]
    if strict and faults:
        raise Broken(f"{model.path}: {faults[0]}")
    last = about["nodes"][-1]
    counts = {"object": len(about["objects"]) - 1, "triangle": last["first_triangle"] + last["triangles"] - 1}
    for output, count in counts.items():
        if plan.outputs.get(output) == "png" and count > _MOST_OF_PNG:
            raise Broken(f"{model.path}: has {count} {output}s, and a PNG counts to {_MOST_OF_PNG}; take {output}:exr")


def _open(folder: str, plan: Plan, number: int, path: str, strict: bool) -> Tuple[Model, Dict[str, Any]]:
    """Reads a model, and writes its description or compares it with the one that is there."""
    try:
        sha256 = store.digest(path)
        model = load(path, **plan.load)
    except OSError as error:
        raise Broken(f"{path}: {error.strerror or error}") from None
    except _rhw.Error as error:
        raise Broken(str(error)) from None
    about = json.loads(json.dumps(describe(model, sha256)))
    _refuse(plan, model, about, strict)
    described = store.model_path(folder, plan.models[number][0])
    try:
        differs = difference(store.read(described), about)
        if differs:
            raise Broken(f"{path}: has changed since {folder} was begun: {differs}")
    except FileNotFoundError:
        os.makedirs(os.path.dirname(described), exist_ok=True)
        store.put(described, store.encode(about))
    return model, about


class Models:
    """The models that were asked for last; threads that want the same one wait for one of them to read it."""

    def __init__(self, folder: str, plan: Plan, strict: bool, kept: int = 2):
        self._folder, self._plan, self._strict, self._kept = folder, plan, strict, kept
        self._lock = threading.Lock()
        self._entries: Dict[int, _Entry] = {}

    def get(self, number: int, path: str) -> Tuple[Model, Dict[str, Any]]:
        """A model and its description; Broken every time where it cannot be drawn."""
        with self._lock:
            entry = self._entries.pop(number, None) or _Entry()
            self._entries[number] = entry  # the last of them now
            while len(self._entries) > self._kept:
                del self._entries[next(iter(self._entries))]
        with entry.lock:
            if entry.broken:
                raise Broken(entry.broken)
            if entry.found is None:
                try:
                    entry.found = _open(self._folder, self._plan, number, path, self._strict)
                except Broken as error:
                    entry.broken = str(error)
                    raise
            return entry.found


class _Entry:
    def __init__(self) -> None:
        self.lock = threading.Lock()
        self.found: Optional[Tuple[Model, Dict[str, Any]]] = None
        self.broken = ""
