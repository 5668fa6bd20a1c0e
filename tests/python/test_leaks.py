# SPDX-License-Identifier: MIT
"""What fails, and what ends, gives its memory back."""

import ctypes
import gc
import os
import sys
import warnings

import numpy as np
import pytest

import rhw
import rhw.diff as dr
from conftest import SANITIZED
from rhw import _rhw
from rhw.pipeline import Buffer, Pass, Pipeline, Program, Texture

if SANITIZED:
    pytest.skip("a sanitizer keeps what was freed for a while", allow_module_level=True)


compiles = pytest.mark.skipif(not _rhw.compiles, reason="this build has no glslang: Debian's glslang-dev")


class Usage(ctypes.Structure):
    """struct mallinfo2 of glibc."""
    _fields_ = [(name, ctypes.c_size_t) for name in ("arena", "ordblks", "smblks", "hblks", "hblkhd", "usmblks", "fsmblks",
                                                     "uordblks", "fordblks", "keepcost")]


try:
    usage = ctypes.CDLL(None).mallinfo2
    usage.restype = Usage
except AttributeError:
    pytest.skip("the C library does not count its memory", allow_module_level=True)


def bytes_in_use():
    """Of malloc, and pages of the process."""
    gc.collect()
    found = usage()
    with open("/proc/self/statm") as file:
        return found.uordblks + found.hblkhd, int(file.read().split()[1]) * os.sysconf("SC_PAGESIZE")


V = np.random.default_rng(1).random((60, 3), np.float32)
PLACES = V.astype(np.float64)
F = np.arange(60, dtype=np.uint32).reshape(-1, 3)
NOBODY = ((0.0,) * 3,) * 3 + (False, 0.0, 0.0, 0.0, 0.0, 1.0, (0.0, 0.0))
MATERIAL = ("m", (1.0,) * 4, (0.0,) * 3, 0.0, 0.5, 0, 0.5, False, True, -1)
WORLD = np.eye(4)
context = rhw.Context(threads=2)
model = rhw.Model(V, F)


def made(faces=F, node=0, last=()):
    return _rhw.make("m", 0, (("mesh", 3, True, 0, PLACES, None, None, None, faces),), (MATERIAL,), (), (("n", node, WORLD), *last))


def bad_camera():
    _rhw.Scene(context, model._model).draw((8, 8), NOBODY, 1, 1, 1, 0, 0, 0, 0, (0, 0, 0), 0, True, True, False, 0, 0, 0.0, None, 0.0)


def shaded_pass(texel=np.ones((64, 64), np.float32)):
    program = Program(vertex="layout(location = 0) in vec3 v; void main() { gl_Position = vec4(v, 1); }", fragment="""
layout(binding = 0) uniform B { vec4 tint; }; layout(binding = 1) uniform sampler2D image;
layout(location = 0) out vec4 color; void main() { color = tint * texture(image, vec2(0.5)); }""")
    target = {"color": Texture(64)}
    with Pass(target) as draw:
        draw(Pipeline(target, program=program, depth=None), {"v": V}, F, {"tint": (1, 1, 1, 1), "image": texel})


def torn_pass():
    target = {"color": Texture(64)}
    with Pass(target) as draw:
        draw(Pipeline(target, depth=None), V, F)
        raise ValueError("in the middle")


@pytest.mark.parametrize("times, call", [
    (60, lambda: rhw.Model(V, F, colors=V[:7])),
    (60, lambda: rhw.load("/nowhere")),
    (30, lambda: rhw.load(__file__)),
    (60, lambda: rhw.Context(threads=99)),
    (60, lambda: rhw.Context(isa="none")),
    (60, lambda: Buffer((2**40, 2**20), context=context)),
    (60, lambda: _rhw.texture(context, 9999, 500, 500, False)),
    (60, lambda: _rhw.sampler(context, 77, 0, 1.0)),
    (60, lambda: _rhw.pipeline(context, (2, -1, -1, -1), False, 0, 99, 0, True, 0, True, False, ((0, 3),))),
    (60, lambda: _rhw.pipeline(context, (2, -1, -1, -1), False, 0, 0, 0, True, 0, True, False, ((0, 3), (9, 3)))),
    pytest.param(60, lambda: Program(vertex="void main() { gl_Position = x; }"), marks=compiles),
    (60, lambda: _rhw.Program(b"x" * 2000, None, None, ())),
    pytest.param(60, lambda: shaded_pass(texel=3), marks=compiles),
    (60, lambda: _rhw.Pass(context, (0, 0), 1, (), True, None, False, 1.0)),
    (60, torn_pass),
    (60, lambda: rhw.write_png("/nowhere/x.png", np.zeros((99, 99, 3), np.uint8))),
    (60, lambda: _rhw.encode_output("x", {"color": V}, (8, 8), 0, 8, False, (0.0,) * 3, (1.0,) * 3, (0.0,) * 3)),
    (60, lambda: _rhw.encode_exr("x", {}, (8, 8), 1, NOBODY, model._model, 1, (0.0,) * 3)),
    (60, lambda: dr.texture_grad(np.ones((1, 64, 64, 3)), np.ones((1, 9, 9, 2)), np.ones((1, 9, 8, 3)))),
    (60, lambda: _rhw.diff_rasterize_grad((F, len(V), 1, 64, 64, 1), V, True, V, V, None, V)),
])
def test_what_fails(times, call):
    check(times, call, fails=True)


