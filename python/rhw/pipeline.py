# SPDX-License-Identifier: MIT
"""The pipeline: buffers, textures, pipelines and passes, for depth maps, id maps and colours of millions of triangles.

    >>> size = 1280, 960
    >>> targets = {"color": Texture(size, "rgba8_srgb"), "triangle": Texture(size, "r32_uint")}
    >>> pipeline = Pipeline(targets, colors="float32")
    >>> positions, faces, colors = Buffer(vertices), Buffer(triangles), Buffer(rgba)
    >>> with Pass(targets, depth=True) as draw:
    ...     draw(pipeline, positions, faces, colors=colors, matrix=view.matrix)
    >>> targets["triangle"].array            # (960, 1280) uint32: no copy

Buffers and textures stand on memory that `.array` shows: what is written there is drawn, what is drawn can be read
there. A pass is recorded between the beginning and the end of its `with`, and drawn at its end; from its beginning on
what it uses is left alone. Where the block is left by an exception nothing is drawn.

Program takes the place of the shaders of this module by your own, in GLSL or SPIR-V, for draws and for computing.
"""

from __future__ import annotations

from types import TracebackType
from typing import Any, Dict, Iterable, List, Mapping, Optional, Sequence, Tuple, Type, Union

import numpy as np
from numpy.typing import NDArray

from . import _arrays, _rhw, _threads
from ._arrays import Size
from ._program import CompileError, Program, Values, Variable
from ._resources import FORMATS, Buffer, Sampler, Texture

__all__ = ["FORMATS", "OUTPUTS", "Buffer", "CompileError", "Pass", "Pipeline", "Program", "Sampler", "Texture"]

#: Outputs in the order of the extension, and the format that a target of each usually has.
OUTPUTS = {"color": "rgba8_srgb", "depth": "r32_float", "distance": "r32_float", "normal": "rgba32_float",
           "position": "rgba32_float", "uv": "rg32_float", "barycentric": "rgba32_float", "object": "r32_uint",
           "triangle": "r32_uint"}

_TOPOLOGIES = ("triangles", "triangle_strip", "triangle_fan", "points", "lines", "line_strip")
_CULLS = ("none", "front", "back")
_COMPARES = ("less", "never", "equal", "less_equal", "greater", "not_equal", "greater_equal", "always")
_INTERPOLATIONS = ("smooth", "noperspective", "flat")

# rhw_vertex_format of the extension: floats by their number of components, and bytes of 0 to 1.
_FLOATS = {1: 0, 2: 1, 3: 2, 4: 3}
_BYTES4 = 11

Targets = Mapping[str, Texture]
Outputs = Union[Mapping[str, Union[str, Texture]], Iterable[str]]


