# SPDX-License-Identifier: MIT
"""Models: read from files or made from arrays, and drawn."""

from __future__ import annotations

import os
import threading
import warnings
from dataclasses import dataclass, replace
from typing import Any, Dict, Iterable, List, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from . import _arrays, _look, _rhw, _threads
from ._arrays import Size
from .camera import AXES, Camera, View
from .environment import Environment
from .pictures import OUTPUTS, Pictures, in_file


@dataclass(frozen=True)
class Mesh:
    """One kind of primitive and one material. Arrays are read-only views of the model's memory; None: there are none.

    vertices are in the mesh's own space, which `Node.world` brings into the coordinates of the file. Of a model far from
    the origin they count from a place among them, also where the file's do not.

    vertices (N, 3), normals (N, 3), tangents (N, 4), uv and uv2 (N, 2), colors (N, 4): float32. uv: u right, v down.
    colors: linear RGBA, which multiply the material's. faces (M, 3), of lines (M, 2), of points (M, 1): uint32.
    material: the number of one of Model.materials.
    """

    name: str
    material: int
    vertices: NDArray[Any]
    faces: NDArray[Any]
    normals: Optional[NDArray[Any]]
    tangents: Optional[NDArray[Any]]
    uv: Optional[NDArray[Any]]
    uv2: Optional[NDArray[Any]]
    colors: Optional[NDArray[Any]]


@dataclass(frozen=True)
class Material:
    """Metallic-roughness as glTF 2.0 defines it; other models of shading become that when they are read.

    textures: numbers of Model.images by what they are for: 'base_color', 'metallic_roughness', 'normal', ...
    """

    name: str
    base_color: Tuple[float, float, float, float]
    metallic: float
    roughness: float
    emissive: Tuple[float, float, float]
    alpha_mode: str
    alpha_cutoff: float
    unlit: bool
    double_sided: bool
    textures: Dict[str, int]


@dataclass(frozen=True)
class Image:
    """texels: (H, W, 4) uint8, uint16 or float32. missing: it could not be read, and this stands in its place."""

    name: str
    texels: NDArray[Any]
    missing: bool


@dataclass(frozen=True)
class Node:
    """A mesh in the world. `object` is the number that the output `object` shows; a node whose mesh has several
    materials is here several times with the same one. world: (4, 4) float32 for column vectors; float64 of a model that is far from the
    origin (Model.origin) or has parts far from each other."""

    name: str
    mesh: int
    object: int
    world: NDArray[Any]


@dataclass(frozen=True)
class ModelCamera:
    """A camera of the file, which looks along its own -z with +y up. yfov: radians; zfar 0: infinitely far."""

    name: str
    world: NDArray[Any]
    orthographic: bool
    yfov: float
    aspect: float
    xmag: float
    ymag: float
    znear: float
    zfar: float


@dataclass(frozen=True)
class Light:
    """KHR_lights_punctual. type: 'directional', 'point' or 'spot'; direction: the way the light travels."""

    name: str
    type: str
    position: Tuple[float, float, float]
    direction: Tuple[float, float, float]
    color: Tuple[float, float, float]
    intensity: float
    range: float
    inner_cos: float
    outer_cos: float


@dataclass(frozen=True)
class Animation:
    """A movement that the file has; rhw.load shows a moment of it."""

    name: str
    seconds: float


def _view(memory: Any) -> Optional[NDArray[Any]]:
    return None if memory is None else np.asarray(memory)


def _mesh(about: Dict[str, Any]) -> Mesh:
    names = ("vertices", "faces", "normals", "tangents", "uv", "uv2", "colors")
    arrays: Dict[str, Any] = {name: _view(about[name]) for name in names}
    return Mesh(name=about["name"], material=about["material"], **arrays)


Place = Tuple[float, float, float]


def _moved(place: Sequence[float], origin: Place) -> Place:
    x, y, z = (a + b for a, b in zip(place, origin))
    return x, y, z


