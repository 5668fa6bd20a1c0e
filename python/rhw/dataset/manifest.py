# SPDX-License-Identifier: MIT
"""manifest.json, from the records of all views, and a transforms.json beside the pictures of each model.

It is written last, and says nothing of when, where and by how many threads: two data sets are the same where their manifests
are.
"""

from __future__ import annotations

import contextlib
import json
import os
from dataclasses import asdict
from typing import Any, BinaryIO, Dict, Iterable, Iterator, List, Sequence

from .. import _files, _rhw
from ..pictures import TABLE
from . import store
from .cameras import Sphere
from .errors import Failure
from .plan import FORMAT, Plan

CONVENTIONS = {
    "pixels": "rows from top to bottom",
    "intrinsics": "OpenCV: a point X, Y, Z of the camera is at column fx X / Z + cx, row fy Y / Z + cy; the middle of the first "
                  "pixel is 0, 0",
    "world_to_camera": "OpenCV: x right, y down, z forward; for column vectors",
    "camera_to_world": "OpenGL, NeRF: x right, y up, z backward; for column vectors",
    "objects": "names by the numbers of `object`, 0 where nothing is; a node's triangles count from first_triangle in `triangle`",
    "content": "SHA-256 of the meshes, images, nodes, lights and materials that were read, of all files of the model"}

def _holds(output: str, form: str) -> str:
    """What a file has of an output."""
    row = TABLE[output]
    kind = {"|u1": "uint8", "<u4": "uint32", "<f4": "float32"}[row.type]
    if form == "npz":
        return f"{output}: {kind} ({'rows, columns' if row.channels == 1 else 'rows, columns, 4'})"
    if form == "exr":
        channels = [row.layer[0], *(name.split(".")[-1] for name in row.layer[1:])]
        return f"{' '.join(channels)}: {kind.rstrip('0123456789')}"
    return {"color": "8 bits", "normal": "16 bits, 0.5 + 0.5 n"}.get(output, "16 bits")


def _meaning(output: str) -> str:
    return "see conventions; 0 where nothing is" if output == "object" else TABLE[output].meaning


def _header(plan: Plan) -> Dict[str, Any]:
    outputs = {output: {"format": form, "holds": _holds(output, form), "meaning": _meaning(output)}
               for output, form in plan.outputs.items()}
    cameras = plan.cameras.to_json() if isinstance(plan.cameras, Sphere) else {"given": plan.views}
    return {"format": FORMAT, "rhw": plan.version, "size": list(plan.size), "outputs": outputs, "cameras": cameras,
            "load": plan.load, "render": plan.render, "environment": plan.light and asdict(plan.light), "conventions": CONVENTIONS}


def write(folder: str, plan: Plan, paths: Sequence[str], skipped: Dict[int, str]) -> str:
    """Writes both, if every view is there; what is to be told of it. skipped: models to leave out, with the reason."""
    kept = [number for number in range(len(plan.models)) if number not in skipped]
    for number in kept:
        _check_model(folder, plan.models[number][0], paths[number])
        name = plan.models[number][0]
        store.put(store.transforms_path(folder, name), transforms(plan.size, _records(folder, plan, number)))
    if not kept:
        raise Failure(f"{folder}: no model can be drawn")
    store.sweep(folder, [plan.models[number][0] for number in kept])
    target = store.manifest_path(folder)
    with contextlib.suppress(_Same), _files.replacing(target) as file:
        _write(file, folder, plan, kept)
        if _files.equals(file, target):
            raise _Same
    return f": {target}"


class _Same(Exception):
    """What was written is there already."""


def _check_model(folder: str, name: str, path: str) -> None:
    try:
        changed = store.digest(path) != store.read(store.model_path(folder, name))["sha256"]
    except OSError as error:
        raise Failure(f"{error.filename}: {error.strerror}") from None
    if changed:
        raise Failure(f"{path}: has changed since {folder} was begun; take another folder")


def _records(folder: str, plan: Plan, number: int) -> Iterator[Dict[str, Any]]:
    name = plan.models[number][0]
    for view in range(plan.views):
        names = plan.names(view)
        if not store.has(folder, name, names):
            raise Failure(f"{folder}: view {plan.view_name(view)} of {name} is missing; the same command draws it")
        path = os.path.join(store.places(folder, name)[1], names.record)
        record = store.read(path)
        if not store.is_record(record):
            raise Failure(f"{path}: is damaged; without it, the same command draws the view again")
        yield record


def _write(file: BinaryIO, folder: str, plan: Plan, kept: List[int]) -> None:
    """A line for each view, as they are written: there may be millions."""
    file.write(b"{\n")
    for key, value in _header(plan).items():
        lines = [f"  {json.dumps(name)}: {json.dumps(inner)}" for name, inner in value.items()] if isinstance(value, dict) else []
        text = "{\n" + ",\n".join(lines) + "}" if lines else json.dumps(value)
        file.write(f" {json.dumps(key)}: {text},\n".encode())
    file.write(b' "models": [')
    for place, number in enumerate(kept):
        name, path = plan.models[number]
        about = {"name": name, "path": path, **store.read(store.model_path(folder, name))}
        file.write((b",\n" if place else b"\n") + store.encode(about)[:-2] + b', "views": [')
        for view, record in enumerate(_records(folder, plan, number)):
            file.write((b",\n" if view else b"\n") + store.encode(record)[:-1])
        file.write(b"]}")
    file.write(b"]\n}\n")


def transforms(size: Sequence[int], records: Iterable[Dict[str, Any]]) -> bytes:
    """The cameras of a model's views as NeRF has them, for programs that look for that; this one, too (cameras.py)."""
    width, height = size
    lenses, frames = [], []
    for record in records:
        lenses.append({"camera_angle_x": _rhw.lens_angle(width, record["fx"]), "fl_x": record["fx"], "fl_y": record["fy"],
                       "cx": record["cx"] + 0.5, "cy": record["cy"] + 0.5})
        picture = next(iter(record["files"].values()))
        frames.append({"file_path": os.path.basename(record["files"].get("color", picture)),
                       "transform_matrix": record["camera_to_world"]})
    alike = all(lens == lenses[0] for lens in lenses)
    if not alike:
        frames = [{**frame, **lens} for frame, lens in zip(frames, lenses)]
    return store.encode({**(lenses[0] if alike else {}), "w": width, "h": height, "frames": frames})