class Pipeline:
    """What becomes of vertices and pixels.

    outputs: what is drawn, in the order of a pass's targets: a dictionary of textures or of names of formats, or
      names alone, whose targets have the usual formats. 'color' (what vertices, texture and draw have, multiplied),
      'depth', 'distance', 'normal', 'position', 'uv', 'barycentric', 'object' (the draw's number), 'triangle' (its
      first_triangle + the number of the triangle in it). Empty: depth alone.
    positions: numbers of each, 3 or 4. colors: None, 'float32' or 'uint8', four of each. uv, normals: whether there
      are.
    texture: draws have one, at uv.
    topology: 'triangles', 'triangle_strip', 'triangle_fan', 'points', 'lines', 'line_strip'.
    cull: 'none', 'front' or 'back'; front is counter-clockwise as seen.
    depth: what a fragment's must be, beside that of the target, to be drawn, 'less', 'greater', ...; None: no test.
    depth_write: whether it is kept then. blend: colours are laid over what is there by their alpha.
    interpolate: 'smooth', 'noperspective' or 'flat' (of each triangle's first vertex).
    program: shaders of your own. `outputs` are then those of its fragment shader, in the order of their locations;
      None: all of them, in rgba8_srgb, or r32_uint of whole numbers. positions, colors, uv, normals,
      texture and interpolate are left out.
    """

    def __init__(self, outputs: Optional[Outputs] = None, *,
                 positions: int = 3, colors: Optional[str] = None, uv: bool = False, normals: bool = False,
                 texture: bool = False, topology: str = "triangles", cull: str = "none", depth: Optional[str] = "less",
                 depth_write: bool = True, blend: bool = False, interpolate: str = "smooth",
                 program: Optional[Program] = None, context: Optional[_rhw.Context] = None):
        self.program = program
        shape = _arrays.choice(topology, "topology", _TOPOLOGIES)
        self._corners = {"triangles": 3, "lines": 2}.get(topology, 1)
        self._context = _threads.chosen(context)
        fixed = (shape, _arrays.choice(cull, "cull", _CULLS), depth is not None,
                 0 if depth is None else _arrays.choice(depth, "depth", _COMPARES),
                 _arrays.flag(depth_write, "depth_write"), _arrays.flag(blend, "blend"))
        if program is not None:
            if (positions, colors, uv, normals, texture, interpolate) != (3, None, False, False, False, "smooth"):
                raise ValueError("program: says itself what positions, colors, uv, normals, texture and interpolate say")
            self._use_program(program, outputs, fixed)
            return
        self.outputs: Dict[str, str] = _formats_of(("color",) if outputs is None else outputs, "outputs")
        uv, normals, texture = (_arrays.flag(value, name) for value, name in (
            (uv, "uv"), (normals, "normals"), (texture, "texture")))
        if not uv and (texture or "uv" in self.outputs):
            raise ValueError("uv: needed by " + ("texture" if texture else "the output uv"))
        if not normals and "normal" in self.outputs:
            raise ValueError("normals: needed by the output normal")
        if blend and self.outputs.get("color") == "r32_uint":
            raise ValueError("blend: not into integers")
        #: What draws must give: columns and NumPy's type.
        self._attributes = _attributes(positions, colors, uv, normals)
        self._textured = texture
        names = tuple(OUTPUTS)
        self._resource = _rhw.pipeline(
            self._context, _kinds(self._attributes), texture, _arrays.choice(interpolate, "interpolate", _INTERPOLATIONS),
            *fixed, tuple((names.index(name), _rhw.formats[each]) for name, each in self.outputs.items()))

    def _use_program(self, program: Program, outputs: Optional[Outputs], fixed: Tuple[int, int, bool, int, bool, bool]) -> None:
        if not isinstance(program, Program):
            raise TypeError(f"program: must be a Program, not {_arrays.text(program)}")
        if program._is_compute:
            raise ValueError("program: computes; Program.dispatch runs it")
        self.outputs = _formats_of_program(program, outputs)
        self._attributes = {}
        self._textured = False
        self._resource = _rhw.program_pipeline(self._context, program._program, *fixed,
                                               tuple(_rhw.formats[form] for form in self.outputs.values()))


def _attributes(positions: Any, colors: Any, uv: bool, normals: bool) -> Dict[str, Tuple[int, Any]]:
    found: Dict[str, Tuple[int, Any]] = {"positions": (_arrays.one_of(positions, "positions", (3, 4)), np.float32)}
    if colors is not None:
        _arrays.choice(colors, "colors", ("float32", "uint8"))
        found["colors"] = (4, np.dtype(colors).type)
    if uv:
        found["uv"] = (2, np.float32)
    if normals:
        found["normals"] = (3, np.float32)
    return found


def _kinds(attributes: Dict[str, Tuple[int, Any]]) -> Tuple[int, int, int, int]:
    """Formats of vertices by the extension's numbers; -1 where there is no such attribute."""
    def kind(name: str) -> int:
        columns, dtype = attributes.get(name, (0, None))
        return -1 if dtype is None else _FLOATS[columns] if dtype is np.float32 else _BYTES4

    return kind("positions"), kind("colors"), kind("uv"), kind("normals")


def _pairs(outputs: Any, argument: str) -> List[Tuple[Any, Any]]:
    if isinstance(outputs, Mapping):
        return list(outputs.items())
    return [(name, None) for name in ([outputs] if isinstance(outputs, str) else _arrays.listed(outputs, argument, "names"))]


def _formats_of_program(program: Program, outputs: Any) -> Dict[str, str]:
    pairs = _pairs(program.outputs if outputs is None else outputs, "outputs")
    names = [name for name, _ in pairs]
    if len(names) != len(program.outputs) or any(
            not isinstance(name, str) or (one.name and name != one.name) for name, one in zip(names, program._outputs)):
        wanted = ", ".join(program.outputs) or "none"
        raise ValueError(f"outputs: must be those of the fragment shader by location, {wanted}, not {_arrays.text(names)}")
    found = {}
    for (name, wanted), output in zip(pairs, program._outputs):
        usual = "r32_uint" if output.is_integer else "rgba8_srgb"
        form = wanted.format if isinstance(wanted, Texture) else usual if wanted is None else wanted
        _arrays.choice(form, "outputs", tuple(FORMATS))
        if (form == "r32_uint") != output.is_integer or form == "d32_float":
            raise ValueError(f"outputs: {name} cannot be drawn into {form}")
        found[name] = form
    return found