@pytest.mark.parametrize("word, call", [
    ("index 60 of 60", lambda: made(faces=F + 1)),
    ("mesh 7 of 1", lambda: made(node=7)),
    ("instances: ", lambda: made(last=(3,))),
])
def test_a_bad_model(word, call):
    """Its words say that it is refused for what is wrong with it, behind all that is right."""
    check(60, call, fails=True, word=word)


def test_a_bad_camera():
    check(60, bad_camera, fails=True, word="field of view")


def whole_chain():
    pos = np.concatenate([V, np.ones((len(V), 1), np.float32)], 1)[None]
    rast, rast_db = dr.rasterize(pos, F, (64, 64), context=context)
    values, slopes = dr.interpolate(V, rast, F, rast_db, "all", context=context)
    dr.interpolate_grad(V, rast, F, values, rast_db, slopes, "all", context=context)
    dr.rasterize_grad(pos, F, rast, rast, rast_db, context=context)
    dr.texture_grad(np.ones((1, 64, 64, 3)), rast[..., :2], values, rast_db, context=context)
    dr.antialias_grad(values, rast, pos, F, values, context=context)


def kept_pass():
    targets = {"color": Texture(16)}
    with Pass(targets, keep=True) as draw:
        draw(Pipeline(targets, depth=None), V, F)
    draw.run()
    with pytest.raises(ZeroDivisionError):
        with Pass(targets, keep=True):
            1 / 0


def drawn_pass():
    target = {"color": Texture(64), "triangle": Texture(64, "r32_uint")}
    with Pass(target, depth=True) as draw:
        draw(Pipeline(target), V, F, texture=None)


@pytest.mark.parametrize("times, call", [
    (30, lambda: rhw.Model(V, F).render(20, context=context).png()),
    (60, lambda: model.render(20, outputs=("linear", "depth")).exr()),
    (60, lambda: rhw.Context(threads=3).threads),
    (40, whole_chain),
    (60, drawn_pass),
    (60, kept_pass),
    pytest.param(20, shaded_pass, marks=compiles),
    (60, lambda: Texture.of(np.zeros((64, 64, 3), np.uint8))),
])
def test_what_ends(times, call):
    check(times, call, fails=False)


@pytest.mark.parametrize("make", [
    lambda: rhw.Context(threads=1),
    made,
    lambda: _rhw.Scene(context, model._model),
    lambda: _rhw.panorama(np.ones((1, 2, 4), np.float32)),
    lambda: _rhw.sampler(context, 0, 0, 1.0),
    pytest.param(lambda: Program(vertex="void main() { gl_Position = vec4(0); }")._program, marks=compiles),
    lambda: _rhw.panorama_texels(_rhw.panorama(np.ones((1, 2, 4), np.float32))),
])
def test_objects_leave_their_type(make):
    """Each keeps its type as long as it lives, and is too small for the pages of Python's own memory to tell that it is gone."""
    kind = type(make())
    before = sys.getrefcount(kind)
    for _ in range(8):
        make()
    gc.collect()
    assert sys.getrefcount(kind) == before


def check(times, call, fails, word=""):
    """word: of what an error must say."""
    def once():
        try:
            call()
            failed = False
        except (ValueError, TypeError, OSError, MemoryError, rhw.Error) as error:
            assert word in str(error)
            failed = True
        assert failed == fails

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for _ in range(10):
            once()
        for _ in range(5):  # what is kept for later grows once or twice; a leak does each time
            before = bytes_in_use()
            for _ in range(times):
                once()
            after = bytes_in_use()
            grown = after[0] - before[0], after[1] - before[1]
            if grown[0] < 36 * times and grown[1] < 20000 * times:  # less than any object of the extension each time
                return
    assert grown == (0, 0)
