# SPDX-License-Identifier: MIT
"""Programs of GLSL or SPIR-V, and what a draw or a dispatch gives them by name."""

from __future__ import annotations

import os
import re
import warnings
from typing import Any, Dict, List, Mapping, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from . import _arrays, _blocks, _rhw, _threads
from ._resources import Buffer, Sampler, Texture

_STAGES = ("vertex", "fragment", "compute")
# rhw_shader_resource_kind of the extension.
_UNIFORM_BUFFER, _STORAGE_BUFFER, _SAMPLED_TEXTURE, _TEXTURE, _SAMPLER, _STORAGE_IMAGE, _TEXEL_BUFFER, _ATTACHMENT = range(8)
_MAGIC = (b"\x03\x02\x23\x07", b"\x07\x23\x02\x03")
_PUSH = -1  # the place of the push constants among blocks

#: A shader: GLSL, SPIR-V, or the path of a file with either.
Source = Union[str, bytes, "os.PathLike[str]"]
Key = Union[str, Tuple[int, int]]
#: Values by name, or by (set, binding). The type of keys of a Mapping would have to be exact.
Values = Mapping[Any, Any]


class CompileError(ValueError):
    """A text is no GLSL. Its message is `NAME:LINE: what is wrong`.

    stage: 'vertex', 'fragment' or 'compute'. line: number of the line, from 1, or None where no line is to blame.
    text: that line, or "" where there is none. log: all that the compiler says, a line each.
    """

    def __init__(self, message: str, stage: str, line: Optional[int] = None, text: str = "", log: str = ""):
        super().__init__(message)
        self.stage, self.line, self.text, self.log = stage, line, text, log

    def __reduce__(self) -> Tuple[Any, ...]:
        return CompileError, (str(self), self.stage, self.line, self.text, self.log)


class Variable(NamedTuple):
    """What a stage reads or writes at a location."""
    name: str
    location: int
    component: int
    components: int
    is_integer: bool

    @property
    def key(self) -> str:
        return self.name or str(self.location)


class Resource(NamedTuple):
    """A buffer, image or sampler as a stage has it; rhw/spirv.h has the meaning of each number."""
    kind: int
    set: int
    binding: int
    length: int
    name: str
    size: int
    is_read_only: bool
    type: Any
    is_plain: bool
    is_integer: bool

    @property
    def key(self) -> Key:
        return self.name or (self.set, self.binding)


class _Place(NamedTuple):
    """What a name means: a resource, or the bytes of a block from an offset on."""
    place: int
    offset: int  # -1: the whole