def _formats_of(outputs: Any, argument: str) -> Dict[str, str]:
    found = {}
    for name, wanted in _pairs(outputs, argument):
        _arrays.choice(name, argument, tuple(OUTPUTS))
        form = wanted.format if isinstance(wanted, Texture) else OUTPUTS[name] if wanted is None else wanted
        _arrays.choice(form, argument, tuple(FORMATS))
        if (form == "r32_uint") != (OUTPUTS[name] == "r32_uint") or form == "d32_float":
            raise ValueError(f"{argument}: {name} cannot be drawn into {form}")
        found[name] = form
    return found


_Clear = Union[float, Sequence[float]]
_WHITE: Tuple[float, ...] = (1, 1, 1, 1)


class Pass:
    """Draws into textures, as a context manager that is called for each draw.

    targets: textures by the output that is drawn into them, in the order of the pipelines' outputs; with programs, by the
      names or locations of what their fragment shaders write.
    depth: True: one that nobody keeps; a texture of d32_float: that one; False: none.
    clear: by output, what a target is cleared to before: one number, or as many as it has channels, linear; 0. Of
      'depth_test': the depth, 1. What is not named is cleared too; load: True keeps what is there.
    samples: of a pixel, 1, 2, 4, 8 or 16; targets get their mean, and of integers the first.
    size: of the picture where there is no target, (width, height).
    keep: run() draws it all again after the end, without recording it: what buffers, textures and arrays that a shader
      reads in place have by then. Matrices, colours and other numbers stay what they were, as do arrays that a draw made
      buffers of.
    stats: after the end, how many triangles came in, how many were rasterized, how many fragments shaded.
    """

    def __init__(self, targets: Optional[Targets] = None, *, depth: Union[bool, Texture] = False,
                 clear: Optional[Mapping[str, _Clear]] = None, load: bool = False, samples: int = 1,
                 size: Optional[Size] = None, keep: bool = False, context: Optional[_rhw.Context] = None):
        targets, clear = _dictionary(targets, "targets"), _dictionary(clear, "clear")
        if not isinstance(depth, Texture):
            depth = _arrays.flag(depth, "depth")
        load = _arrays.flag(load, "load")
        textures = _textures_of(targets, depth)
        _arrays.one_of(samples, "samples", (1, 2, 4, 8, 16))
        for name in clear:
            _arrays.choice(name, "clear", (*targets, "depth_test"))
        for name in targets:
            if not isinstance(name, str):
                raise TypeError(f"targets: must be named by texts, not {_arrays.text(name)}")
        self.formats = {name: texture.format for name, texture in targets.items()}
        self._targets = textures
        self.stats: Dict[str, int] = {}
        if not textures and size is None:
            raise ValueError("size: must be given where there are no targets")
        self._size = textures[0].size if textures else _arrays.size(size)
        self._context = textures[0]._context if textures and context is None else _threads.chosen(context)
        colors = tuple((texture._resource, load, *_clear_of(clear.get(name, 0), name, texture.format))
                       for name, texture in targets.items())
        far, = _arrays.floats([clear.get("depth_test", 1.0)], "clear", (1,)).tolist()
        if not 0 <= far <= 1:
            raise ValueError(f"clear: depth_test must lie between 0 and 1, not {far}")
        held = depth._resource if isinstance(depth, Texture) else None
        self._def = (self._context, self._size, samples, colors, depth is not False, held, load and held is not None,
                     far, _arrays.flag(keep, "keep"))
        self._pass: Any = None

    def __enter__(self) -> "Pass":
        self._pass = _rhw.Pass(*self._def)
        return self

    def __exit__(self, kind: Optional[Type[BaseException]], error: Optional[BaseException],
                 trace: Optional[TracebackType]) -> None:
        if kind is None:
            self.stats = self._recorded().end()
        else:
            self._recorded().cancel()

    def run(self) -> None:
        """Draws all of it again, after the end of a pass with `keep`; see there."""
        if self._pass is None:
            raise ValueError("the pass cannot be run again: it was never drawn")
        self.stats = self._pass.run()

    def viewport(self, x: float, y: float, width: float, height: float) -> None:
        """Where -1..1 goes from now on: pixels from the top left. With a negative height from the lower left, turned over."""
        corner = [_arrays.number(value, name, -1e9, 1e9) for value, name in ((x, "x"), (y, "y"), (width, "width"), (height, "height"))]
        self._recorded().viewport(*corner)

    def _recorded(self) -> Any:
        if self._pass is None:
            raise ValueError("the pass is recorded within its `with` alone")
        return self._pass

    def __call__(self, pipeline: Pipeline, positions: Any, faces: Any = None, values: Optional[Values] = None, *,
                 colors: Any = None, uv: Any = None, normals: Any = None, matrix: Any = None, world: Any = None,
                 color: Sequence[float] = _WHITE, texture: Optional[Texture] = None,
                 sampler: Optional[Sampler] = None, object: int = 1, first_triangle: int = 1, instances: int = 1) -> None:
        """Records a draw.

        positions: (N, 3) or (N, 4) float32; colors: (N, 4) float32, or uint8 of 0 to 1 linear; uv: (N, 2) float32;
        normals: (N, 3) float32, of any length. faces: (M, 3) uint32, (M, 2) of lines, (M, 1) of points; None: the
        vertices in their order. Arrays become buffers for this draw, and what is in them is checked; a Buffer of your
        own is used as it is: an index beyond the vertices reads zeros, and a triangle with a position that is no number
        is not drawn.
        matrix: (4, 4), world to clip space for column vectors, as View.matrix; clip space has y up and depth 0 to W.
        None: positions are clip coordinates already.
        world: (4, 4), positions and normals to the world. color: (r, g, b, a), which multiplies.
        object: the number for the output `object`; first_triangle: that of the first triangle for `triangle`.

        With a program, positions are all that its vertices have, arrays or Buffers by name, or how many vertices there
        are where they have nothing; values are what it wants by name, or by (set, binding). Members of uniform blocks and
        push constants are numbers, vectors and (rows, columns) matrices, structs are dictionaries; MEMBER, BLOCK.MEMBER
        or a whole BLOCK. Textures are a Texture, an array (bytes are colours in sRGB), or either with a Sampler in a
        tuple. Storage buffers are a Buffer, or an array whose memory the shader reads and writes in place, up to the end
        of the pass. instances: how often all is drawn, for gl_InstanceIndex.
        """
        recorded = self._recorded()
        for value, name, kind in ((pipeline, "pipeline", Pipeline), (texture, "texture", Texture), (sampler, "sampler", Sampler)):
            if not isinstance(value, kind) and (value is not None or kind is Pipeline):
                raise TypeError(f"{name}: must be a {kind.__name__}, not {_arrays.text(value)}")
        if self.formats != pipeline.outputs or list(self.formats) != list(pipeline.outputs):
            raise ValueError(f"pipeline: draws {pipeline.outputs}, the targets are {self.formats}")
        if pipeline.program is not None:
            others = {"colors": colors, "uv": uv, "normals": normals, "matrix": matrix, "world": world, "texture": texture,
                      "sampler": sampler, "color": None if color is _WHITE else color,
                      "object": None if object == 1 else object, "first_triangle": None if first_triangle == 1 else first_triangle}
            for name, other in others.items():
                if other is not None:
                    raise ValueError(f"{name}: a program takes it from values")
            self._draw_program(pipeline, pipeline.program, positions, faces, values, instances)
            return
        if values is not None or instances != 1:
            raise ValueError("values, instances: are for pipelines with a program")
        given = {"positions": positions, "colors": colors, "uv": uv, "normals": normals}
        buffers = self._attributes(pipeline, given)
        count, indices = self._faces(pipeline, faces, len(buffers[0]))
        if pipeline._textured != (texture is not None):
            raise ValueError("texture: " + ("missing" if texture is None else "the pipeline has none"))
        if texture is not None and sampler is None:
            sampler = Sampler(context=self._context)
        numbers = [_arrays.whole(value, name, 0, 2**32 - 1)
                   for value, name in ((object, "object"), (first_triangle, "first_triangle"))]
        recorded.draw(pipeline._resource, tuple(each._resource for each in buffers),
                      None if indices is None else indices._resource, count,
                      None if texture is None else texture._resource, None if sampler is None else sampler._resource,
                      _matrices(matrix, world, color), *numbers)

    def _draw_program(self, pipeline: Pipeline, program: Program, positions: Any, faces: Any, values: Optional[Values],
                      instances: Any) -> None:
        buffers = self._inputs(program, positions)
        vertices = len(buffers[0]) if buffers else _arrays.whole(positions, "positions", 0, 2**26)
        count, indices = self._faces(pipeline, faces, vertices)
        bindings, push = program._bind(values, self._context, self._targets)
        self._recorded().draw_program(program._program, pipeline._resource, tuple(each._resource for each in buffers),
                                      None if indices is None else indices._resource, count,
                                      _arrays.whole(instances, "instances", 1, 2**20), bindings, push)

    def _inputs(self, program: Program, positions: Any) -> List[Buffer]:
        """Buffers in the order of the program's inputs."""
        if not program._inputs:
            if isinstance(positions, Mapping):
                raise ValueError("positions: must be how many vertices there are, as the vertex shader reads nothing of them")
            return []
        if not isinstance(positions, Mapping):
            raise TypeError(f"positions: must be a dictionary of {', '.join(program.inputs)}, not {_arrays.text(positions)}")
        for name in positions:
            _arrays.choice(name, "positions", program.inputs)
        buffers: List[Buffer] = []
        for wanted in program._inputs:
            name = wanted.key
            if name not in positions:
                raise ValueError(f"{name}: missing; the vertex shader reads it")
            buffer = self._input(wanted, positions[name], name)
            self._check_context(buffer, name)
            if buffers and len(buffer) != len(buffers[0]):
                raise ValueError(f"{name}: must be as many as {program.inputs[0]}, {len(buffers[0])}, not {len(buffer)}")
            buffers.append(buffer)
        return buffers

    def _input(self, wanted: Variable, value: Any, name: str) -> Buffer:
        if isinstance(value, Buffer):
            buffer = value
        else:
            array = _arrays.read(value, name)
            whole = np.dtype(np.uint32 if array.dtype.kind == "u" else np.int32)
            buffer = Buffer(_arrays.converted(_number_array(array, name), name, whole) if wanted.is_integer
                            else _typed(array, name, np.float32), context=self._context)
        array = buffer.array
        kinds = (np.uint32, np.int32) if wanted.is_integer else (np.float32,)
        shapes = ((len(array), wanted.components), (len(array),) if wanted.components == 1 else ())
        if array.shape not in shapes or array.dtype not in kinds:
            raise ValueError(f"{name}: must have the shape (N, {wanted.components}) and be of "
                             f"{' or '.join(kind.__name__ for kind in kinds)}, not {array.shape} of {array.dtype}")
        return buffer

    def _check_context(self, buffer: Buffer, name: str) -> None:
        if buffer._context is not self._context:
            raise ValueError(f"{name}: belongs to another context")

    def _attributes(self, pipeline: Pipeline, given: Mapping[str, Any]) -> Sequence[Buffer]:
        buffers: List[Buffer] = []
        for name, value in given.items():
            wanted = pipeline._attributes.get(name)
            if wanted is None or value is None:
                if wanted is not None:
                    raise ValueError(f"{name}: missing; the pipeline reads them")
                if value is not None:
                    raise ValueError(f"{name}: the pipeline does not read them")
                continue
            buffer = value
            if not isinstance(value, Buffer):
                buffer = Buffer(_typed(value, name, wanted[1]), context=self._context)
            array = buffer.array
            if array.ndim != 2 or array.shape[1] != wanted[0] or array.dtype != wanted[1]:
                raise ValueError(f"{name}: must have the shape (N, {wanted[0]}) and be of {np.dtype(wanted[1])}, "
                                 f"not {array.shape} of {array.dtype}")
            self._check_context(buffer, name)
            if buffers and len(buffer) != len(buffers[0]):
                raise ValueError(f"{name}: must be as many as positions, {len(buffers[0])}, not {len(buffer)}")
            buffers.append(buffer)
        return buffers

    def _faces(self, pipeline: Pipeline, faces: Any, vertices: int) -> Tuple[int, Optional[Buffer]]:
        if faces is None:
            return vertices, None
        if not isinstance(faces, Buffer):
            array = _arrays.read(faces, "faces")
            if array.size == 0:
                raise ValueError("faces: there are none")
            faces = Buffer(_arrays.indices(array, "faces", (None,) * array.ndim, vertices), context=self._context)
        self._check_context(faces, "faces")
        array = faces.array
        if array.dtype != np.uint32:
            raise ValueError(f"faces: must be of uint32, not {array.dtype}")
        if array.size % pipeline._corners:
            raise ValueError(f"faces: must be a multiple of {pipeline._corners} indices, not {array.size}")
        return array.size, faces