def _light(about: Dict[str, Any], origin: Place) -> Light:
    light = Light(**about)
    return replace(light, position=_moved(light.position, origin))


def _placed(about: Dict[str, Any], origin: Place) -> Dict[str, Any]:
    """With the matrix of a node or a camera in the coordinates of the file. `place`, unless 0, is what floats lose of its last column."""
    world, place = np.asarray(about["world"]).T, about["place"]
    if any(origin) or any(place):
        world = world.astype(np.float64)
        world[:3, 3] = np.add(place if any(place) else world[:3, 3], origin)
        world.flags.writeable = False
    return {**{key: each for key, each in about.items() if key != "place"}, "world": world}


class Model:
    """A model, read by `rhw.load` or made here from arrays.

    >>> model = rhw.Model(vertices, faces)                      # (N, 3) and (M, 3) arrays
    >>> model = rhw.Model(vertices, faces, colors=rgb, smooth=False)
    >>> model = rhw.Model(vertices, faces, uv=uv, texture=image, roughness=0.4)
    >>> model = rhw.Model(mesh)                                 # a mesh or a scene of trimesh, or what looks like one
    >>> model.render(400)["depth"]

    vertices: (N, 3) floats, or an object with `vertices` and `faces`, or a scene with `geometry` and `graph`, as
      those of trimesh.
    faces: (M, 3) integers, of triangles whose front is counter-clockwise; (M, 2): of lines; (M, 1): of points. None:
      the vertices are triangles in their order.
    normals: (N, 3). None: they are made, smooth across edges that are not sharp, or flat with smooth=False.
    uv: (N, 2), u right, v down as the rows of an image. texture: (H, W), (H, W, 3) or (H, W, 4) uint8, sRGB.
    colors: (N, 3) or (N, 4), of vertices; face_colors: (M, 3) or (M, 4), of faces. uint8 are sRGB, floats linear, 0 to
      1.
    color: (r, g, b) or (r, g, b, a), linear, of all of it. metallic, roughness: 0 to 1. emissive: (r, g, b). None: what
      the material of a trimesh says; else 0.8 grey, 0, 0.6 and black.
    alpha: 'opaque', 'mask' (below 0.5 is cut out) or 'blend'; None: 'blend' where `color` or `texture` is not opaque.
    double_sided: its back is seen too. unlit: shows its colours as they are.
    up: what is up in the world, 'y', 'z', ...

    Triangle k of `faces` is k + 1 in the output `triangle`. Parts that are far from each other, over a thousand times their
    size, become a node and a mesh each, and count their triangles one after the other. Arrays are copied. A Model may be drawn
    by several threads at once: each draws it in its own context. A pickle of it has all of it, for processes of the same
    version of rhw; read no pickle from elsewhere.

    Attributes, all read-only: meshes, materials, images, nodes, cameras, lights, animations (tuples); variants,
    warnings, unsupported (tuples of str); path, format, unit, up (str); bounds ((2, 3) float32, least and most in the
    world); frame (likewise, of what a fitted picture is about); origin ((x, y, z), 0 unless the model is over 256 times its size away from the file's origin: what is drawn
    is then counted from there, `bounds`, `Node.world` and the output `position` are float64, and all of them stay in the
    coordinates of the file).
    """

    def __init__(self, vertices: Any, faces: Any = None, *, normals: Any = None, uv: Any = None, colors: Any = None,
                 face_colors: Any = None, texture: Any = None, color: Optional[Sequence[float]] = None,
                 metallic: Optional[float] = None, roughness: Optional[float] = None,
                 emissive: Optional[Sequence[float]] = None, alpha: Optional[str] = None,
                 double_sided: bool = True, unlit: bool = False, smooth: bool = True,
                 up: str = "y", name: str = "array"):
        from . import _make  # which knows Model too

        surface = _make.Surface(color=color, metallic=metallic, roughness=roughness, emissive=emissive, alpha=alpha,
                                double_sided=double_sided, unlit=unlit)
        arrays = _make.Arrays(name)
        if isinstance(vertices, (str, bytes)):
            raise TypeError(f"vertices: must be an array, not the path {vertices!r}; rhw.load reads files")
        if hasattr(vertices, "geometry") and hasattr(vertices, "graph"):
            arrays.add_scene(vertices, surface, smooth)
        elif hasattr(vertices, "vertices"):
            arrays.add_trimesh(vertices, surface, smooth, np.eye(4))
        else:
            mesh = _make.Geometry(vertices, faces, normals, uv, colors, face_colors, smooth)
            arrays.add(mesh, surface.textured(texture), np.eye(4), name)
        self._take(arrays.make(_arrays.choice(up, "up", AXES)))

    def _take(self, model: Any) -> None:
        self._model = model
        self._local = threading.local()
        about = _rhw.describe(model)
        self.path: str = about["path"]
        self.format: str = about["format"]
        self.unit: str = about["unit"]
        self.up: str = AXES[about["up"]]
        self.meshes = tuple(map(_mesh, about["meshes"]))
        self.materials = tuple(Material(**each) for each in about["materials"])
        self.images = tuple(Image(each["name"], np.asarray(each["texels"]), each["missing"])
                            for each in about["images"])
        self.origin: Place = about["origin"]
        self.nodes = tuple(Node(**_placed(each, self.origin)) for each in about["nodes"])
        self.cameras = tuple(ModelCamera(**_placed(each, self.origin)) for each in about["cameras"])
        self.lights = tuple(_light(each, self.origin) for each in about["lights"])
        self.animations = tuple(Animation(**each) for each in about["animations"])
        self.variants: Tuple[str, ...] = about["variants"]
        self.warnings: Tuple[str, ...] = about["warnings"]
        self.unsupported: Tuple[str, ...] = about["unsupported"]
        self._bounds = (about["bounds_min"], about["bounds_max"])
        self._frame = (about["frame_min"], about["frame_max"])

    def __reduce__(self) -> Tuple[Any, ...]:
        return _unpickle, (_rhw.version, _rhw.to_bytes(self._model))

    def __copy__(self) -> "Model":
        return self  # nothing of it changes

    def __deepcopy__(self, memo: Dict[int, Any]) -> "Model":
        return self

    @property
    def bounds(self) -> NDArray[Any]:
        """(2, 3) float32: the least and the greatest corner of all nodes, in the world. float64 with an `origin`."""
        return np.array(self._bounds) + self.origin if any(self.origin) else np.array(self._bounds, np.float32)

    @property
    def frame(self) -> NDArray[Any]:
        """The bounds without what nobody can see, and without specks far away: what a fitted picture is about."""
        return np.array(self._frame) + self.origin if any(self.origin) else np.array(self._frame, np.float32)

    def __repr__(self) -> str:
        triangles = sum(len(self.meshes[node.mesh].faces) for node in self.nodes)
        return f"<rhw.Model {self.path!r}: {len(self.nodes)} nodes, {triangles} faces, {len(self.materials)} materials>"

    def render(self, size: Size = (1280, 720), camera: Optional[Camera] = None, *,
               outputs: Union[str, Iterable[str]] = ("color",), samples: int = 4, supersample: int = 1,
               background: Union[str, Sequence[int]] = "default", lights: str = "file", shadows: bool = True,
               ground: bool = False, ambient_occlusion: bool = True, tone: str = "neutral", exposure: float = 0.0,
               transparency: str = "sorted", wireframe: str = "none", interpolate: str = "smooth",
               environment: Union[None, Environment, str, "os.PathLike[str]", NDArray[Any]] = None,
               environment_rotation: float = 0.0, up: Optional[str] = None,
               context: Optional[_rhw.Context] = None) -> Pictures:
        """Draws the model. The arrays hold the numbers that `rhw render` with the same options writes.

        size: (width, height), or one number for both, 1 to 16384.
        camera: see Camera; None: the first one of the file or, where there is none or the model is a dot in it, Camera.fit().
        outputs: names of pictures, see Pictures: 'color', 'depth', 'distance', 'normal', 'position', 'uv', 'object',
          'triangle', 'barycentric', 'linear', 'display'.
        samples: of a pixel, 1, 2, 4, 8 or 16. supersample: pixels that are drawn for one, 1, 4, 9 or 16.
        background: 'default', 'transparent', 'environment', or (r, g, b) of 0 to 255.
        lights: 'file', 'default' (a studio instead of those of the file) or 'none' (its surroundings alone).
        shadows; ground: a shadow below the model; ambient_occlusion.
        tone: 'neutral', 'aces', 'agx' or 'none'. exposure: stops, -20 to 20.
        transparency: 'sorted' or 'exact'. wireframe: 'none', 'over' or 'plain'.
        interpolate: 'smooth', or 'noperspective' to see why one divides by w.
        environment: a panorama that lights the model instead of a studio: an Environment, the path of an .hdr or .exr
          file, or an array as Environment takes it. environment_rotation: degrees about what is up.
        up: where the sky is; None: as the model says.
        context: the threads that draw; None: the calling thread's own.

        The interpreter's lock is released meanwhile; Ctrl-C ends the draw when the tiles under way are done.
        """
        width, height = _arrays.size(size)
        names = _outputs(outputs)
        look = _look.read(samples=samples, supersample=supersample, up=up, interpolate=interpolate, wireframe=wireframe,
                          background=background, lights=lights, shadows=shadows, ground=ground,
                          ambient_occlusion=ambient_occlusion, transparency=transparency, tone=tone, exposure=exposure,
                          environment=environment, environment_rotation=environment_rotation)
        chosen = Camera.fit() if camera is None else camera
        if not isinstance(chosen, Camera):
            raise TypeError(f"camera: must be an rhw.Camera, as rhw.Camera.orbit(30, 20) makes one, not {_arrays.text(camera)}")
        fitted = chosen._resolve(self, width, height)
        seen_by, of_file = self._first_camera(fitted, width, height) if camera is None and self.cameras else (fitted, False)
        scene, threads = self._scene(context)
        drawn, rasterized, origin = _draw(scene, (width, height), seen_by, names, look)
        if rasterized == 0 and of_file:
            warnings.warn(f"{self.path}: its camera sees nothing of the model, which is fitted instead", stacklevel=2)
            seen_by = fitted
            drawn, _, origin = _draw(scene, (width, height), seen_by, names, look)
        elif rasterized == 0:
            warnings.warn(f"{self.path}: nothing of the model is in the picture", stacklevel=2)
        elif camera is not None and _rhw.camera_shows_a_dot(self._model, fitted, width / height):
            warnings.warn(f"{self.path}: next to nothing of the model is in the picture", stacklevel=2)
        arrays = {each: np.asarray(drawn[each]) for each in names}
        from_origin = arrays.get("position") if any(origin) else None
        if from_origin is not None:
            arrays["position"] = in_file(from_origin, origin)
        return Pictures(arrays, (width, height), View(seen_by, width, height), self, look.transparent, threads, origin,
                        from_origin)

    def _first_camera(self, fitted: Tuple[Any, ...], width: int, height: int) -> Tuple[Tuple[Any, ...], bool]:
        """The file's first camera, unless it sees less of the model than a thumbnail would show."""
        numbers = _rhw.camera_of_file(self._model, width / height, 0)
        sight = _rhw.camera_sight(self._model, numbers, width / height)
        if sight == "enough":
            return numbers, True
        warnings.warn(f"{self.path}: its camera sees {sight} of the model, which is fitted instead", stacklevel=3)
        return fitted, False

    def _scene(self, context: Optional[_rhw.Context]) -> Tuple[Any, int]:
        """The model in a context's memory; a thread keeps the last one."""
        wanted = _threads.chosen(context)
        kept = getattr(self._local, "scene", None)
        if kept is None or kept[0] is not wanted:
            self._local.scene = kept = (wanted, _rhw.Scene(wanted, self._model))
        return kept[1], wanted.threads

    def _repr_png_(self) -> bytes:
        return self.render((640, 480)).png()