class Program:
    """Shaders of your own, in GLSL 4.50 for Vulkan or in SPIR-V: `vertex` and `fragment`, or `compute` alone.

        >>> program = Program(vertex=text, fragment=other_text)
        >>> pipeline = Pipeline(targets, program=program)
        >>> with Pass(targets) as draw:
        ...     draw(pipeline, {"position": corners}, faces, {"matrix": view.matrix, "albedo": image})

    A source is a text, bytes of SPIR-V, or a pathlib.Path of a file with either. A text without #version is GLSL 4.50.
    A vertex shader alone draws depth. gl_Position has y up and depth 0 to W, as Pipeline has them.
    constants: numbers by their constant_id.
    inputs, outputs: names of what vertices have and of what fragments write, by location; the number of the location
      where the module has no name.
    values: names of what a draw or dispatch has to give: members of uniform blocks and of push constants, textures and
      storage buffers.
    """

    def __init__(self, *, vertex: Optional[Source] = None, fragment: Optional[Source] = None,
                 compute: Optional[Source] = None, constants: Optional[Mapping[int, float]] = None):
        sources = (vertex, fragment, compute)
        if (compute is None) == (vertex is None) or (compute is not None and fragment is not None):
            raise ValueError("vertex: a program has a vertex shader, perhaps with a fragment shader, or a compute shader alone")
        modules = [None if source is None else _module(source, stage, name)
                   for stage, (source, name) in enumerate(zip(sources, _STAGES))]
        codes = _matched(modules)
        self._program = _rhw.Program(codes[0], codes[1], codes[2], _constants(constants))
        stages = [(tuple(Variable(*each) for each in inputs), tuple(Variable(*each) for each in outputs), push)
                  for inputs, outputs, push in self._program.stages]
        self._inputs = stages[0][0] if vertex is not None else ()
        self._outputs = stages[1][1] if fragment is not None else ()
        self._is_compute = compute is not None
        self.inputs: Tuple[str, ...] = tuple(each.key for each in self._inputs)
        self.outputs: Tuple[str, ...] = tuple(each.key for each in self._outputs)
        self._resources: Dict[int, Resource] = {}
        self._blocks: Dict[int, List[_blocks.Type]] = {}
        self._names: Dict[Key, List[_Place]] = {}
        for place, told in self._program.resources:
            self._add_resource(place, Resource(*told))
        for _, _, push in stages:
            if push is not None:
                self._add_block(_PUSH, _blocks.Type(*push), ("push_constants",))
        self.values: Tuple[Key, ...] = tuple(self._wanted())

    def __repr__(self) -> str:
        return f"rhw.pipeline.Program(inputs={self.inputs}, outputs={self.outputs}, values={self.values})"

    def _name(self, key: Key, place: _Place) -> None:
        places = self._names.setdefault(key, [])
        if key != "" and place not in places:
            places.append(place)

    def _add_resource(self, place: int, resource: Resource) -> None:
        known = self._resources.get(place)
        if known is None or known.size < resource.size:
            writes = known is not None and not known.is_read_only
            self._resources[place] = resource._replace(is_read_only=resource.is_read_only and not writes)
        elif not resource.is_read_only:
            self._resources[place] = known._replace(is_read_only=False)
        self._name((resource.set, resource.binding), _Place(place, -1))
        self._name(resource.name, _Place(place, -1))
        if resource.kind == _UNIFORM_BUFFER and resource.length == 1:
            self._add_block(place, _blocks.Type(*resource.type), (resource.name,))
        elif resource.kind == _STORAGE_BUFFER:
            block = _blocks.Type(*resource.type)
            self._name(block.name, _Place(place, -1))
            if len(block.members) == 1:
                self._name(block.members[0][0], _Place(place, -1))

    def _add_block(self, place: int, block: _blocks.Type, names: Sequence[str]) -> None:
        self._blocks.setdefault(place, []).append(block)
        for name in {*names, block.name}:
            self._name(name, _Place(place, -1))
            for member, offset, _ in block.members:
                self._name(f"{name}.{member}", _Place(place, offset))
        for member, offset, _ in block.members:
            self._name(member, _Place(place, offset))

    def _wanted(self) -> List[Key]:
        wanted: Dict[Key, None] = {}
        for place, blocks in self._blocks.items():
            for block in blocks:
                for member, _, _ in block.members:
                    if not member:
                        wanted[self._block_name(place, block)] = None
                        continue
                    alone = len(self._names[member]) == 1
                    wanted[member if alone else f"{self._block_name(place, block)}.{member}"] = None
        for place, resource in self._resources.items():
            if place not in self._blocks:
                alone = len(self._names[resource.key]) == 1
                wanted[resource.key if alone else (resource.set, resource.binding)] = None
        return list(wanted)

    def _block_name(self, place: int, block: _blocks.Type) -> Key:
        return block.name or ("push_constants" if place == _PUSH else self._resources[place].key)

    def _find(self, key: Any) -> _Place:
        try:
            places = self._names.get(key, [])
        except TypeError:
            places = []
        if not places:
            names = ", ".join(map(str, self.values)) or "none"
            raise ValueError(f"values: the program has no {_arrays.text(key)}; its values are {names}")
        if len(places) > 1:
            raise ValueError(f"values: {key} may be one of several; say BLOCK.{key} or (set, binding)")
        return places[0]

    def dispatch(self, groups: Union[int, Sequence[int]], values: Optional[Values] = None, *,
                 context: Optional[_rhw.Context] = None) -> None:
        """Runs the compute shader in so many workgroups: one number, or up to three. Arrays of storage buffers are
        written in place. values: as a draw of Pass has them."""
        if not self._is_compute:
            raise ValueError("program: draws; a program with a compute shader is dispatched")
        counts = list(groups) if isinstance(groups, (tuple, list)) else [groups]
        if not 1 <= len(counts) <= 3:
            raise ValueError(f"groups: must be one to three numbers, not {_arrays.text(groups)}")
        x, y, z = [_arrays.whole(count, "groups", 0, 65535) for count in counts] + [1] * (3 - len(counts))
        chosen = _threads.chosen(context)
        bindings, push = self._bind(values, chosen, ())
        _rhw.dispatch(chosen, self._program, (x, y, z), bindings, push)

    def _bind(self, values: Optional[Values], context: _rhw.Context,
              targets: Sequence[Texture]) -> Tuple[Tuple[Any, ...], NDArray[Any]]:
        """Bindings as the extension takes them, and the bytes of push constants. targets: what must not be read."""
        whole, parts = self._sort(values)
        blocks = {place: self._fill(place, whole.pop(place, None), parts.get(place, {})) for place in self._blocks}
        push = blocks.pop(_PUSH, np.zeros(0, np.uint8))
        bindings: List[Any] = [(place, 0, memory, None) for place, memory in blocks.items() if not isinstance(memory, Buffer)]
        bindings += [(place, 0, memory._resource, None) for place, memory in blocks.items() if isinstance(memory, Buffer)]
        for place, resource in self._resources.items():
            if place in self._blocks:
                continue
            if place not in whole:
                raise ValueError(f"{_text(resource.key)}: missing")
            name, value = whole[place]
            elements = [value] if resource.length == 1 else _arrays.listed(value, name, f"a list of {resource.length}")
            if len(elements) != resource.length:
                raise ValueError(f"{name}: must have {resource.length} elements, not {len(elements)}")
            for i, element in enumerate(elements):
                bindings.append((place, i, *_bound(resource, element, name, context, targets)))
        return tuple(bindings), push

    def _sort(self, values: Optional[Values]) -> Tuple[Dict[int, Tuple[str, Any]], Dict[int, Dict[int, Tuple[str, Any]]]]:
        """Values with their names: by place, and within blocks by offset."""
        whole: Dict[int, Tuple[str, Any]] = {}
        parts: Dict[int, Dict[int, Tuple[str, Any]]] = {}
        if values is not None and not isinstance(values, Mapping):
            raise TypeError(f"values: must be a dictionary, not {_arrays.text(values)}")
        for key, value in (values or {}).items():
            place, offset = self._find(key)
            kept: Dict[int, Tuple[str, Any]] = whole if offset < 0 else parts.setdefault(place, {})
            at = place if offset < 0 else offset
            if at in kept or (offset >= 0 and place in whole) or (offset < 0 and place in parts):
                raise ValueError(f"values: {_text(key)} is given twice")
            kept[at] = _text(key), value
        return whole, parts

    def _fill(self, place: int, whole: Optional[Tuple[str, Any]], parts: Mapping[int, Tuple[str, Any]]) -> Any:
        """The bytes of a block, or a Buffer that has them."""
        blocks = self._blocks[place]
        size = max(block.size for block in blocks)
        if whole is not None and not isinstance(whole[1], Mapping):
            return _raw_block(whole[1], whole[0], size, place == _PUSH)
        memory = np.zeros((size + 3) // 4 * 4, np.uint8)
        for block in blocks:
            if whole is not None:
                _blocks.write(block, whole[1], whole[0], memory, 0)
                continue
            for member, offset, kind in _blocks.members(block):
                if offset not in parts:
                    raise ValueError(f"{member or _text(self._block_name(place, block))}: missing")
                name, value = parts[offset]
                _blocks.write(kind, value, name, memory, offset)
        return memory


def _text(key: Any) -> str:
    return key if isinstance(key, str) else f"set {key[0]}, binding {key[1]}"


def _constants(constants: Optional[Mapping[int, float]]) -> Tuple[Tuple[int, int], ...]:
    """Identifiers and the bits of their numbers."""
    if constants is not None and not isinstance(constants, Mapping):
        raise TypeError(f"constants: must be a dictionary, not {_arrays.text(constants)}")
    pairs = []
    for key, value in (constants or {}).items():
        if isinstance(value, (bool, np.bool_)):
            value = int(value)
        number = _arrays.number(value, "constants", -2**63, 2**64)
        if isinstance(value, (float, np.floating)):
            bits = int(np.array(number, np.float32).view(np.uint32))
        else:
            bits = _arrays.whole(value, "constants", -2**31, 2**32 - 1) & 0xffffffff
        pairs.append((_arrays.whole(key, "constants", 0, 2**32 - 1), bits))
    return tuple(pairs)


# Sources --------------------------------------------------------------------------------------------

class _Module(NamedTuple):
    """SPIR-V of a source."""
    code: bytes
    is_text: bool = False
    is_relaxed: bool = False  # the text is as OpenGL has it


def _matched(modules: Sequence[Optional[_Module]]) -> List[Optional[bytes]]:
    """Codes by stage. What texts as OpenGL has them share has one place."""
    codes = [None if module is None else module.code for module in modules]
    vertex, fragment = modules[0], modules[1]
    if vertex and fragment and vertex.is_text and fragment.is_text:
        codes[:2] = _rhw.match(vertex.code, vertex.is_relaxed, fragment.code, fragment.is_relaxed)
    return codes


def _module(source: Any, stage: int, name: str) -> _Module:
    if isinstance(source, (bytes, bytearray, memoryview)):
        return _Module(bytes(source))
    if isinstance(source, str):
        if "\n" not in source and re.search(r"\.(vert|frag|comp|glsl|spv)$", source):
            raise TypeError(f"{name}: must be a text or a path; pathlib.Path({_arrays.text(source)}) is a path")
        return _compiled(_arrays.words(source, name).encode(), stage, name, False)
    if not isinstance(source, os.PathLike):
        raise TypeError(f"{name}: must be a text of GLSL, bytes of SPIR-V or a path, not {_arrays.text(source)}")
    path = _arrays.path(source, name)
    try:
        with open(path, "rb") as file:
            content = file.read()
    except OSError as error:
        raise _rhw.Error(f"{_arrays.shown(path)}: {error.strerror}") from error
    return _Module(content) if content[:4] in _MAGIC else _compiled(content, stage, path, True)


def _compiled(text: bytes, stage: int, name: str, includes: bool) -> _Module:
    if not _rhw.compiles:
        raise _rhw.Error(f"{_arrays.shown(name)}: this rhw was built without glslang, so it takes SPIR-V alone")
    words, message, log, is_relaxed = _rhw.compile(stage, text, os.fsencode(name), includes)
    if words is None:
        told = _arrays.line(message, 400)
        found = re.match(re.escape(_arrays.shown(name)) + r":(\d+): ", told)
        line = int(found[1]) if found else None
        lines = text.decode("utf-8", "replace").split("\n")
        shown = lines[line - 1].strip() if line and line <= len(lines) else ""
        raise CompileError(told, _STAGES[stage], line, shown, log)
    for warning in log.splitlines():
        warnings.warn(warning, stacklevel=4)
    return _Module(words, True, is_relaxed)


# Values ---------------------------------------------------------------------------------------------

def _raw_block(value: Any, name: str, size: int, is_push: bool) -> Any:
    """The bytes of a whole block that is given as memory: a Buffer, an array, or bytes."""
    array = value.array if isinstance(value, Buffer) else _memory(value, name)
    if array.nbytes < size:
        raise ValueError(f"{name}: must have {size} bytes, not {array.nbytes}")
    if isinstance(value, Buffer) and not is_push:
        return value
    return np.frombuffer(array.tobytes() + bytes(-array.nbytes % 4), np.uint8)


def _memory(value: Any, name: str) -> NDArray[Any]:
    """An array whose memory is to be bound as it is."""
    array = np.frombuffer(value, np.uint8) if isinstance(value, (bytes, bytearray)) else _arrays.read(value, name)
    if array.dtype.hasobject or array.dtype.kind not in "fiuV" or not array.dtype.isnative:
        raise TypeError(f"{name}: must be of numbers, not {array.dtype}")
    if not array.flags.c_contiguous:
        raise ValueError(f"{name}: its elements must lie one behind the other; numpy.ascontiguousarray does that")
    return array


def _storage(resource: Resource, value: Any, name: str) -> Any:
    """A Buffer, or the bytes of an array."""
    array = value.array if isinstance(value, Buffer) else _memory(value, name)
    layout = _blocks.array_of(_blocks.Type(*resource.type))
    if layout and not isinstance(value, (bytes, bytearray)):
        dtype, stride = layout
        if array.dtype != dtype:
            raise TypeError(f"{name}: must be of {dtype}, not {array.dtype}")
        if array.ndim > 1 and array.size // max(len(array), 1) != stride:
            raise ValueError(f"{name}: must have the shape (N, {stride}), as elements stand {stride * dtype.itemsize} bytes "
                             f"apart, not {array.shape}")
    if array.nbytes < resource.size:
        raise ValueError(f"{name}: must have {resource.size} bytes, not {array.nbytes}")
    if isinstance(value, Buffer):
        return value._resource
    return _words(array, name, resource.is_read_only)


def _words(array: NDArray[Any], name: str, is_read_only: bool) -> NDArray[Any]:
    """The bytes of an array, where shaders may read and write whole words."""
    if not is_read_only and not array.flags.writeable:
        raise ValueError(f"{name}: must be writable, as the shader writes to it")
    if array.ctypes.data % 4:
        raise ValueError(f"{name}: its memory must begin at a multiple of 4 bytes")
    return array.reshape(-1).view(np.uint8)


_TEXELS = {("f4", 1): "r32_float", ("f4", 2): "rg32_float", ("f4", 4): "rgba32_float", ("f2", 1): "r16_float",
           ("f2", 4): "rgba16_float", ("u4", 1): "r32_uint", ("u1", 1): "r8_unorm", ("u1", 2): "rg8_unorm",
           ("u1", 4): "rgba8_unorm", ("u2", 1): "r16_unorm", ("u2", 4): "rgba16_unorm"}


def _format_of(array: NDArray[Any], name: str, dimensions: int) -> str:
    """The format of texels whose channels are the last extent, where there is one more than `dimensions`."""
    channels = array.shape[-1] if array.ndim == dimensions + 1 else 1
    form = _TEXELS.get((f"{array.dtype.kind}{array.dtype.itemsize}", channels))
    if array.ndim not in (dimensions, dimensions + 1) or form is None or array.size == 0:
        raise TypeError(f"{name}: there are no texels of {array.dtype} with the shape {array.shape}")
    return form


def _texture(value: Any, name: str, context: _rhw.Context) -> Texture:
    """A texture of an array: bytes are colours in sRGB, other numbers are what they are."""
    array = _arrays.read(value, name)
    if array.dtype == np.uint8:
        return Texture.of(_arrays.texels(array, name), context=context)
    form = _format_of(array, name, 2)
    texture = Texture((array.shape[1], array.shape[0]), form, context=context)
    texture.array[...] = array.reshape(texture.array.shape)
    return texture


def _bound(resource: Resource, value: Any, name: str, context: _rhw.Context,
           targets: Sequence[Texture]) -> Tuple[Any, Any]:
    """(object, other) of a binding, as the extension takes them."""
    if isinstance(value, (Buffer, Texture, Sampler)) and value._context is not context:
        raise ValueError(f"{name}: belongs to another context")
    if resource.kind in (_UNIFORM_BUFFER, _STORAGE_BUFFER):
        return _storage(resource, value, name), None
    if resource.kind == _TEXEL_BUFFER:
        array = value.array if isinstance(value, Buffer) else _memory(value, name)
        form = _format_of(array, name, 1)
        if resource.is_integer != (form == "r32_uint"):
            raise TypeError(f"{name}: must be of {'uint32' if resource.is_integer else 'floats or bytes'}, not {array.dtype}")
        return _words(array, name, resource.is_read_only), _rhw.formats[form]
    if resource.kind == _SAMPLER:
        if not isinstance(value, Sampler):
            raise TypeError(f"{name}: must be a Sampler, not {_arrays.text(value)}")
        return value._resource, None
    if resource.kind == _ATTACHMENT:
        raise ValueError(f"{name}: input attachments are not supported")
    return _bound_texture(resource, value, name, context, targets)


def _bound_texture(resource: Resource, value: Any, name: str, context: _rhw.Context,
                   targets: Sequence[Texture]) -> Tuple[Any, Any]:
    sampler: Any = None
    if isinstance(value, tuple) and len(value) == 2 and isinstance(value[1], Sampler):
        value, sampler = value
    if resource.kind == _STORAGE_IMAGE and not isinstance(value, Texture):
        raise TypeError(f"{name}: must be a Texture, not {_arrays.text(value)}")
    texture = value if isinstance(value, Texture) else _texture(value, name, context)
    if not resource.is_plain:
        raise ValueError(f"{name}: only images of two dimensions are supported, without layers and samples")
    if resource.is_integer != (texture.format == "r32_uint"):
        raise ValueError(f"{name}: must be {'r32_uint' if resource.is_integer else 'of another format than r32_uint'}, as the "
                         f"shader reads {'whole numbers' if resource.is_integer else 'floats'}, not {texture.format}")
    if any(texture is target for target in targets):
        raise ValueError(f"{name}: is a target of the pass")
    for each in (texture, sampler):
        if each is not None and each._context is not context:
            raise ValueError(f"{name}: belongs to another context")
    if resource.kind == _SAMPLED_TEXTURE:
        sampler = sampler or Sampler("nearest" if texture.format == "r32_uint" else "linear", context=context)
        return texture._resource, sampler._resource
    if sampler is not None:
        raise ValueError(f"{name}: has no sampler of its own in the shader")
    return texture._resource, None
