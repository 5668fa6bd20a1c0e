# SPDX-License-Identifier: MIT
"""How a picture looks: what Model.render chooses from, as the numbers of the extension."""

from __future__ import annotations

from typing import Any, NamedTuple, Optional, Sequence, Tuple, Union

from . import _arrays, environment as environments
from .camera import axis

# In the order of the extension.
_TONES = ("neutral", "aces", "agx", "none")
_LIGHTS = ("file", "default", "none")
_TRANSPARENCIES = ("sorted", "exact")
_WIREFRAMES = ("none", "over", "plain")
_INTERPOLATIONS = ("smooth", "noperspective")
_BACKGROUNDS = {"default": 0, "environment": 2, "transparent": 3}
_ONE_COLOR = 1


class Look(NamedTuple):
    """The arguments of the extension's Scene.draw behind size, camera and outputs."""

    samples: int
    supersample: int
    up: int
    interpolate: int
    wireframe: int
    background: int
    color: Tuple[int, int, int]
    lights: int
    shadows: bool
    ground: bool
    ambient_occlusion: bool
    transparency: int
    tone: int
    exposure: float
    light: Optional[Any]
    rotation: float

    @property
    def transparent(self) -> bool:
        return self.background == _BACKGROUNDS["transparent"]


def read(*, samples: Any, supersample: Any, up: Any, interpolate: Any, wireframe: Any, background: Any, lights: Any, shadows: Any,
         ground: Any, ambient_occlusion: Any, transparency: Any, tone: Any, exposure: Any, environment: Any,
         environment_rotation: Any) -> Look:
    """The arguments of Model.render with these names."""
    kind, color = _background(background)
    light = environments.chosen(environment)
    if kind == _BACKGROUNDS["environment"] and light is None:
        raise ValueError("background: 'environment' needs an environment")
    return Look(samples=_arrays.one_of(samples, "samples", (1, 2, 4, 8, 16)),
                supersample=_arrays.one_of(supersample, "supersample", (1, 4, 9, 16)),
                up=axis(up),
                interpolate=_arrays.choice(interpolate, "interpolate", _INTERPOLATIONS),
                wireframe=_arrays.choice(wireframe, "wireframe", _WIREFRAMES),
                background=kind, color=color,
                lights=_arrays.choice(lights, "lights", _LIGHTS),
                shadows=_arrays.flag(shadows, "shadows"),
                ground=_arrays.flag(ground, "ground"),
                ambient_occlusion=_arrays.flag(ambient_occlusion, "ambient_occlusion"),
                transparency=_arrays.choice(transparency, "transparency", _TRANSPARENCIES),
                tone=_arrays.choice(tone, "tone", _TONES),
                exposure=_arrays.number(exposure, "exposure", -20, 20),
                light=light,
                rotation=_arrays.number(environment_rotation, "environment_rotation", -1e6, 1e6))


def _background(background: Union[str, Sequence[int]]) -> Tuple[int, Tuple[int, int, int]]:
    if isinstance(background, str):
        _arrays.choice(background, "background", tuple(_BACKGROUNDS))
        return _BACKGROUNDS[background], (0, 0, 0)
    values = _arrays.listed(background, "background", "'default', 'transparent', 'environment' or three numbers")
    if len(values) != 3 or not all(_arrays.is_whole(each) and 0 <= each <= 255 for each in values):
        raise ValueError("background: must be 'default', 'transparent', 'environment' or three numbers of 0 to "
                         f"255, not {_arrays.text(background)}")
    return _ONE_COLOR, (int(values[0]), int(values[1]), int(values[2]))
