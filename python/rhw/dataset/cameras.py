# SPDX-License-Identifier: MIT
"""Where the pictures are taken from: places on a sphere around a model, or the cameras of a file.

Only additions, multiplications, divisions and square roots, which every machine rounds alike; sines and tangents come from
the extension.
"""

from __future__ import annotations

import hashlib
import math
from dataclasses import asdict, dataclass
from typing import Any, Dict, List, Optional, Sequence, Tuple

from .. import _arrays, _rhw
from ..camera import AXES, Camera
from ..model import Model
from . import store
from .errors import Failure

Vector = Tuple[float, float, float]

#: Turned by it each time, no number of places stand above each other: the circle divided by the golden ratio.
_GOLDEN = 180 * (3 - math.sqrt(5))

#: The part of the picture that the sphere around a model fills, as a fitted camera does.
_FILLED = 0.92


@dataclass(frozen=True)
class Shot:
    """A camera in the world, by its axes and its place, with a lens as OpenCV has it (see rhw.Camera.intrinsics)."""

    right: Vector
    up: Vector
    back: Vector
    eye: Vector
    fx: float
    fy: float
    cx: float
    cy: float

    def camera(self) -> Camera:
        rows = (self.right, tuple(-c for c in self.up), tuple(-c for c in self.back))
        view = [[*row, -_dot(row, self.eye)] for row in rows]
        return Camera.intrinsics(self.fx, self.fy, self.cx, self.cy, view)


def _dot(a: Sequence[float], b: Sequence[float]) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def focal_length(extent: float, degrees: float) -> float:
    """Of a lens that sees so many pixels under an angle."""
    sine, cosine = _rhw.sin_cos_degrees(degrees / 2)
    return extent * cosine / (2 * sine)


class Cameras:
    """Cameras by their numbers, 0 to count - 1."""

    count: int

    def shot(self, view: int, model: Model, name: str, size: Tuple[int, int]) -> Shot:
        raise NotImplementedError

    def to_json(self) -> Dict[str, Any]:
        raise NotImplementedError


@dataclass(frozen=True)
class Sphere(Cameras):
    """Evenly spread around the middle of the model, which they look at.

    elevation: least and greatest, degrees. radius: least and greatest, in multiples of the distance at which the sphere around
    the model's box fills the picture; with `distance` in the model's units. center: instead of the box's middle.
    jitter: 0, evenly, to 1, anywhere in a cell as large as each camera has. seed: of it, and of radii that differ.
    """

    views: int
    elevation: Tuple[float, float] = (-90.0, 90.0)
    radius: Tuple[float, float] = (1.0, 1.0)
    distance: bool = False
    center: Optional[Vector] = None
    up: Optional[str] = None
    fovy: float = 40.0
    jitter: float = 0.0
    seed: int = 0

    @property
    def count(self) -> int:  # type: ignore[override]
        return self.views

    def to_json(self) -> Dict[str, Any]:
        return {"sphere": asdict(self)}

    def shot(self, view: int, model: Model, name: str, size: Tuple[int, int]) -> Shot:
        around, across, further = (self._chance(name, view, what) for what in ("azimuth", "height", "radius"))
        low, high = (_rhw.sin_cos_degrees(angle)[0] for angle in self.elevation)
        height = low + (high - low) * ((view + 0.5 + self.jitter * (across - 0.5)) / self.views)
        height = min(max(height, -1.0), 1.0)
        turned = view * _GOLDEN + self.jitter * (around - 0.5) * (360 / math.sqrt(self.views))
        focal = focal_length(size[1], self.fovy)
        radius = self.radius[0] + (self.radius[1] - self.radius[0]) * further
        if not self.distance:
            radius *= _whole_distance(model, min(size) / (2 * focal))
        axis = AXES.index(self.up or model.up)
        right, up, back = (_rhw.axis_turn(axis, each) for each in _place(math.fmod(turned, 360), height))
        middle = self.center or _middle(model)
        eye = (middle[0] + radius * back[0], middle[1] + radius * back[1], middle[2] + radius * back[2])
        return Shot(right, up, back, eye, focal, focal, size[0] / 2 - 0.5, size[1] / 2 - 0.5)

    def _chance(self, name: str, view: int, what: str) -> float:
        """A number in [0, 1) that depends on the seed and on what it is for, not on the order of the work."""
        data = hashlib.sha256(f"{self.seed}/{name}/{view}/{what}".encode()).digest()
        return (int.from_bytes(data[:8], "little") >> 11) / 2.0**53


def _place(azimuth: float, height: float) -> Tuple[Vector, Vector, Vector]:
    """Right, up and back of a camera at a place of the unit sphere, with y up, that looks at its middle; above the poles too."""
    sine, cosine = _rhw.sin_cos_degrees(azimuth)
    level = math.sqrt((1 - height) * (1 + height))
    return ((cosine, 0.0, -sine), (-height * sine, level, -height * cosine), (level * sine, height, level * cosine))


def _corners(model: Model) -> Tuple[List[float], List[float]]:
    low, high = model.frame.tolist()
    return low, high


