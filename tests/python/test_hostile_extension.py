# SPDX-License-Identifier: MIT
"""Every function of the private module rhw._rhw, called past the modules that check arguments: an exception, never a crash."""

import random
import warnings

import numpy as np
import pytest

import rhw
from conftest import SANITIZED
from rhw import _rhw

V = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], np.float32)
F = np.array([[0, 1, 2]], np.uint32)
CLIP = np.concatenate([V, np.ones((3, 1), np.float32)], 1)
CAMERA = ((0.0, 0.0, 3.0), (0.0, 0.0, 0.0), (0.0, 1.0, 0.0), False, 0.6, 0.0, 0.1, 9.0, 1.0, (0.0, 0.0))


def read_only(array):
    array = array.copy()
    array.flags.writeable = False
    return array


def unaligned(array):
    room = np.zeros(array.nbytes + 1, np.uint8)
    return room[1:].view(array.dtype).reshape(array.shape)


class Number:
    """What runs code where a number is asked for."""

    def __init__(self, value):
        self.value = value

    def __index__(self):
        return self.value

    def __float__(self):
        return float(self.value)


class Interface:
    """What says something else of its memory than is so, or nothing that makes sense."""

    def __init__(self, **members):
        about = dict(version=3, typestr="<f4", shape=(3, 4), data=(CLIP.ctypes.data, False))
        self.__array_interface__ = {**about, **members}


class Raising:
    @property
    def __array_interface__(self):
        raise ZeroDivisionError("no array today")

    def __bool__(self):
        raise ZeroDivisionError("neither true nor false")


NUMBERS = [-1, 0, 1, 2, 3, 7, 12, 33, 255, 256, 2**15, 2**31 - 1, -2**31, 2**31, 2**32 - 1, 2**32, 2**61 + 1, 2**62, 2**63 - 1, 2**63,
           2**64, -2**63, 0.5, -0.0, 1e-300, 1e300, float("nan"), float("inf"), -float("inf"), Number(3), Number(2**63)]
if SANITIZED:  # which marks all of a block that there is memory for: a second for each GiB
    NUMBERS = [number for number in NUMBERS if isinstance(number, Number) or not 2**28 < number < 2**40]
OTHERS = [None, True, "", "color", "x\0y", "é" * 300, b"bytes", b"x\0y", (), (1,), (1, 2), [], {}, object(), V, F, CLIP, read_only(V),
          unaligned(V), V[::-1], V.T, V[:, :2], V * np.nan, V.astype(">f4"), V.astype(np.float64), np.zeros((0, 3), np.float32),
          np.zeros((5, 0), np.float32), np.zeros((1, 1, 1, 1, 1, 1), np.float32), np.float32(1), np.full((1, 3), 2**32 - 1, np.uint32),
          np.full(3, 2**32 - 1, np.uint32), np.zeros((3, 3, 3), np.uint8), Interface(shape=(2**33, 2**33)), Interface(shape=(-1, 4)),
          Interface(shape=(0, 2**62)), Interface(shape=None), Interface(data=(0, False)), Interface(data=0), Interface(data=("x", 0)),
          Interface(typestr=4), Interface(strides=(16, 4)), Interface(data=(CLIP.ctypes.data, Raising())), Raising(),
          Interface(shape=(2**60,) * 5)]


TEXTS = (b"layout(location = 0) in vec3 a; layout(binding = 0) uniform B { vec4 b; }; void main() { gl_Position = vec4(a, 1) + b; }",
         b"""layout(binding = 1) uniform sampler2D t; layout(location = 0) out vec4 c; layout(push_constant) uniform P { vec4 p; };
void main() { c = texture(t, vec2(0)) + p; }""")
LOOSE = b"uniform struct S { mat3 m[2]; float f; } s; void main() {}"
COMPUTE = b"""layout(local_size_x = 8) in; layout(binding = 0) buffer B { uint b[]; }; layout(binding = 1, r8) uniform imageBuffer i;
void main() { b[gl_GlobalInvocationID.x] += 1u; imageStore(i, 0, vec4(1)); }"""


