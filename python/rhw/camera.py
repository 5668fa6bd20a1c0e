# SPDX-License-Identifier: MIT
"""Where a picture is taken from."""

from __future__ import annotations

import math
from functools import partial
from typing import TYPE_CHECKING, Any, Callable, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from . import _arrays, _rhw

if TYPE_CHECKING:
    from .model import Model

AXES = ("y", "z", "x", "-y", "-z", "-x")  #: what may be up, in the order of the extension

_DEGREE = math.pi / 180


def axis(up: Optional[str]) -> int:
    """The number of an axis; -1, the model's own, for None."""
    return -1 if up is None else _arrays.choice(up, "up", AXES)


def _vector(value: Any, name: str) -> Tuple[float, float, float]:
    return tuple(_arrays.floats(value, name, (3,), np.float64).tolist())  # type: ignore[return-value]


class View:
    """A camera as it takes a certain picture of a certain model.

    view: (4, 4) float64, world to camera, which looks along its -z with y up.
    projection: (4, 4) float64, camera to clip space, whose depth is 0 near and 1 far.
    matrix: projection @ view. All are for column vectors.
    """

    def __init__(self, numbers: Tuple[Any, ...], width: int, height: int):
        self.numbers = numbers
        pair = np.asarray(_rhw.camera_matrices(numbers, width / height))
        self.view = np.ascontiguousarray(pair[0].T)
        self.projection = np.ascontiguousarray(pair[1].T)
        self.matrix = _arrays.product(self.projection, self.view)

    @property
    def eye(self) -> NDArray[Any]:
        """(3,) float64: where the camera stands."""
        return np.array(self.numbers[0])

    @property
    def orthographic(self) -> bool:
        return bool(self.numbers[3])

    @property
    def near(self) -> float:
        """The distance of the near plane along the view."""
        return float(self.numbers[6])

    @property
    def far(self) -> float:
        """The distance of the far plane; infinity where there is none."""
        return float(self.numbers[7]) or math.inf


_Resolve = Callable[["Model", int, int], Tuple[Any, ...]]


