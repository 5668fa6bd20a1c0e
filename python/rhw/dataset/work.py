# SPDX-License-Identifier: MIT
"""Draws views: their files, and then the record that says they are finished. Runs on any machine that sees the folder."""

from __future__ import annotations

import functools
import hashlib
import os
import threading
from dataclasses import dataclass
from typing import Any, Dict, List, NamedTuple, Optional, Sequence, Tuple

import numpy as np
from numpy.typing import NDArray

from .. import _rhw, _threads
from ..environment import Environment
from ..model import Model
from ..pictures import Pictures
from . import light, npz, plan as plans, store
from .cameras import Shot
from .errors import Broken, Failure
from .models import Models
from .plan import Plan

_lock = threading.Lock()


@dataclass(frozen=True)
class Task:
    """Views of one model. run: names the run, as another one may begin in the same folder anew. path: of the model's file,
    from the root; lit_by: of the panorama's. threads: that draw a picture."""

    run: str
    folder: str
    model: int
    path: str
    views: Tuple[int, ...]
    threads: int
    strict: bool = False
    lit_by: Optional[str] = None


@dataclass(frozen=True)
class Done:
    """What became of a task. broken: why the model cannot be drawn; failed: why nothing more can be."""

    task: Task
    drawn: int = 0
    warnings: Tuple[str, ...] = ()
    broken: Optional[str] = None
    failed: Optional[str] = None


class _Workshop(NamedTuple):
    """The plan of a folder, its models and its light, which a process keeps between tasks."""

    plan: Plan
    models: Models
    environment: Optional[Environment]


@functools.lru_cache(maxsize=2)
def _open_workshop(run: str, folder: str, strict: bool, lit_by: Optional[str]) -> _Workshop:
    try:
        plan = plans.read(folder)
    except FileNotFoundError:
        raise Failure(f"{folder}: is not seen from here: all that draw must share the folder") from None
    if plan.version != _rhw.version:
        raise Failure(f"{folder}: is of rhw {plan.version}, and here is rhw {_rhw.version}")
    environment = light.take(plan.light, lit_by or plan.light.path, folder) if plan.light else None
    return _Workshop(plan, Models(folder, plan, strict), environment)


def _workshop(task: Task) -> _Workshop:
    with _lock:
        return _open_workshop(task.run, task.folder, task.strict, task.lit_by)


def draw(task: Task) -> Done:
    """Draws what is not finished of a task."""
    drawn = 0
    try:
        shop = _workshop(task)
        model, about = shop.models.get(task.model, task.path)
        for view in task.views:
            # Another worker may have had this task before, and have been lost at its end.
            of_view = task.folder, shop.plan.models[task.model][0], shop.plan.names(view)
            if not store.has(*of_view) or store.changed(*of_view):
                _draw_view(task, shop, model, view)
                drawn += 1
    except Broken as error:
        return Done(task, drawn, broken=str(error))
    except Failure as error:
        return Done(task, drawn, failed=str(error))
    except OSError as error:
        return Done(task, drawn, failed=f"{error.filename or task.folder}: {error.strerror or error}")
    return Done(task, drawn, tuple(about["warnings"] + about["unsupported"]))


def _draw_view(task: Task, shop: _Workshop, model: Model, view: int) -> None:
    plan = shop.plan
    name, names = plan.models[task.model][0], plan.names(view)
    shot = plan.cameras.shot(view, model, name, plan.size)
    try:
        pictures = model.render(plan.size, shot.camera(), outputs=list(plan.outputs), context=_threads.context(task.threads),
                                environment=shop.environment, environment_rotation=plan.light.rotation if plan.light else 0.0,
                                **plan.render)
        files = {file: _encode(file, outputs, pictures) for file, outputs in names.files.items()}
    except (_rhw.Error, ValueError) as error:
        raise Broken(f"{task.path}: view {plan.view_name(view)}: {error}") from None
    place, records = store.places(task.folder, name)
    os.makedirs(place, exist_ok=True)
    for file, data in files.items():
        store.put(os.path.join(place, file), data)
    where = {output: f"{name}/{file}" for file, outputs in names.files.items() for output in outputs}
    hashes = {f"{name}/{file}": hashlib.sha256(data).hexdigest() for file, data in files.items()}
    record = {"name": plan.view_name(view), **_describe(shot, pictures),
              "files": {output: where[output] for output in plan.outputs}, "sha256": hashes}
    store.put(os.path.join(records, names.record), store.encode(record))


def _encode(file: str, outputs: Sequence[str], pictures: Pictures) -> bytes:
    if file.endswith(".npz"):
        return npz.encode({output: pictures[output] for output in outputs})
    if file.endswith(".exr"):
        return pictures.exr(outputs)
    output = outputs[0]
    if output in ("object", "triangle"):
        return _rhw.encode_png(file, pictures[output].astype("<u2")[:, :, None], 16, False)
    return pictures.png(output, 8 if output == "color" else 16)


def _rows(matrix: NDArray[Any]) -> List[List[float]]:
    return [[value + 0.0 for value in row] for row in matrix.tolist()]  # no -0


def _describe(shot: Shot, pictures: Pictures) -> Dict[str, Any]:
    """The camera as it was drawn with: the matrix of the renderer, and its axes and place."""
    seen = pictures.view
    world = np.eye(4)
    world[:3, :3] = seen.view[:3, :3].T
    world[:3, 3] = seen.eye
    return {"fx": shot.fx, "fy": shot.fy, "cx": shot.cx, "cy": shot.cy, "near": seen.near,
            "far": seen.far if np.isfinite(seen.far) else None,
            "world_to_camera": _rows(seen.view * np.array([[1], [-1], [-1], [1]])), "camera_to_world": _rows(world)}