def program_calls(context, recorded, texture, sampler, positions, faces):
    """Those that want a program."""
    shaded = _rhw.Program(*(_rhw.compile(stage, text, b"text", False)[0] for stage, text in enumerate(TEXTS)), None, ((3, 1),))
    computing = _rhw.Program(None, None, _rhw.compile(2, COMPUTE, b"text", False)[0], ())
    shading = _rhw.program_pipeline(context, shaded, 0, 0, True, 0, True, False, (_rhw.formats["rgba8_srgb"],))
    words = np.zeros(64, np.uint8)
    bound = (0, 0, words, None), (1, 0, texture, sampler)
    return {
        "Pass.draw_program": (recorded(lambda made, *arguments: made.draw_program(*arguments)),
                              (shaded, shading, (positions,), faces, 3, 1, bound, words)),
        "Program": (_rhw.Program, (*(_rhw.compile(stage, text, b"text", False)[0] for stage, text in enumerate(TEXTS)), None,
                                   ((3, 1),))),
        "program_pipeline": (_rhw.program_pipeline, (context, shaded, 0, 0, True, 0, True, False, (_rhw.formats["rgba8_srgb"],))),
        "dispatch": (_rhw.dispatch, (context, computing, (2, 1, 1), ((0, 0, words, None), (1, 0, words, _rhw.formats["r8_unorm"])),
                                     words)),
        "compile": (_rhw.compile, (0, TEXTS[0], b"text", False)),
        "match": (_rhw.match, (_rhw.compile(0, LOOSE, b"text", False)[0], True, _rhw.compile(1, LOOSE, b"text", False)[0], True)),
    }


