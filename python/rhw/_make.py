# SPDX-License-Identifier: MIT
"""Models from arrays, and from meshes and scenes as trimesh has them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, List, Optional, Sequence, Tuple

import numpy as np
from numpy.typing import NDArray

from . import _arrays, _rhw

_ALPHAS = ("opaque", "mask", "blend")
_PART = 1 << 20  #: faces: between two parts Python looks for signals, and does not within one


def _linear(colors: Any, name: str, rows: int) -> NDArray[Any]:
    """(rows, 4) linear float32 of colours: uint8 are sRGB, alpha is linear."""
    array = _arrays.read(colors, name)
    if array.ndim != 2 or array.shape[0] != rows or array.shape[1] not in (3, 4):
        raise ValueError(f"{name}: must have the shape ({rows}, 3) or ({rows}, 4), not {array.shape}")
    full = np.ones((rows, 4), np.float32)
    if array.dtype == np.uint8:
        full[:, :3] = np.asarray(_rhw.srgb_light())[array[:, :3]]
        if array.shape[1] == 4:
            full[:, 3] = array[:, 3] / np.float32(255)
    else:
        floats = _arrays.floats(array, name, array.shape)
        if floats.size and not 0 <= floats.min() <= floats.max() <= 1:
            worst = floats.min() if floats.min() < 0 else floats.max()
            raise ValueError(f"{name}: must lie between 0 and 1, or be uint8, not {worst:g}")
        full[:, :array.shape[1]] = floats
    return full


def _color(value: Sequence[float], name: str, count: Tuple[int, ...], most: float = np.inf) -> Tuple[float, ...]:
    array = _arrays.read(value, name)
    if array.shape not in [(each,) for each in count]:
        raise ValueError(f"{name}: must have {' or '.join(map(str, count))} numbers, not {_arrays.text(value)}")
    numbers = _arrays.floats(array, name, array.shape).tolist()
    if max(numbers) > most:
        raise ValueError(f"{name}: must lie between 0 and {most:g}, linear light, not {max(numbers):g}")
    if min(numbers) < 0:
        raise ValueError(f"{name}: no number may be negative, not {_arrays.text(value)}")
    return tuple(numbers)


@dataclass(frozen=True)
class Surface:
    """What a material is made of, as Model has it. None: nobody said so."""

    color: Optional[Sequence[float]]
    metallic: Optional[float]
    roughness: Optional[float]
    emissive: Optional[Sequence[float]]
    alpha: Optional[str]
    double_sided: bool
    unlit: bool
    texture: Optional[NDArray[Any]] = None

    def textured(self, texture: Any) -> "Surface":
        return self if texture is None else replace(self, texture=_arrays.texels(texture, "texture"))

    def where_unsaid(self, **values: Any) -> "Surface":
        """With what is None as given here."""
        return replace(self, **{key: value for key, value in values.items() if getattr(self, key) is None})

    def row(self, name: str, image: int) -> Tuple[Any, ...]:
        if self.color is None or self.metallic is None or self.roughness is None or self.emissive is None:
            usual = self.where_unsaid(color=(0.8, 0.8, 0.8), metallic=0.0, roughness=0.6, emissive=(0, 0, 0))
            return usual.row(name, image)
        color = _color(self.color, "color", (3, 4), most=1)
        color = color if len(color) == 4 else color + (1.0,)
        seen_through = color[3] < 1 or (self.texture is not None and bool((self.texture[:, :, 3] < 255).any()))
        alpha = ("blend" if seen_through else "opaque") if self.alpha is None else self.alpha
        return (name, color, _color(self.emissive, "emissive", (3,)),
                _arrays.number(self.metallic, "metallic", 0, 1), _arrays.number(self.roughness, "roughness", 0, 1),
                _arrays.choice(alpha, "alpha", _ALPHAS), 0.5, _arrays.flag(self.unlit, "unlit"),
                _arrays.flag(self.double_sided, "double_sided"), image)


class Geometry:
    """Arrays of one mesh in the shape that the extension takes."""

    def __init__(self, vertices: Any, faces: Any, normals: Any, uv: Any, colors: Any, face_colors: Any, smooth: bool):
        self.smooth = _arrays.flag(smooth, "smooth")
        _arrays.floats(vertices, "vertices", (None, 3))  # numbers that float32 has
        self.vertices = _arrays.floats(vertices, "vertices", (None, 3), np.float64)
        count = len(self.vertices)
        if count == 0:
            raise ValueError("vertices: there are none")
        self.corners = 3
        self.faces: Optional[NDArray[Any]] = None
        if faces is not None:
            faces = _arrays.read(faces, "faces")
            shape = faces.shape
            self.corners = shape[1] if len(shape) == 2 and shape[1] in (1, 2, 3) else 3
            self.faces = _arrays.indices(faces, "faces", (None, self.corners), count)
            if len(self.faces) == 0:
                raise ValueError("faces: there are none")
        elif count % 3:
            raise ValueError(f"faces: without them the vertices must be whole triangles, not {count} vertices")
        self.normals = None if normals is None else _arrays.floats(normals, "normals", (count, 3))
        self.uv = None if uv is None else _arrays.floats(uv, "uv", (count, 2))
        self.colors = None if colors is None else _linear(colors, "colors", count)
        if face_colors is not None:
            self._split(face_colors)

    def _split(self, face_colors: Any) -> None:
        """Gives every corner a vertex of its own, so that a face has one colour."""
        if self.colors is not None:
            raise ValueError("face_colors: there are colors too")
        if self.faces is not None:
            flat = self.faces.reshape(-1)
            if self.normals is None and self.smooth and self.corners == 3:
                self.normals = _smooth_normals(self.vertices, self.faces)
            self.vertices = np.ascontiguousarray(self.vertices[flat])
            self.normals = None if self.normals is None else np.ascontiguousarray(self.normals[flat])
            self.uv = None if self.uv is None else np.ascontiguousarray(self.uv[flat])
            self.faces = np.arange(len(flat), dtype=np.uint32).reshape(-1, self.corners)
        rows = len(self.vertices) // self.corners
        self.colors = np.repeat(_linear(face_colors, "face_colors", rows), self.corners, axis=0)

    def row(self, name: str, material: int) -> Tuple[Any, ...]:
        return (name, self.corners, self.smooth, material, self.vertices, self.normals, self.uv, self.colors,
                self.faces)


def _smooth_normals(vertices: NDArray[Any], faces: NDArray[Any]) -> NDArray[Any]:
    """The mean of the normals around each vertex, by area."""
    # Near the origin as float32 has them, which is what is drawn; far from it, that would be nothing.
    middle, size = np.median(vertices, axis=0), np.ptp(vertices, axis=0).max()
    rounded = vertices if np.abs(middle).max() > 256 * size else vertices.astype(np.float32).astype(np.float64)
    corners = rounded[faces]
    areas = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    sums = np.zeros((len(vertices), 3))
    for corner in range(3):
        for start in range(0, len(faces), _PART):
            np.add.at(sums, faces[start:start + _PART, corner], areas[start:start + _PART])
    lengths = np.sqrt((sums * sums).sum(axis=1, keepdims=True))
    return np.where(lengths > 0, sums / np.where(lengths > 0, lengths, 1), (0, 0, 1)).astype(np.float32)


class Arrays:
    """Meshes, materials, images and instances on their way to the extension."""

    def __init__(self, name: str):
        self._name = _arrays.words(name, "name")
        self._meshes: List[Tuple[Any, ...]] = []
        self._materials: List[Tuple[Any, ...]] = []
        self._images: List[Tuple[Any, ...]] = []
        self._instances: List[Tuple[Any, ...]] = []

    def place(self, mesh: int, world: NDArray[Any], name: str) -> None:
        matrix = np.ascontiguousarray(_arrays.matrix(world, "world").T)
        self._instances.append((name, mesh, matrix))

    def add_mesh(self, geometry: Geometry, surface: Surface, name: str) -> int:
        image = -1
        if surface.texture is not None:
            if geometry.uv is None:
                raise ValueError("texture: needs uv, which say where on it the vertices lie")
            image = len(self._images)
            self._images.append((name, surface.texture))
        self._meshes.append(geometry.row(name, len(self._materials)))
        self._materials.append(surface.row(name, image))
        return len(self._meshes) - 1

    def add(self, geometry: Geometry, surface: Surface, world: NDArray[Any], name: str) -> None:
        self.place(self.add_mesh(geometry, surface, name), world, name)

    def add_trimesh(self, mesh: Any, surface: Surface, smooth: bool, world: NDArray[Any]) -> None:
        geometry, painted = _from_trimesh(mesh, surface, smooth)
        self.add(geometry, painted, world, self._name)

    def add_scene(self, scene: Any, surface: Surface, smooth: bool) -> None:
        numbers = {}
        for name, mesh in scene.geometry.items():
            if hasattr(mesh, "faces"):
                numbers[name] = self.add_mesh(*_from_trimesh(mesh, surface, smooth), str(name))
        for node in scene.graph.nodes_geometry:
            world, name = scene.graph[node]
            if name in numbers:
                self.place(numbers[name], world, str(node))
        if not self._instances:
            raise ValueError("scene: it has no node with a mesh of triangles")

    def make(self, up: int) -> Any:
        return _rhw.make(self._name, up, tuple(self._meshes), tuple(self._materials), tuple(self._images),
                         tuple(self._instances))


def _texture_of(material: Any) -> Optional[NDArray[Any]]:
    for name in ("baseColorTexture", "image"):
        image = getattr(material, name, None)
        if image is not None:
            return np.array(image.convert("RGBA")) if hasattr(image, "convert") else np.asarray(image)
    return None


def _from_trimesh(mesh: Any, surface: Surface, smooth: bool) -> Tuple[Geometry, Surface]:
    visual: Any = getattr(mesh, "visual", None)
    kind = getattr(visual, "kind", None)
    uv = getattr(visual, "uv", None) if kind == "texture" else None
    texture = _texture_of(getattr(visual, "material", None)) if uv is not None else None
    # A cloud of points has no faces.
    faces = mesh.faces if hasattr(mesh, "faces") else np.arange(len(mesh.vertices))[:, None]
    geometry = Geometry(mesh.vertices, faces, None,
                        None if uv is None else np.asarray(uv, np.float64) * (1, -1) + (0, 1),  # its v points up
                        visual.vertex_colors if kind == "vertex" else None,
                        visual.face_colors if kind == "face" else None, smooth)
    if kind == "texture":
        return geometry, _of_material(visual.material, surface, texture is not None).textured(texture)
    return geometry, surface.where_unsaid(color=(1, 1, 1)) if kind in ("vertex", "face") else surface


def _of_material(material: Any, surface: Surface, is_textured: bool) -> Surface:
    """What a material of trimesh says: one by metallic and roughness has what glTF's have, another a colour alone."""
    if not hasattr(material, "baseColorFactor"):
        diffuse = getattr(material, "diffuse", None)
        plain = None if diffuse is None or is_textured else _linear([diffuse], "diffuse", 1)[0].tolist()
        return surface.where_unsaid(color=(1, 1, 1) if is_textured else plain)
    factor = material.baseColorFactor
    color = (1.0, 1.0, 1.0) if factor is None else np.asarray(factor)
    if isinstance(color, np.ndarray) and color.dtype == np.uint8:
        color = color / 255.0  # linear all the same
    said = {"color": color, "metallic": material.metallicFactor, "roughness": material.roughnessFactor,
            "emissive": material.emissiveFactor, "alpha": material.alphaMode and material.alphaMode.lower()}
    usual = {"metallic": 1.0, "roughness": 1.0, "alpha": "opaque"}
    return surface.where_unsaid(**{key: usual.get(key) if value is None else value for key, value in said.items()})