def _unpickle(version: str, data: bytes) -> Model:
    if version != _rhw.version:
        raise ValueError(f"pickle: the model is of rhw {version}, and here is rhw {_rhw.version}")
    model = Model.__new__(Model)
    model._take(_rhw.from_bytes(data))
    return model


def _draw(scene: _rhw.Scene, size: Tuple[int, int], camera: Tuple[Any, ...], names: List[str],
          look: _look.Look) -> Tuple[Dict[str, Any], int, Tuple[float, float, float]]:
    """Pictures by their names, how many triangles were rasterized, and what positions are counted from."""
    # Beside `display` the colours would be rounded from it, and not be those of the program.
    apart = ["display"] if {"color", "display"} <= set(names) else []
    drawn, rasterized, origin = scene.draw(size, camera, _bits([each for each in names if each not in apart]), *look)
    if apart:
        drawn.update(scene.draw(size, camera, _bits(apart), *look)[0])
    return drawn, rasterized, origin


def _bits(names: List[str]) -> int:
    return sum(OUTPUTS[each] for each in names)


def _outputs(outputs: Union[str, Iterable[str]]) -> List[str]:
    names = [outputs] if isinstance(outputs, str) else _arrays.listed(outputs, "outputs", "names")
    if not names:
        raise ValueError("outputs: there must be one at least of " + ", ".join(OUTPUTS))
    for each in names:
        _arrays.choice(each, "outputs", tuple(OUTPUTS))
    return list(dict.fromkeys(names))


