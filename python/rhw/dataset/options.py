# SPDX-License-Identifier: MIT
"""The options of the command line, and what they ask for."""

from __future__ import annotations

import argparse
import re
import sys
from typing import Any, Callable, Dict, List, NoReturn, Optional, Sequence, Tuple

from .. import _rhw
from .._arrays import MOST
from ..camera import AXES
from . import cameras as views, light, local
from .errors import Mistake
from .plan import FORMATS, Plan, name_models
from .run import How

_USUAL_SIZE = (512, 512)
_USUAL_VIEWS = 24
_MAY_BE_NEGATIVE = ("--elevation", "--center", "--up", "--exposure", "--environment-rotation")

_ABOUT = """Draws models from many places, and writes the pictures with a manifest of cameras, names and hashes.

A run that was ended goes on with the same command. When every view is there, OUT/manifest.json is written."""

_OUTPUTS = """Outputs, each with the formats it may be written in, the usual one first:
""" + "\n".join(f"  {output:<12} {', '.join(forms)}" for output, forms in FORMATS.items()) + """
All outputs in EXR share a file, as those in NPZ do: MODEL/0000.png (color), MODEL/0000.object.png, MODEL/0000.exr,
MODEL/0000.npz. `distance` is what data sets call depth; `depth` is what a depth buffer holds.

Exit status: 0, 1 when the work failed, 2 for a wrong command line."""


class _Parser(argparse.ArgumentParser):
    def error(self, message: str) -> NoReturn:
        raise Mistake(f"{message.removeprefix('argument ')}; see --help")


def _type(read: Callable[[str], Any]) -> Callable[[str], Any]:
    """A type of argparse whose errors are those of `read`."""
    def checked(text: str) -> Any:
        try:
            return read(text)
        except (ValueError, OverflowError) as error:
            raise argparse.ArgumentTypeError(str(error)) from None
    return checked


def _number(least: float, most: float) -> Callable[[str], float]:
    def read(text: str) -> float:
        try:
            found = float(text)
        except ValueError:
            raise ValueError(f"must be a number, not '{text}'") from None
        if not least <= found <= most:
            raise ValueError(f"must lie between {least:g} and {most:g}, not {text}")
        return found
    return _type(read)


def _whole(least: int, most: int) -> Callable[[str], int]:
    def read(text: str) -> int:
        if not re.fullmatch(r"-?\d{1,18}", text) or not least <= int(text) <= most:
            raise ValueError(f"must be a whole number from {least} to {most}, not '{text}'")
        return int(text)
    return _type(read)


def _numbers(count: int, least: float, most: float) -> Callable[[str], Tuple[float, ...]]:
    one = _number(least, most)
    return lambda text: tuple(one(each) for each in _parts(text, count))


def _parts(text: str, count: int) -> List[str]:
    parts = text.split(",")
    if len(parts) != count:
        raise argparse.ArgumentTypeError(f"must be {count} numbers with commas between, not '{text}'")
    return parts


def _range(least: float, most: float) -> Callable[[str], Tuple[float, float]]:
    """LOW,HIGH; a single number is both."""
    one = _number(least, most)

    def read(text: str) -> Tuple[float, float]:
        low, high = [one(each) for each in _parts(text if "," in text else f"{text},{text}", 2)]
        if low > high:
            raise ValueError(f"must have the lower number first, not {text}")
        return low, high
    return _type(read)


@_type
def _size(text: str) -> Tuple[int, int]:
    found = re.fullmatch(r"(\d{1,5})(?:x(\d{1,5}))?", text)
    size = (int(found[1]), int(found[2] or found[1])) if found else (0, 0)
    if not (1 <= size[0] <= MOST and 1 <= size[1] <= MOST):
        raise ValueError(f"must be WIDTHxHEIGHT or one number, of 1 to {MOST}, not '{text}'")
    return size


@_type
def _shard(text: str) -> Tuple[int, int]:
    found = re.fullmatch(r"(\d{1,9})/(\d{1,9})", text)
    if not found or not 1 <= int(found[1]) <= int(found[2]):
        raise ValueError(f"must be NUMBER/COUNT, from 1/COUNT to COUNT/COUNT, not '{text}'")
    return int(found[1]), int(found[2])


@_type
def _background(text: str) -> Any:
    names = {"black": [0, 0, 0], "grey": [128, 128, 128], "white": [255, 255, 255]}
    if text in ("default", "environment", "transparent"):
        return text
    if not re.fullmatch("#?[0-9a-fA-F]{6}", text) and text not in names:
        raise ValueError(f"must be rrggbb in hexadecimal, black, grey, white, environment, transparent or default, not '{text}'")
    return names.get(text) or list(bytes.fromhex(text[-6:]))