class Camera:
    """Where a picture is taken from and through which lens; made by one of the functions below.

    >>> rhw.Camera.fit()                                      # as `rhw render --fit`
    >>> rhw.Camera.orbit(215, 22, margin=12)                  # --orbit 215,22 --margin 12
    >>> rhw.Camera.look_at((3, 2, 5), (0, 0, 0), fovy=40)     # --camera
    >>> rhw.Camera.of_model(0)                                # --camera-index; a string: --camera-name
    >>> rhw.Camera.from_matrix(pose, fovy=40)                 # camera to world, looking along -z, y up
    >>> rhw.Camera.intrinsics(fx, fy, cx, cy, extrinsic)      # as OpenCV means them

    Angles are degrees. Near and far planes lie around the model unless they are given. Cameras can be pickled.
    """

    def __init__(self, resolve: _Resolve, text: str):  # Cameras are pickled, so the function must be one that can be.
        self._resolve = resolve
        self._text = text

    def __repr__(self) -> str:
        return f"rhw.Camera.{self._text}"

    def at(self, model: "Model", size: Union[int, Tuple[int, int]]) -> View:
        """The camera as it takes a picture of that size, (width, height), of the model."""
        if not hasattr(model, "_model"):
            raise TypeError(f"model: must be an rhw.Model, not {_arrays.text(model)}")
        width, height = _arrays.size(size)
        return View(self._resolve(model, width, height), width, height)

    @classmethod
    def fit(cls, *, up: Optional[str] = None, whole: bool = False, fovy: Optional[float] = None, orthographic: bool = False,
            zoom: float = 1.0, margin: Optional[float] = None) -> "Camera":
        """As near as it can be with all of the model in the picture, from the angle that shows it best.

        The options are those of `orbit`.
        """
        return cls._fitted(None, "fit()", up, whole, fovy, orthographic, zoom, margin)

    @classmethod
    def orbit(cls, azimuth: float, elevation: float = 20.0, *, up: Optional[str] = None, whole: bool = False,
              fovy: Optional[float] = None, orthographic: bool = False, zoom: float = 1.0,
              margin: Optional[float] = None) -> "Camera":
        """As near as it can be with all of the model in the picture, from a given angle.

        azimuth, elevation: 0, 0 looks at the model's front; 90, 0 from its left hand side; elevation 90 straight down.
        up: 'y', 'z', 'x', '-y', '-z' or '-x'; None: what the model's format says.
        whole: also what is far from the rest, as a ground or a sky.
        fovy: the angle from the bottom to the top of the picture, 0.01 to 179; None: 30.
        orthographic: without perspective.
        zoom: what is seen is so many times as large, 0.01 to 100.
        margin: percent of the picture that stay free on each side, 0 to 45; None: 4.
        """
        angles = (_arrays.number(azimuth, "azimuth", -1e6, 1e6), _arrays.number(elevation, "elevation", -1e6, 1e6))
        return cls._fitted(angles, f"orbit({angles[0]:g}, {angles[1]:g})", up, whole, fovy, orthographic, zoom, margin)

    @classmethod
    def _fitted(cls, angles: Optional[Tuple[float, float]], text: str, up: Optional[str], whole: bool, fovy: Optional[float],
                orthographic: bool, zoom: float, margin: Optional[float]) -> "Camera":
        degrees = 0.0 if fovy is None else float(np.float32(_arrays.number(fovy, "fovy", 0.01, 179)))
        part = -1.0 if margin is None else _arrays.number(margin, "margin", 0, 45) / 100
        larger = _arrays.number(zoom, "zoom", 0.01, 100)
        number = axis(up)
        options = (angles, number, _arrays.flag(whole, "whole"), degrees, _arrays.flag(orthographic, "orthographic"), larger, part)
        return cls(partial(_fit, options), text)

    @classmethod
    def look_at(cls, eye: Sequence[float], target: Sequence[float], up: Sequence[float] = (0, 1, 0),
                fovy: float = 30.0) -> "Camera":
        """From a point to a point. `up` need not be at a right angle to the view; fovy: 0.01 to 179 degrees."""
        vectors = _vector(eye, "eye"), _vector(target, "target"), _vector(up, "up")
        degrees = _arrays.number(fovy, "fovy", 0.01, 179)
        return cls(partial(_look, (*vectors, degrees)), f"look_at({vectors[0]}, {vectors[1]})")

    @classmethod
    def of_model(cls, which: Union[int, str] = 0) -> "Camera":
        """A camera of the file, by number or name. All of what it frames is in the picture, whatever its shape."""
        return cls(partial(_choose, which), f"of_model({_arrays.text(which)})")

    @classmethod
    def from_matrix(cls, pose: Any, fovy: float = 30.0, *, height: Optional[float] = None,
                    near: Optional[float] = None, far: Optional[float] = None) -> "Camera":
        """From a pose, as glTF, OpenGL, trimesh and pyrender have them.

        pose: (4, 4) or (3, 4), camera to world for column vectors; the camera looks along its -z with y up. Turned and
        moved, not scaled.
        fovy: degrees. height: of the picture in the world, for a camera without perspective, instead of fovy.
        """
        world = _arrays.matrix(pose, "pose")
        _check_turn(world, "pose")
        numbers = _posed(world[:3, 3], -world[:3, 2], world[:3, 1])
        lens = (False, _arrays.number(fovy, "fovy", 0.01, 179) * _DEGREE, 0.0)
        if height is not None:
            lens = (True, 0.0, 0.5 * _arrays.number(height, "height", 1e-30, 1e30))
        return cls(_planes(partial(_posed_lens, (*numbers, *lens, 0.0, 0.0, 1.0, (0.0, 0.0))), near, far), "from_matrix(...)")

    @classmethod
    def intrinsics(cls, fx: float, fy: float, cx: float, cy: float, extrinsic: Any = None, *,
                   near: Optional[float] = None, far: Optional[float] = None) -> "Camera":
        """A camera as OpenCV means it.

        fx, fy, cx, cy: in pixels of the picture that is drawn; (0, 0) is the middle of the pixel at the top left.
        extrinsic: (4, 4) or (3, 4), world to camera for column vectors; x right, y down, z forward. None: the camera
        stands at the origin.
        A point at (X, Y, Z) before the camera is drawn at column fx X / Z + cx, row fy Y / Z + cy.
        """
        fx, fy = _arrays.number(fx, "fx", 1e-6, 1e9), _arrays.number(fy, "fy", 1e-6, 1e9)
        cx, cy = _arrays.number(cx, "cx", -1e9, 1e9), _arrays.number(cy, "cy", -1e9, 1e9)
        view = np.eye(4) if extrinsic is None else _arrays.matrix(extrinsic, "extrinsic")
        _check_turn(view, "extrinsic")
        rows, moved = view[:3, :3].tolist(), view[:3, 3].tolist()
        eye = [-sum(rows[r][c] * moved[r] for r in range(3)) for c in range(3)]
        numbers = _posed(eye, view[2, :3], -view[1, :3])
        return cls(_planes(partial(_opencv_lens, numbers, (fx, fy, cx, cy)), near, far),
                   f"intrinsics({fx:g}, {fy:g}, {cx:g}, {cy:g})")