def _number_array(array: NDArray[Any], name: str) -> NDArray[Any]:
    if array.dtype.kind not in "fiu":
        raise TypeError(f"{name}: must be of whole numbers, not {array.dtype}")
    return array


def _typed(value: Any, name: str, kind: Any) -> NDArray[Any]:
    array = _arrays.read(value, name)
    if array.dtype.kind not in "fiu" or (kind is np.uint8 and array.dtype != np.uint8):
        raise TypeError(f"{name}: must be of {np.dtype(kind)}, not {array.dtype}")
    if array.size == 0:
        raise ValueError(f"{name}: there are none")
    with np.errstate(over="ignore"):
        return _arrays.finite(_arrays.packed(array, kind), name)


def _dictionary(value: Any, name: str) -> Dict[Any, Any]:
    if value is None:
        return {}
    if not isinstance(value, Mapping):
        raise TypeError(f"{name}: must be a dictionary, not {_arrays.text(value)}")
    return dict(value)


def _textures_of(targets: Dict[str, Any], depth: Union[bool, Texture]) -> List[Texture]:
    """All that a pass draws into: textures, of one size."""
    textures = list(targets.values()) + ([depth] if isinstance(depth, Texture) else [])
    for texture in textures:
        if not isinstance(texture, Texture):
            raise TypeError(f"targets: must be textures, not {type(texture).__name__}")
        if texture.size != textures[0].size:
            raise ValueError(f"targets: must be of one size, not {textures[0].size} and {texture.size}")
    if isinstance(depth, Texture) and depth.format != "d32_float":
        raise ValueError(f"depth: must be a texture of d32_float, not {depth.format}")
    return textures


