# SPDX-License-Identifier: MIT
"""What a render gives, and how it becomes files."""

from __future__ import annotations

from typing import Any, Dict, Iterable, List, NamedTuple, Optional, Sequence, Tuple

import numpy as np
from numpy.typing import NDArray

from . import _arrays, _files, _rhw
from .camera import View


class Output(NamedTuple):
    """A row of the table of outputs, scene/draw/output_table.c."""

    name: str
    bit: int
    kind: int  #: the place among the outputs of the program; -1: none
    type: str  #: of the elements, as in `__array_interface__`
    channels: int
    layer: List[str]  #: its channels in an EXR
    meaning: str


_ROWS = [Output(*row) for row in _rhw.outputs]

#: All that is known of each output, by its name.
TABLE = {row.name: row for row in sorted(_ROWS, key=lambda row: row.bit)}

#: Outputs and their bits in the extension.
OUTPUTS = {name: row.bit for name, row in TABLE.items()}

#: Outputs in the order of the program's `--output`.
_FILE_KINDS = tuple(row.name for row in _ROWS if row.kind >= 0)


def in_file(position: NDArray[Any], origin: Sequence[float]) -> NDArray[Any]:
    """Positions that count from a model's origin, in the coordinates of its file: float64, unless these are the same."""
    if not any(origin):
        return position
    moved = position.astype(np.float64)
    moved[..., :3] += np.where(position[..., 3:] > 0, origin, 0)
    return moved


def from_origin(position: NDArray[Any], origin: Sequence[float], drawn: Optional[NDArray[Any]]) -> NDArray[Any]:
    """Back to what was drawn, float32: to the very numbers where they still are what in_file made of them."""
    moved = np.ascontiguousarray(in_file(position, [-each for each in origin]), np.float32)
    if drawn is None or drawn.shape != position.shape:
        return moved
    return np.where(in_file(drawn, origin) == position, drawn, moved)