def calls():
    """Good arguments of everything that the extension has."""
    context = rhw.Context(threads=2)
    model = rhw.Model(V, F)._model
    scene = _rhw.Scene(context, model)
    pictures = {"color": np.zeros((2, 3, 4), np.uint8), "depth": np.zeros((2, 3), np.float32),
                "display": np.zeros((2, 3, 4), np.float32), "linear": np.zeros((2, 3, 4), np.float32)}
    target, _ = _rhw.texture(context, _rhw.formats["rgba8_srgb"], 4, 3, True)
    sampler = _rhw.sampler(context, 0, 1, 1.0)
    pipeline = _rhw.pipeline(context, (2, -1, 1, -1), True, 0, 0, 0, True, 0, True, False, ((0, _rhw.formats["rgba8_srgb"]),))
    positions, uv, faces = (_rhw.buffer(context, size) for size in (36, 24, 12))
    np.asarray(faces.memory)[:12] = F.view(np.uint8).reshape(-1)
    texture, _ = _rhw.texture(context, _rhw.formats["rgba8_srgb"], 4, 4, False)
    drawing = (pipeline, (positions, uv), faces, 3, texture, sampler, np.zeros(45, np.float32), 1, 1)

    def recorded(call):
        def within(*arguments):
            made = _rhw.Pass(context, (4, 3), 1, ((target, False, (0, 0, 0, 0), False),), True, None, False, 1.0, True)
            try:
                return call(made, *arguments)
            finally:
                made.end()
        return within

    def begun(*arguments):
        _rhw.Pass(*arguments).cancel()

    programs = program_calls(context, recorded, texture, sampler, positions, faces) if _rhw.compiles else {}
    mesh = (F, 3, 2, 4, 6, 2)
    rast, like = np.zeros((2, 4, 6, 4), np.float32), [np.zeros((2, 4, 6, n), np.float32) for n in (2, 3, 4, 6)]
    rast[..., 3] = 1
    tex = np.ones((1, 4, 8, 3), np.float32)
    description = ((tex, tex[:, ::2, ::2].copy()), 1, 4, 8, 3, 3, 1, 2, 24, 2)
    reading = (description, like[0], like[2], rast[..., 0].copy())
    between = (mesh, V, 3, True, rast, like[2], np.array([0, 2], np.uint32))
    edges = (mesh, like[1], 3, rast, CLIP, True, np.full((1, 3), 2**32 - 1, np.uint32))
    return {
        "Context": (_rhw.Context, (2, "baseline")),
        "Error": (_rhw.Error, ("text",)),
        "Memory": (_rhw.Memory, ()),
        "Model": (_rhw.Model, ()),
        "Resource": (_rhw.Resource, ()),
        "Scene": (_rhw.Scene, (context, model)),
        "Scene.draw": (scene.draw, ((6, 5), CAMERA, 1 | 4, 1, 1, 0, 0, 0, 0, (1, 2, 3), 0, True, True, False, 0, 0, 0.0, None,
                                   0.0)),
        "Panorama": (_rhw.Panorama, ()),
        "panorama": (_rhw.panorama, (np.ones((2, 4, 4), np.float32),)),
        "panorama_read": (_rhw.panorama_read, (b"/nowhere/x.hdr",)),
        "panorama_texels": (_rhw.panorama_texels, (_rhw.panorama(np.ones((2, 4, 4), np.float32)),)),
        "Pass": (begun, (context, (4, 3), 1, ((target, False, (0, 0, 0, 0), False),), True, None, False, 1.0, True)),
        "Pass.draw": (recorded(lambda made, *arguments: made.draw(*arguments)), drawing),
        **programs,
        "Pass.viewport": (recorded(lambda made, *arguments: made.viewport(*arguments)), (0.0, 0.0, 2.0, 2.0)),
        "buffer": (_rhw.buffer, (context, 100)),
        "texture": (_rhw.texture, (context, _rhw.formats["r8_unorm"], 4, 3, True)),
        "generate_mips": (_rhw.generate_mips, (target,)),
        "sampler": (_rhw.sampler, (context, 0, 1, 1.0)),
        "pipeline": (_rhw.pipeline, (context, (2, -1, 1, -1), True, 0, 0, 0, True, 0, True, False,
                                     ((0, _rhw.formats["rgba8_srgb"]), (5, _rhw.formats["rg32_float"])))),
        "load": (_rhw.load, (b"/nowhere", None, False, None, 0.0, None, 1, 0, 0)),
        "make": (_rhw.make, ("m", 0, (("mesh", 3, True, 0, V.astype(np.float64), V, V[:, :2].copy(), CLIP, F),),
                             (("material", (1.0, 1.0, 1.0, 1.0), (0.0, 0.0, 0.0), 0.0, 0.5, 1, 0.5, False, True, 0),),
                             (("image", np.zeros((2, 2, 4), np.uint8)),), (("node", 0, np.eye(4)),))),
        "describe": (_rhw.describe, (model,)),
        "to_bytes": (_rhw.to_bytes, (model,)),
        "from_bytes": (_rhw.from_bytes, (_rhw.to_bytes(model),)),
        "srgb_light": (_rhw.srgb_light, ()),
        "camera_fit": (_rhw.camera_fit, (model, 1.5, (20.0, 30.0), 0, False, 30.0, False, 1.0, 0.04)),
        "camera_of_file": (_rhw.camera_of_file, (model, 1.5, 0)),
        "camera_look": (_rhw.camera_look, (model, (1.0, 2.0, 3.0), (0.0, 0.0, 0.0), (0.0, 1.0, 0.0), 30.0)),
        "camera_enclose": (_rhw.camera_enclose, (model, CAMERA)),
        "camera_shows_a_dot": (_rhw.camera_shows_a_dot, (model, CAMERA, 1.5)),
        "camera_sight": (_rhw.camera_sight, (model, CAMERA, 1.5)),
        "camera_matrices": (_rhw.camera_matrices, (CAMERA, 1.5)),
        "lens_angle": (_rhw.lens_angle, (480, 300.0)),
        "sin_cos_degrees": (_rhw.sin_cos_degrees, (30.0,)),
        "axis_turn": (_rhw.axis_turn, (1, (0.0, 1.0, 0.0))),
        "encode_png": (_rhw.encode_png, ("x.png", np.zeros((2, 3, 4), np.uint8), 8, True)),
        "encode_output": (_rhw.encode_output, ("x.png", pictures, (3, 2), 0, 8, False, (0.0, 0.0, 0.0), (1.0, 1.0, 1.0),
                                                 (0.0, 0.0, 0.0))),
        "encode_exr": (_rhw.encode_exr, ("x.exr", pictures, (3, 2), 3, CAMERA, model, 2, (0.0, 0.0, 0.0))),
        "is_finite": (_rhw.is_finite, (V,)),
        "empty": (_rhw.empty, ((2, 3),)),
        "diff_rasterize": (_rhw.diff_rasterize, (context, mesh, CLIP, True, np.array([[0, 1], [0, 1]], np.uint32), rast, like[2],
                                                 rast[..., 0].copy(), rast[..., 0].copy())),
        "diff_rasterize_grad": (_rhw.diff_rasterize_grad, (mesh, CLIP, True, rast, like[2], like[2], np.zeros_like(CLIP))),
        "diff_interpolate": (_rhw.diff_interpolate, (*between, like[1], like[2])),
        "diff_interpolate_grad": (_rhw.diff_interpolate_grad, ((*between, like[1], like[2]), V.copy(), rast.copy(), like[2])),
        "diff_texture": (_rhw.diff_texture, (*reading, like[1])),
        "diff_texture_grad": (_rhw.diff_texture_grad, ((*reading, like[1]), tuple(level.copy() for level in description[0]),
                                                       *(array.copy() for array in reading[1:]))),
        "diff_antialias": (_rhw.diff_antialias, (*edges, like[1].copy())),
        "diff_antialias_grad": (_rhw.diff_antialias_grad, ((*edges, like[1]), like[1].copy(), CLIP.copy())),
    }