def _clear_of(value: _Clear, name: str, form: str) -> Tuple[Tuple[float, ...], bool]:
    channels = FORMATS[form][0]
    array = np.atleast_1d(_arrays.read(value, "clear"))
    if array.dtype.kind not in "fiu" or array.ndim != 1 or len(array) not in (1, channels) or np.isnan(array).any():
        raise ValueError(f"clear: {name} must be one number or {channels}, not {_arrays.text(value)}")
    numbers = array.astype(np.float64).tolist() * (channels if len(array) == 1 else 1)
    is_integer = form == "r32_uint"
    if is_integer and not (0 <= numbers[0] < 2**32 and numbers[0] == int(numbers[0])):
        raise ValueError(f"clear: {name} must be a whole number of 0 to 4294967295, not {_arrays.text(value)}")
    return tuple(numbers + [0.0] * (4 - channels)), is_integer


def _matrices(matrix: Any, world: Any, color: Sequence[float]) -> NDArray[Any]:
    """45 floats: positions to clip space and to the world, normals to the world, column by column, and the colour."""
    clip = np.eye(4) if matrix is None else _arrays.matrix(matrix, "matrix")
    place = np.eye(4) if world is None else _arrays.matrix(world, "world")
    both = _arrays.product(clip, place)
    a, b, c = place[:3, 0], place[:3, 1], place[:3, 2]
    cofactors = np.stack([_cross(b, c), _cross(c, a), _cross(a, b)])
    if sum((a * cofactors[0]).tolist()) < 0:  # it mirrors
        cofactors = -cofactors
    tint = _arrays.floats(color, "color", (4,))
    with np.errstate(over="ignore"):
        numbers = np.concatenate([both.T.reshape(-1), place.T.reshape(-1), cofactors.reshape(-1), tint]).astype(np.float32)
    return _arrays.finite(numbers, "matrix" if world is None else "matrix, world")


def _cross(a: NDArray[Any], b: NDArray[Any]) -> NDArray[Any]:
    product: NDArray[Any] = a[[1, 2, 0]] * b[[2, 0, 1]] - a[[2, 0, 1]] * b[[1, 2, 0]]
    return product