class Pictures(Dict[str, NDArray[Any]]):
    """The pictures of one render: a dictionary of arrays, rows from top to bottom, on the memory they were drawn to.

    color        (H, W, 4) uint8    what a screen shows: sRGB, straight alpha
    linear       (H, W, 4) float32  light before tone mapping, premultiplied, without background
    display      (H, W, 4) float32  `color` before it is sRGB encoded and rounded
    depth        (H, W)    float32  0 near to 1 far; 1 where nothing is
    distance     (H, W)    float32  along the view, in units of the model; infinity where nothing is
    normal       (H, W, 4) float32  unit, in the world, turned to the viewer; then 1. All 0 where nothing is
    position     (H, W, 4) float32  in the world; then 1. All 0 where nothing is. float64 where that is far from the origin
    uv           (H, W, 4) float32  u, v, 0, 1. All 0 where nothing is
    barycentric  (H, W, 4) float32  weights of the triangle's vertices; then 1. All 0 where nothing is
    object       (H, W)    uint32   `Node.object`; 0 where nothing is
    triangle     (H, W)    uint32   1 + the number of the triangle, nodes in their order; 0 where nothing is

    Outputs from `depth` on show the nearest surface at the middle of the pixel, whatever the number of samples.
    Arrays go to other libraries without a copy: torch.from_numpy(p['depth']), jax.dlpack.from_dlpack(p['depth']).

    size: (width, height). view: the camera, with its matrices. In a notebook the picture shows itself.
    """

    def __init__(self, arrays: Dict[str, NDArray[Any]], size: Tuple[int, int], view: View, model: Any,
                 transparent: bool, threads: int, origin: Sequence[float], from_origin: Optional[NDArray[Any]] = None):
        super().__init__(arrays)
        self.size = size
        self.view = view
        self._model = model
        self._transparent = transparent
        self._threads = threads
        self._origin = tuple(origin)
        self._from_origin = from_origin

    def __missing__(self, output: str) -> NDArray[Any]:
        raise KeyError(f"{output!r} was not drawn; render(outputs=…) says what is: here {', '.join(self)}")

    def png(self, output: str = "color", bits: Optional[int] = None) -> bytes:
        """The bytes of the PNG that `rhw render --output` writes of one output.

        Data has no colours of its own: depths are grey, from white (near) to a tenth (far), by default with 16 bits;
        vectors are scaled to colours, ids scattered over them.

        bits: 8 or 16; None: 16 for depth and distance, else 8. Of `color` 16 bits want the output `display`.
        """
        wanted = 0 if bits is None else _arrays.one_of(bits, "bits", (8, 16))
        return self._png("png", output, wanted)

    def _png(self, name: str, output: str, bits: int) -> bytes:
        kind = _arrays.choice(output, "output", _FILE_KINDS)
        moved = np.subtract(self._model.origin, self._origin)
        low, high = (tuple((each + moved).tolist()) for each in np.array(self._model._bounds, np.float64))
        return _rhw.encode_output(name, self._checked(), self.size, kind, bits, self._transparent, low, high, self._origin)

    def exr(self, outputs: Optional[Iterable[str]] = None) -> bytes:
        """The bytes of the EXR that `rhw render` writes: layers of 32 bits, with the camera and the objects' names.

        outputs: None: all that were drawn. The colour of an EXR is the output `linear`.
        """
        return self._exr("exr", outputs)

    def _exr(self, name: str, outputs: Optional[Iterable[str]]) -> bytes:
        wanted = [output for output in self if output not in ("color", "display")] if outputs is None else outputs
        names = [wanted] if isinstance(wanted, str) else _arrays.listed(wanted, "outputs", "names")
        layers = ["color" if isinstance(output, str) and output == "linear" else output for output in names]
        kinds = 0
        for layer in layers:
            kinds |= 1 << _arrays.choice(layer, "outputs", _FILE_KINDS)
        if not kinds:
            raise ValueError("outputs: an EXR has at least one of linear, " + ", ".join(_FILE_KINDS[1:]))
        return _rhw.encode_exr(name, self._checked(), self.size, kinds, self.view.numbers, self._model._model,
                               self._threads, self._origin)

    def save(self, path: _files.Path, output: str = "color", bits: Optional[int] = None) -> None:
        """Writes a picture. The file appears whole or not at all.

        path: ends in .png, of one output; or in .exr, of all that were drawn.
        """
        name = _arrays.path(path, "path")
        if name.lower().endswith(".exr"):
            _files.write(name, self._exr(_arrays.shown(name), None))
        elif name.lower().endswith(".png"):
            _files.write(name, self.png(output, bits))
        else:
            raise ValueError(f"{name}: must end in .png or .exr")

    def _checked(self) -> Dict[str, NDArray[Any]]:
        arrays = {name: _arrays.packed(_arrays.read(array, name), None) for name, array in self.items() if name in OUTPUTS}
        if "position" in arrays and any(self._origin):
            arrays["position"] = from_origin(arrays["position"], self._origin, self._from_origin)
        return arrays

    def __repr__(self) -> str:
        return f"<rhw.Pictures {self.size[0]} x {self.size[1]}: {', '.join(self)}>"

    def _repr_png_(self) -> Optional[bytes]:
        kinds = [name for name in self if name in _FILE_KINDS]
        output = "color" if "color" in self else kinds[0] if kinds else None
        return None if output is None else self.png(output)


def write_png(path: _files.Path, image: Any, *, srgb: bool = True) -> None:
    """Writes an array as a PNG, as it is. The file appears whole or not at all.

    image: (H, W), (H, W, 1), (H, W, 3) or (H, W, 4), uint8 or uint16; alpha is straight.
    srgb: the file says that its numbers are colours of sRGB; False: that they are numbers.
    """
    array = _arrays.read(image, "image")
    if array.dtype not in (np.uint8, np.uint16):
        raise TypeError(f"image: must be of uint8 or uint16, not {array.dtype}")
    if array.ndim == 2:
        array = array[:, :, None]
    if not _arrays.is_image(array, (1, 3, 4)):
        raise ValueError(f"image: must have the shape (H, W), (H, W, 1), (H, W, 3) or (H, W, 4), of 1 to {_arrays.MOST} rows and "
                         f"columns, not {_arrays.read(image, 'image').shape}")
    name = _arrays.path(path, "path")
    kind = array.dtype.newbyteorder("=")
    _files.write(name, _rhw.encode_png(_arrays.shown(name), _arrays.packed(array, kind), 8 * kind.itemsize, _arrays.flag(srgb, "srgb")))