def _middle(model: Model) -> Vector:
    low, high = _corners(model)
    return ((low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2)


def _whole_distance(model: Model, tangent: float) -> float:
    """Where the sphere around the model's box fills what a lens sees, whose half angle has that tangent."""
    low, high = _corners(model)
    half = [(b - a) / 2 for a, b in zip(low, high)]
    filled = tangent * _FILLED
    return (math.sqrt(_dot(half, half)) or 1.0) * math.sqrt(1 + filled * filled) / filled


@dataclass(frozen=True)
class Given(Cameras):
    """Those of a file, for a picture of the plan's size."""

    shots: Tuple[Shot, ...]

    @property
    def count(self) -> int:  # type: ignore[override]
        return len(self.shots)

    def to_json(self) -> Dict[str, Any]:
        return {"given": [asdict(shot) for shot in self.shots]}

    def shot(self, view: int, model: Model, name: str, size: Tuple[int, int]) -> Shot:
        return self.shots[view]


def cameras_from(about: Dict[str, Any]) -> Cameras:
    """What `to_json` wrote."""
    if "sphere" in about:
        return Sphere(**about["sphere"])
    return Given(tuple(Shot(**each) for each in about["given"]))


# A file of cameras ---------------------------------------------------------------------------------

_LENS = ("fl_x", "fl_y", "cx", "cy", "w", "h", "camera_angle_x", "camera_angle_y")
_DISTORTION = ("k1", "k2", "k3", "k4", "p1", "p2")


def read_file(path: str, size: Optional[Tuple[int, int]], usual: Tuple[int, int]) -> Tuple[Given, Tuple[int, int]]:
    """The cameras of a transforms.json as NeRF has them, and the size of the pictures.

    Matrices are camera to world, for column vectors, of a camera that looks along its -z with y up. The lens is fl_x, fl_y,
    cx, cy of a picture of w by h, (0, 0) being its corner, or camera_angle_x in radians; for all, or in a frame.
    size: of the pictures, if it was asked for; else the file's, or the usual one.
    """
    about = store.read(path)
    frames = about.get("frames")
    if not isinstance(frames, list) or not frames:
        raise Failure(f"{path}: frames: must be a list of cameras")
    chosen = size or _size_of(about, path) or usual
    shots = tuple(_shot(about, frame, f"{path}: frames[{i}]", chosen) for i, frame in enumerate(frames))
    return Given(shots), chosen


def _size_of(about: Dict[str, Any], name: str) -> Optional[Tuple[int, int]]:
    if "w" not in about or "h" not in about:
        return None
    sides = [_number(about[key], f"{name}: {key}", 1, _arrays.MOST) for key in ("w", "h")]
    if any(side != int(side) for side in sides):
        raise Failure(f"{name}: w, h: must be whole numbers")
    return int(sides[0]), int(sides[1])


def _number(value: Any, name: str, least: float, most: float) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not least <= value <= most:
        raise Failure(f"{name}: must be a number from {least:g} to {most:g}, not {_arrays.text(value)}")
    return float(value)


def _shot(about: Dict[str, Any], frame: Any, name: str, size: Tuple[int, int]) -> Shot:
    if not isinstance(frame, dict):
        raise Failure(f"{name}: must be an object with transform_matrix")
    bent = next((key for key in _DISTORTION if {**about, **frame}.get(key)), None)
    if bent:
        raise Failure(f"{name}: {bent}: distortion of a lens is not drawn; take pictures without it")
    lens = {key: _number(value, f"{name}: {key}", -1e9, 1e9) for key, value in {**about, **frame}.items() if key in _LENS}
    return Shot(*_pose(frame.get("transform_matrix"), f"{name}: transform_matrix"), *_lens(lens, name, size))


def _lens(lens: Dict[str, float], name: str, size: Tuple[int, int]) -> Tuple[float, float, float, float]:
    """Of a picture of that size: the file's lens, scaled."""
    width, height = (_number(lens.get(key, side), f"{name}: {key}", 1, _arrays.MOST) for key, side in zip(("w", "h"), size))
    if width * size[1] != height * size[0]:
        raise Failure(f"{name}: w, h: are {width:g}, {height:g}, which is no scaled {size[0]}, {size[1]}")
    scale = size[0] / width
    fx = lens.get("fl_x") or _from_angle(lens, "camera_angle_x", width, name)
    fy = lens.get("fl_y") or _from_angle(lens, "camera_angle_y", height, name)
    if not (fx or fy):
        raise Failure(f"{name}: fl_x or camera_angle_x: must say what the lens is")
    # A file's (0, 0) is the picture's corner; OpenCV's is the middle of the first pixel.
    cx, cy = lens.get("cx", width / 2) * scale - 0.5, lens.get("cy", height / 2) * scale - 0.5
    return (_number((fx or fy) * scale, f"{name}: fl_x", 1e-6, 1e9),
            _number((fy or fx) * scale, f"{name}: fl_y", 1e-6, 1e9), cx, cy)


def _from_angle(lens: Dict[str, float], key: str, extent: float, name: str) -> float:
    if key not in lens:
        return 0.0
    return focal_length(extent, _number(lens[key], f"{name}: {key}", 1e-4, 3.1) * (180 / math.pi))


def _pose(value: Any, name: str) -> Tuple[Vector, Vector, Vector, Vector]:
    """Right, up, back and place of a camera-to-world matrix."""
    rows = value if isinstance(value, list) and len(value) in (3, 4) else []
    if not rows or any(not isinstance(row, list) or len(row) != 4 for row in rows):
        raise Failure(f"{name}: must be 4 rows of 4 numbers")
    numbers = [[_number(each, name, -1e30, 1e30) for each in row] for row in rows]
    columns = [(numbers[0][c], numbers[1][c], numbers[2][c]) for c in range(4)]
    if not _turns(columns[:3]):
        raise Failure(f"{name}: must turn and move, not scale, shear or mirror")
    return columns[0], columns[1], columns[2], columns[3]


def _turns(axes: Sequence[Vector]) -> bool:
    right, up, back = axes
    cross = (right[1] * up[2] - right[2] * up[1], right[2] * up[0] - right[0] * up[2], right[0] * up[1] - right[1] * up[0])
    pairs = [(a, b, float(a is b)) for a in axes for b in axes]
    return all(abs(_dot(a, b) - wanted) <= 1e-3 for a, b, wanted in pairs) and _dot(cross, back) > 0