@_type
def _outputs(text: str) -> Dict[str, str]:
    found: Dict[str, str] = {}
    for each in text.split(","):
        output, colon, form = each.partition(":")
        if output not in FORMATS:
            raise ValueError(f"'{output}' is not one of {', '.join(FORMATS)}")
        if output in found:
            raise ValueError(f"'{output}' is there twice")
        found[output] = form if colon else FORMATS[output][0]
        if found[output] not in FORMATS[output]:
            raise ValueError(f"'{output}' is written as {' or '.join(FORMATS[output])}, not as '{form}'")
    return {output: found[output] for output in FORMATS if output in found}


@_type
def _switch(text: str) -> bool:
    if text not in ("on", "off"):
        raise ValueError(f"must be on or off, not '{text}'")
    return text == "on"


def _add_cameras(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group("cameras", "spread evenly on a sphere around the middle of each model, or those of a file")
    add = group.add_argument
    add("--views", metavar="N", type=_whole(1, 10**7), help=f"how many; default {_USUAL_VIEWS}")
    add("--elevation", metavar="LOW,HIGH", type=_range(-90, 90), help="degrees above and below the horizon; default -90,90")
    add("--fovy", metavar="DEGREES", type=_number(0.01, 179), help="from the bottom to the top of the picture; default 40")
    add("--radius", metavar="R[,R]", type=_range(1e-3, 1e6),
        help="of the sphere, in multiples of that from which all of the model is in the picture; default 1; two: anything between")
    add("--distance", metavar="D[,D]", type=_range(1e-30, 1e30), help="instead: in the model's units")
    add("--center", metavar="X,Y,Z", type=_numbers(3, -1e30, 1e30), help="instead of the middle of the model's box")
    add("--up", metavar="AXIS", choices=AXES, help="what is up: %(choices)s; default: as the model says")
    add("--jitter", metavar="AMOUNT", type=_number(0, 1), help="0, evenly, to 1, anywhere near; default 0")
    add("--seed", metavar="N", type=_whole(0, 2**53), help="of jitter, and of radii or distances between two; default 0")
    add("--cameras", metavar="FILE", help="instead: the frames of a transforms.json, as NeRF has them; its w and h are the size")


def _add_pictures(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument_group("pictures", "as rhw render makes them with the same options").add_argument
    add("--outputs", metavar="LIST", type=_outputs, default={"color": "png"},
        help="OUTPUT or OUTPUT:FORMAT, with commas between, see below; default color")
    add("--size", metavar="WxH", type=_size, help=f"pixels; default {_USUAL_SIZE[0]}x{_USUAL_SIZE[1]}")
    add("--samples", type=int, choices=(1, 2, 4, 8, 16), default=4, help="of a pixel; default 4")
    add("--supersample", type=int, choices=(1, 4, 9, 16), default=1, help="pixels that are drawn for one; default 1")
    add("--background", metavar="COLOR", type=_background, default="default",
        help="rrggbb, black, grey, white, environment, transparent or default")
    add("--lights", choices=("file", "default", "none"), default="file", help="default file")
    add("--environment", metavar="FILE", help="light by a panorama, .hdr or .exr, instead of the studio")
    add("--environment-rotation", metavar="DEGREES", type=_number(-1e6, 1e6), help="turn it about what is up")
    add("--shadows", metavar="on|off", type=_switch, default=True, help="default on")
    add("--ground", action="store_true", help="a soft shadow below the model")
    add("--ambient-occlusion", metavar="on|off", type=_switch, default=True, help="default on")
    add("--tone-map", choices=("neutral", "aces", "agx", "none"), default="neutral", help="default neutral")
    add("--exposure", metavar="STOPS", type=_number(-20, 20), default=0.0, help="brighter by factors of two; default 0")
    add("--transparency", choices=("sorted", "exact"), default="sorted", help="default sorted")
    add("--variant", metavar="NAME", help="of the materials")
    add("--max-texture", metavar="N", type=_whole(1, MOST), default=0, help="halve textures that are larger")


def _add_run(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument_group("how it is done", "the files are the same").add_argument
    add("-j", "--threads", metavar="N", type=_whole(1, 64),
        help="that draw; default: one for each core, with --scheduler one for each picture")
    add("--scheduler", metavar="ADDRESS", help="let the workers of this Dask scheduler draw, which see OUT and the models as we do")
    add("--shard", metavar="I/N", type=_shard,
        help="draw the I-th of N parts and write no manifest; when all have, a run without --shard writes it")
    add("--strict", action="store_true", help="draw no model that has something which is not drawn as it is meant")
    add("--skip-failed", action="store_true", help="write the manifest without the models that cannot be drawn")
    add("-q", "--quiet", action="store_true", help="no progress, warnings and summary")


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(prog="python -m rhw.dataset", description=_ABOUT, epilog=_OUTPUTS, fromfile_prefix_chars="@",
                     usage="python -m rhw.dataset MODEL... --out OUT [option...]\n"
                           "       python -m rhw.dataset --verify OUT",
                     formatter_class=argparse.RawDescriptionHelpFormatter, allow_abbrev=False)
    parser.add_argument("models", metavar="MODEL", nargs="*", help="files, each with a folder in OUT; @FILE: those that a file "
                        "has lines of")
    parser.add_argument("--out", metavar="OUT", help="a folder: new, or of a run that was ended")
    parser.add_argument("--verify", metavar="OUT", help="compare every file with the manifest, and draw nothing")
    parser.add_argument("--version", action="version", version=f"rhw.dataset {_rhw.version}")
    _add_cameras(parser)
    _add_pictures(parser)
    _add_run(parser)
    return parser


class Asked:
    """What the command line says."""

    def __init__(self, given: argparse.Namespace):
        self._given = given
        self.verify: Optional[str] = given.verify
        self.folder: str = given.out or ""
        self.quiet: bool = given.quiet

    def plan(self) -> Plan:
        given = self._given
        placed, size = self._cameras()
        render = {"samples": given.samples, "supersample": given.supersample, "background": given.background,
                  "lights": given.lights, "shadows": given.shadows, "ground": given.ground,
                  "ambient_occlusion": given.ambient_occlusion, "tone": given.tone_map, "exposure": given.exposure,
                  "transparency": given.transparency, "up": given.up}
        return Plan(name_models(given.models), placed, size, given.outputs,
                    {"variant": given.variant, "max_texture": given.max_texture}, render, self._light())

    def _light(self) -> Optional[light.Light]:
        given = self._given
        return None if given.environment is None else light.find(given.environment, given.environment_rotation or 0.0)

    def _cameras(self) -> Tuple[views.Cameras, Tuple[int, int]]:
        given = self._given
        if given.cameras is not None:
            return views.read_file(given.cameras, given.size, _USUAL_SIZE)
        chosen = {key: getattr(given, key) for key in ("elevation", "fovy", "center", "up", "jitter", "seed")
                  if getattr(given, key) is not None}
        radius = given.distance or given.radius or (1.0, 1.0)
        sphere = views.Sphere(given.views or _USUAL_VIEWS, radius=radius, distance=given.distance is not None, **chosen)
        return sphere, given.size or _USUAL_SIZE

    def how(self) -> How:
        given = self._given
        return How(given.threads or (1 if given.scheduler else local.cores()), given.shard, given.scheduler, given.strict,
                   given.skip_failed, given.quiet)


def _joined(arguments: Sequence[str]) -> List[str]:
    """With `=` before values that begin with a minus, which argparse would take for options."""
    joined: List[str] = []
    for each in arguments:
        if joined and joined[-1] in _MAY_BE_NEGATIVE and re.match(r"-[\d.xyz]", each):
            joined[-1] += "=" + each
        else:
            joined.append(each)
    return joined


def read(arguments: Optional[Sequence[str]]) -> Asked:
    given = _parser().parse_intermixed_args(_joined(sys.argv[1:] if arguments is None else arguments))
    if given.verify is not None:
        if given.models or given.out is not None:
            raise Mistake("--verify OUT: needs no models and no --out")
        return Asked(given)
    if not given.models:
        raise Mistake("no MODEL was given; see --help")
    if not given.out:
        raise Mistake("--out: must say which folder; see --help")
    sphere = ("views", "elevation", "fovy", "radius", "distance", "center", "jitter", "seed")
    needless = next((name for name in sphere if getattr(given, name) is not None), None)
    if given.cameras is not None and needless:
        raise Mistake(f"--{needless}: says nothing beside --cameras")
    if given.radius and given.distance:
        raise Mistake("--radius: says nothing beside --distance")
    if given.environment is None and given.background == "environment":
        raise Mistake("--background: 'environment' needs --environment")
    if given.environment is None and given.environment_rotation is not None:
        raise Mistake("--environment-rotation: needs --environment")
    if given.scheduler and given.shard:
        raise Mistake("--shard: says nothing beside --scheduler, which shares out the work")
    return Asked(given)
