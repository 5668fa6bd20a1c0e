# SPDX-License-Identifier: MIT
"""What a data set is: its models, cameras and outputs, and the names of its files.

A plan is what was asked for, and nothing about the machines that do it. It is kept in the folder, so that the next run,
another shard and a worker elsewhere do the same.
"""

from __future__ import annotations

import json
import os
from dataclasses import asdict, dataclass
from typing import Any, Dict, Iterator, List, Optional, Sequence, Tuple

from .. import _rhw
from . import store
from .cameras import Cameras, cameras_from
from .errors import Failure, Mistake
from .light import Light

FORMAT = "rhw.dataset 1"  #: what the files of this version say they are

#: The formats of each output, the usual one first.
FORMATS = {"color": ("png", "npz"), "linear": ("exr", "npz"), "display": ("npz",), "depth": ("exr", "npz"),
           "distance": ("exr", "npz"), "normal": ("exr", "npz", "png"), "position": ("exr", "npz"),
           "uv": ("exr", "npz"), "object": ("exr", "npz", "png"), "triangle": ("exr", "npz", "png"),
           "barycentric": ("exr", "npz")}


#: What the folder's own files are called, and were.
_OWN = ("plan.json", "manifest.json", "manifest.json.new")


@dataclass(frozen=True)
class Plan:
    """models: names and paths. outputs: the format of each. load, render: keywords of rhw.load and Model.render. light:
    the panorama, where there is one."""

    models: Tuple[Tuple[str, str], ...]
    cameras: Cameras
    size: Tuple[int, int]
    outputs: Dict[str, str]
    load: Dict[str, Any]
    render: Dict[str, Any]
    light: Optional[Light] = None
    version: str = _rhw.version

    def to_json(self) -> Dict[str, Any]:
        return {"format": FORMAT, "rhw": self.version, "size": list(self.size), "outputs": self.outputs,
                "cameras": self.cameras.to_json(), "load": self.load, "render": self.render,
                "environment": self.light and asdict(self.light),
                "models": [{"name": name, "path": path} for name, path in self.models]}

    @classmethod
    def from_json(cls, about: Dict[str, Any]) -> "Plan":
        models = tuple((each["name"], each["path"]) for each in about["models"])
        light = Light(**about["environment"]) if about.get("environment") else None
        return cls(models, cameras_from(about["cameras"]), (about["size"][0], about["size"][1]), about["outputs"], about["load"],
                   about["render"], light, about["rhw"])

    @property
    def views(self) -> int:
        """Of each model."""
        return self.cameras.count

    def view_name(self, view: int) -> str:
        return f"{view:0{max(4, len(str(self.views - 1)))}}"

    def names(self, view: int) -> store.ViewNames:
        name, files = self.view_name(view), {}  # type: str, Dict[str, List[str]]
        for output, form in self.outputs.items():
            middle = f".{output}" if form == "png" and output != "color" else ""
            files.setdefault(f"{name}{middle}.{form}", []).append(output)
        return store.ViewNames(files, name + ".json")

    def all_views(self) -> Iterator[Tuple[int, int]]:
        """Numbers of model and view, in the order of the work."""
        return ((model, view) for model in range(len(self.models)) for view in range(self.views))


def shard(plan: Plan, number: int, count: int) -> List[Tuple[int, int]]:
    """The part of the views that one of so many shards draws: neighbours, so that it reads few models."""
    every = list(plan.all_views())
    return every[len(every) * (number - 1) // count:len(every) * number // count]


def _short(value: Any) -> str:
    text = json.dumps(value)
    return text if len(text) <= 40 else text[:37] + "..."


def difference(there: Any, asked: Any, name: str = "") -> Optional[str]:
    """The first thing in which two plans or descriptions differ; where models and the panorama lie is no difference."""
    if isinstance(there, dict) and isinstance(asked, dict):
        inner = [(f"{name}.{key}" if name else key, there.get(key), asked.get(key))
                 for key in dict.fromkeys([*there, *asked]) if key != "path"]
    elif isinstance(there, list) and isinstance(asked, list) and len(there) == len(asked):
        inner = [(f"{name}[{i}]", *pair) for i, pair in enumerate(zip(there, asked))]
    elif isinstance(there, list) and isinstance(asked, list):
        return f"{name} are {len(there)} there, not {len(asked)}"
    else:
        return None if there == asked else f"{name} is {_short(there)} there, not {_short(asked)}"
    return next((found for found in (difference(a, b, path) for path, a, b in inner) if found), None)


def begin(folder: str, plan: Plan) -> Plan:
    """Makes the folder the plan's, or takes up the plan that it has, if that asks for the same."""
    path = store.plan_path(folder)
    if not os.path.exists(path):
        _refuse_strangers(folder, path)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        store.begin(path, store.encode(plan.to_json()))
    found = read(folder)
    differs = difference(found.to_json(), json.loads(json.dumps(plan.to_json())))
    if differs:
        raise Failure(f"{folder}: has another data set: {differs}; take another folder")
    return found


def read(folder: str) -> Plan:
    """The plan of a folder."""
    path = store.plan_path(folder)
    about = store.read(path)
    if about.get("format") != FORMAT:
        raise Failure(f"{path}: is not of {FORMAT}")
    try:
        return Plan.from_json(about)
    except (AttributeError, IndexError, KeyError, TypeError):
        raise Failure(f"{path}: is damaged") from None


def _refuse_strangers(folder: str, plan: str) -> None:
    """What is there already might be somebody's, with the names that we are about to give."""
    strangers = os.path.isdir(folder) and any(not name.startswith(".") for name in os.listdir(folder))
    if strangers and not os.path.exists(plan):  # which another shard may have begun with meanwhile
        raise Failure(f"{folder}: holds other files; take a new or empty folder")


def name_models(paths: Sequence[str]) -> Tuple[Tuple[str, str], ...]:
    """A folder's name for each model: its file's without the ending, and as much of the path before as tells it from
    others that have the same. In the order of the names."""
    parts = {path: _parts(path) for path in paths}
    if len(parts) < len(paths):
        twice = next(path for i, path in enumerate(paths) if path in paths[:i])
        raise Mistake(f"{twice}: is given twice")
    taken: Dict[str, str] = {}
    for path in paths:
        store.check_name(path, "models")
        name = _name(path, parts)
        if name in taken:
            raise Mistake(f"{path}: would have the name '{name}', as {taken[name]} has")
        taken[name] = path
    return tuple(sorted(taken.items()))


def _parts(path: str) -> Tuple[str, ...]:
    """The end of a path first, without the file's ending."""
    folder, file = os.path.split(os.path.normpath(path))
    return (os.path.splitext(file)[0], *reversed([part for part in folder.split(os.sep) if part not in ("", "..")]))


def _name(path: str, parts: Dict[str, Tuple[str, ...]]) -> str:
    own = parts[path]
    others = [each for other, each in parts.items() if other != path and each[0] == own[0]]
    taken = len(own)
    for length in range(1, len(own) + 1):
        if all(each[:length] != own[:length] for each in others):
            taken = length
            break
    else:  # nothing but the ending tells them apart
        own = (os.path.basename(path), *own[1:])
        taken = 1
    joined = "-".join(reversed(own[:taken]))
    name = "".join(c if c.isprintable() and c not in "/\\" else "_" for c in joined).lstrip(".") or "model"
    return name + "_" if name in _OWN else name