def load(path: Union[str, "os.PathLike[str]"], *, variant: Optional[str] = None,
         animation: Union[None, int, str] = None, time: Optional[float] = None,
         confine: Union[None, str, "os.PathLike[str]"] = None,
         max_seconds: int = 0, max_memory: int = 0, max_texture: int = 0) -> Model:
    """Reads a model: glTF 2, OBJ, PLY, STL, 3MF, FBX and what else `rhw info` reads.

    variant: of the materials, by name. animation, time: a moment of a movement, by name or number, in seconds.
    confine: a folder; nothing outside it is read that the file names.
    max_seconds: of processor time, 0: 60. max_memory: bytes, 0: 3/4 of the machine's, at most 16 GiB.
    max_texture: images are halved until no side is longer; 0: as they are. `rhw render`, which knows the size of its
      picture, halves what that cannot use: its option --max-texture says how far.

    The file is read in a process of its own, so that a hostile one cannot take yours down. What was wrong with it and
    was met is in Model.warnings, what is not drawn in Model.unsupported. rhw.Error where it cannot be read;
    FileNotFoundError where there is none.
    """
    name = _arrays.path(path, "path")
    if variant is not None:
        _arrays.words(variant, "variant")
    if animation is not None and not isinstance(animation, str):
        animation = str(_arrays.whole(animation, "animation", 0, 2**31 - 1))
    moment = 0.0 if time is None else _arrays.number(time, "time", -1e30, 1e30)
    within = None if confine is None else os.fsencode(_arrays.path(confine, "confine"))
    limits = [_arrays.whole(value, limit, 0, most) for value, limit, most in
              ((max_seconds, "max_seconds", 2**31 - 1), (max_memory, "max_memory", 2**63 - 1), (max_texture, "max_texture", _arrays.MOST))]
    if not os.path.lexists(name):
        raise FileNotFoundError(2, "no such file", name)
    posed = animation is not None or time is not None
    model = Model.__new__(Model)
    model._take(_rhw.load(os.fsencode(name), variant, posed, animation, moment, within, *limits))
    if not model.nodes:
        reasons = "; ".join([*model.warnings, *model.unsupported][:3])
        raise _rhw.Error(f"{name}: the file has nothing to draw{': ' if reasons else ''}{reasons}")
    return model