def replaced(arguments, choose):
    """The arguments with one thing in them, at any depth, put in the place of another."""
    arguments = dict(arguments) if isinstance(arguments, dict) else list(arguments)
    keys = list(arguments) if isinstance(arguments, dict) else range(len(arguments))
    key = choose.choice(keys)
    value = arguments[key]
    if isinstance(value, (tuple, dict)) and value and choose.random() < 0.8:
        arguments[key] = replaced(value, choose)
    elif isinstance(value, tuple) and choose.random() < 0.3:
        arguments[key] = value * choose.choice((0, 2, 9))
    else:
        like = NUMBERS if isinstance(value, (int, float)) else OTHERS
        arguments[key] = choose.choice(like if choose.random() < 0.8 else NUMBERS + OTHERS)
    return arguments if isinstance(arguments, dict) else tuple(arguments)


def test_nothing_is_left_out():
    there = {name for name in dir(_rhw) if callable(getattr(_rhw, name)) and not name.startswith("__")}
    assert {name.split(".")[0] for name in calls()} == (there if _rhw.compiles else there - {"Program", "program_pipeline", "dispatch",
                                                                                              "compile", "match"})


@pytest.mark.parametrize("name", list(calls()))
def test_hostile_arguments(name):
    call, good = calls()[name]
    choose = random.Random(name)
    refused = 0
    tries = 1500 if good else 1
    # Each of `make` that succeeds is a process, and each of `compile` takes milliseconds, of four arguments.
    tries = {"make": 700, "compile": 300}.get(name, tries)
    for _ in range(tries):
        arguments = good
        for _ in range(choose.choice((1, 1, 1, 2, 3)) if good else 0):
            arguments = replaced(arguments, choose)
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                call(*arguments)
        except (TypeError, ValueError, OverflowError, MemoryError, IndexError, ZeroDivisionError, rhw.Error) as error:
            refused += 1
            assert "\n" not in str(error)
    call_again, good = calls()[name]
    if name in ("Memory", "Model", "Panorama", "Resource"):
        assert refused == 1  # they are made by functions alone
    else:
        assert name in ("Error", "srgb_light") or refused > tries / 10
        if name not in ("camera_of_file", "load", "panorama_read"):
            call_again(*good)


@pytest.mark.parametrize("end", ["end", "cancel"])
def test_a_pass_that_ends_while_a_draw_is_read(end):
    """Arguments run code: what it ends must not be drawn into."""
    context = rhw.Context(threads=1)
    texture, _ = _rhw.texture(context, _rhw.formats["rgba8_srgb"], 4, 3, False)
    pipeline = _rhw.pipeline(context, (2, -1, -1, -1), False, 0, 0, 0, False, 0, True, False, ((0, _rhw.formats["rgba8_srgb"]),))

    class Ending:
        def __init__(self, made):
            self.made = made

        def __index__(self):
            getattr(self.made, end)()
            return 3

        @property
        def __array_interface__(self):
            getattr(self.made, end)()
            return np.zeros(45, np.float32).__array_interface__

    for place in (3, 6, 7):
        made = _rhw.Pass(context, (4, 3), 1, ((texture, False, (0, 0, 0, 0), False),), False, None, False, 1.0, False)
        arguments = [pipeline, (_rhw.buffer(context, 36),), None, 3, None, None, np.zeros(45, np.float32), 1, 1]
        arguments[place] = Ending(made)
        with pytest.raises(ValueError, match="^the pass has ended$"):
            made.draw(*arguments)


@pytest.mark.skipif(not _rhw.compiles, reason="this build has no glslang: Debian's glslang-dev")
@pytest.mark.parametrize("place", [4, 5])
def test_a_pass_that_ends_while_a_draw_of_a_program_is_read(place):
    context = rhw.Context(threads=1)
    program = _rhw.Program(_rhw.compile(0, TEXTS[0], b"text", False)[0], None, None, ())
    pipeline = _rhw.program_pipeline(context, program, 0, 0, False, 0, True, False, ())
    made = _rhw.Pass(context, (4, 3), 1, (), True, None, False, 1.0, True)

    class Ending:
        def __index__(self):
            made.cancel()
            return 3

    arguments = [program, pipeline, (_rhw.buffer(context, 36),), None, 3, 1, (), np.zeros(0, np.uint8)]
    arguments[place] = Ending()
    with pytest.raises(ValueError, match="^the pass has ended$"):
        made.draw_program(*arguments)