def _check_turn(matrix: NDArray[Any], name: str) -> None:
    turn = matrix[:3, :3]
    if np.abs(turn @ turn.T - np.eye(3)).max() > 1e-3 or np.linalg.det(turn) < 0:
        raise ValueError(f"{name}: must turn and move, not scale, shear or mirror")
    if np.abs(matrix[3] - (0, 0, 0, 1)).max() > 1e-6:
        raise ValueError(f"{name}: its last row must be 0, 0, 0, 1, not {_arrays.text(matrix[3].tolist())}")


def _posed(eye: Any, ahead: Any, up: Any) -> Tuple[Tuple[float, ...], ...]:
    stands = [float(value) for value in eye]
    return (tuple(stands), tuple(a + float(b) for a, b in zip(stands, ahead)), tuple(float(value) for value in up))


# What cameras take pictures by: the arguments behind the first ones are the model and the size of the picture ----------------

_Lens = Callable[[int, int], Tuple[Any, ...]]


def _fit(options: Tuple[Any, ...], model: "Model", width: int, height: int) -> Tuple[Any, ...]:
    return _rhw.camera_fit(model._model, width / height, *options)


def _look(numbers: Tuple[Any, ...], model: "Model", width: int, height: int) -> Tuple[Any, ...]:
    return _rhw.camera_look(model._model, *numbers)


def _choose(which: Union[int, str], model: "Model", width: int, height: int) -> Tuple[Any, ...]:
    names = [camera.name for camera in model.cameras]
    if isinstance(which, str) and which in names:
        return _rhw.camera_of_file(model._model, width / height, names.index(which))
    if isinstance(which, (int, np.integer)) and 0 <= which < len(names):
        return _rhw.camera_of_file(model._model, width / height, which)
    raise ValueError(f"camera: the model has {len(names)} cameras, and {_arrays.text(which)} is none of them")


def _posed_lens(numbers: Tuple[Any, ...], width: int, height: int) -> Tuple[Any, ...]:
    return numbers


def _opencv_lens(numbers: Tuple[Any, ...], inner: Tuple[float, float, float, float], width: int, height: int) -> Tuple[Any, ...]:
    fx, fy, cx, cy = inner
    # OpenCV counts from the middle of the first pixel, the pipeline from its corner.
    shift = (2 * (cx + 0.5) / width - 1, 1 - 2 * (cy + 0.5) / height)
    return (*numbers, False, _rhw.lens_angle(height, fy), 0.0, 0.0, 0.0, fx / fy, shift)


def _check_planes(given: float, enclosing: float) -> None:
    if given >= enclosing > 0:
        raise ValueError(f"near: must be less than far, {enclosing:g}, not {given:g}")


def _enclose(lens: _Lens, near: Optional[float], far: Optional[float], model: "Model", width: int, height: int) -> Tuple[Any, ...]:
    numbers = list(_rhw.camera_enclose(model._model, lens(width, height)))
    if near is not None:
        numbers[6] = near
    if far is not None:
        numbers[7] = 0.0 if math.isinf(far) else far
    if not numbers[3]:
        _check_planes(numbers[6], numbers[7])
    return tuple(numbers)


def _planes(lens: _Lens, near: Optional[float], far: Optional[float]) -> _Resolve:
    """Puts planes that were not given around the model."""
    if near is not None:
        near = _arrays.number(near, "near", 1e-30, 1e30)
    if far is not None:
        far = _arrays.number(far, "far", 1e-30, math.inf)
    if near is not None and far is not None:
        _check_planes(near, far)
    return partial(_enclose, lens, near, far)
