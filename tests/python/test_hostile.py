# SPDX-License-Identifier: MIT
"""Whatever is passed in, what comes out is a picture or an exception of one line: never a crash."""

import random
import threading
import warnings

import numpy as np
import pytest

import rhw
import rhw.diff as dr
from conftest import SANITIZED
from rhw.pipeline import Buffer, Pass, Pipeline, Sampler, Texture

V = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], np.float32)
F = np.array([[0, 1, 2]])


class Liar:
    """An array interface that does not hold what it says."""
    __array_interface__ = {"version": 3, "typestr": "<f4", "shape": (-3, 3), "data": (0, True)}


def hostile(random):
    read_only = V.copy()
    read_only.flags.writeable = False
    unaligned = np.zeros(V.nbytes + 1, np.uint8)[1:].view(np.float32).reshape(V.shape)
    values = [None, True, -1, 0, 1, 2**31, 2**63, 2**70, -1.5, float("nan"), float("inf"), 1e300, 1e-300, "", "color", "x\0y",
              "off", "\udcff", "\ud800", unaligned, b"bytes", (), [], {}, [[]], object(), Liar(), V, F, read_only, V[::-1], V.T, V[:, ::2], V * np.nan, V * 1e38,
              V.astype(np.float16), V.astype(">f4"), V.astype(object), np.zeros((3, 3), "datetime64[s]"), np.zeros((0, 3)),
              np.float64(3), np.array("text"), np.ma.masked_array(V, V > 0), np.full((1, 3), 2**32 - 1, np.uint32),
              np.full((1, 3), -1), np.broadcast_to(np.float32(1), (5, 3)), V[None], bytearray(12), memoryview(b"abc"),
              range(3), (1, 2), (3, 3), (0, 0, 0), (1, 0, 0), np.eye(4), np.zeros((4, 4)), np.eye(4) * 1e200, {"color": 1}]
    if SANITIZED:  # which marks all of a block that there is memory for: a second for each GiB
        values.remove(2**31)
    return random.choice(values)


def fresh(name):
    """Good arguments of each call, by keyword."""
    targets = {"color": Texture(8)}
    model = rhw.Model(V, F)
    clip = np.concatenate([V, np.ones((3, 1), np.float32)], 1)[None]
    rast, rast_db = dr.rasterize(clip, F, (4, 6))
    pictures = model.render(8, outputs=("color", "depth"))
    three, uv, sides = rast[..., :3].copy(), rast[..., :2].copy(), np.ones((1, 6, 4, 4, 3), np.float32)
    buffers = {"positions": Buffer(V), "faces": Buffer(F, np.uint32)}

    def move(**keywords):
        with Pass(targets) as recorded:
            recorded.viewport(**keywords)

    def peel(**keywords):
        with dr.DepthPeeler(**keywords) as peeler:
            peeler.rasterize_next_layer()

    def draw(**keywords):
        with Pass(targets, depth=True) as recorded:
            recorded(Pipeline(targets), **keywords)

    return {
        "Model": (rhw.Model, dict(vertices=V, faces=F, normals=None, uv=None, colors=None, face_colors=None, texture=None,
                                  color=(1, 1, 1), metallic=0.0, roughness=0.5, emissive=(0, 0, 0), alpha=None, up="y",
                                  name="m", smooth=True, unlit=False)),
        "render": (model.render, dict(size=8, camera=None, outputs=("color",), samples=1, supersample=1, background="default",
                                      lights="file", shadows=True, ground=False, ambient_occlusion=False, tone="none",
                                      exposure=0.0, transparency="sorted", wireframe="none", interpolate="smooth", up=None,
                                      environment=None, environment_rotation=0.0, context=None)),
        "Environment": (rhw.Environment, dict(light=np.ones((2, 4, 3)))),
        "load": (rhw.load, dict(path="/nowhere", variant=None, animation=None, time=None, confine=None, max_seconds=1,
                                max_memory=0, max_texture=0)),
        "of_model": (lambda camera: rhw.Camera.of_model(camera).at(model, 8), dict(camera=0)),
        "at": (lambda size: rhw.Camera.fit().at(model, size), dict(size=8)),
        "png": (pictures.png, dict(output="depth", bits=8)),
        "exr": (pictures.exr, dict(outputs=["depth"])),
        "save": (lambda **k: pictures.save("/dev/null/x.png", **k), dict(output="color", bits=None)),
        "orbit": (lambda **k: rhw.Camera.orbit(**k).at(model, 8), dict(azimuth=1, elevation=2, fovy=30, zoom=1, margin=3, up="z")),
        "look_at": (lambda **k: rhw.Camera.look_at(**k).at(model, 8), dict(eye=(1, 2, 3), target=(0, 0, 0), up=(0, 1, 0), fovy=30)),
        "from_matrix": (lambda **k: model.render(8, rhw.Camera.from_matrix(**k)),
                        dict(pose=np.eye(4), fovy=30, height=None, near=None, far=None)),
        "intrinsics": (lambda **k: model.render(8, rhw.Camera.intrinsics(**k)),
                       dict(fx=8, fy=8, cx=4, cy=4, extrinsic=np.eye(4), near=None, far=None)),
        "Context": (rhw.Context, dict(threads=1, isa=None)),
        "Buffer": (Buffer, dict(data=V, dtype=None, context=None)),
        "Texture": (Texture, dict(size=4, format="r8_unorm", mips=False, context=None)),
        "Texture.of": (Texture.of, dict(image=np.zeros((2, 2), np.uint8), srgb=True)),
        "Sampler": (Sampler, dict(filter="linear", address="clamp", anisotropy=1.0)),
        "Pipeline": (Pipeline, dict(outputs=("color",), positions=3, colors=None, uv=False, normals=False, texture=False,
                                    topology="triangles", cull="none", depth="less", depth_write=True, blend=False,
                                    interpolate="smooth", context=None)),
        "Pass": (lambda **k: Pass(**k).__enter__(), dict(targets=targets, depth=True, clear=None, load=False, samples=1, size=None)),
        "draw": (draw, dict(**buffers, colors=None, uv=None, normals=None, matrix=None, world=None, color=(1, 1, 1, 1),
                            texture=None, sampler=None, object=1, first_triangle=1)),
        "viewport": (move, dict(x=0, y=0, width=4, height=4)),
        "peel": (peel, dict(pos=clip, tri=F, resolution=(4, 6), ranges=None, context=None)),
        "construct_mip": (dr.texture_construct_mip, dict(tex=sides[:, 0], max_mip_level=2, cube_mode=False)),
        "construct_mip_grad": (dr.texture_construct_mip_grad, dict(to_tex=sides[:, 0], to_mip=[sides[:, 0, ::2, ::2]])),
        "topology": (dr.antialias_construct_topology_hash, dict(tri=F)),
        "rasterize": (dr.rasterize, dict(pos=clip, tri=F, resolution=(4, 6), ranges=None, context=None)),
        "rasterize_grad": (dr.rasterize_grad, dict(pos=clip, tri=F, rast=rast, to_rast=rast, to_rast_db=rast_db)),
        "interpolate": (dr.interpolate, dict(attr=V, rast=rast, tri=F, rast_db=rast_db, diff_attrs=[0, 2])),
        "interpolate_grad": (dr.interpolate_grad, dict(attr=V, rast=rast, tri=F, to_values=three, rast_db=rast_db,
                                                       to_slopes=rast_db, diff_attrs=[0, 2])),
        "texture": (dr.texture, dict(tex=sides[:, 0], uv=uv, uv_da=rast_db, mip_level_bias=None, mip=None, filter_mode="auto",
                                     boundary_mode="zero", max_mip_level=1)),
        "texture_grad": (dr.texture_grad, dict(tex=sides, uv=three, to_values=three, filter_mode="linear", boundary_mode="cube")),
        "antialias": (dr.antialias, dict(color=three, rast=rast, pos=clip, tri=F, topology_hash=None)),
        "antialias_grad": (dr.antialias_grad, dict(color=three, rast=rast, pos=clip, tri=F, to_result=three,
                                                   topology_hash=None)),
        "write_png": (lambda **k: rhw.write_png("/dev/null", **k), dict(image=np.zeros((2, 2), np.uint8), srgb=True)),
    }[name]


@pytest.mark.parametrize("name", ["of_model", "at", "png", "exr", "save", "viewport", "peel", "construct_mip", "construct_mip_grad",
                                  "topology", "Model", "render", "load", "orbit", "look_at", "from_matrix", "intrinsics", "Context",
                                  "Buffer", "Environment", "Texture", "Texture.of", "Sampler", "Pipeline", "Pass", "draw", "write_png",
                                  "rasterize", "rasterize_grad", "interpolate", "interpolate_grad", "texture", "texture_grad",
                                  "antialias", "antialias_grad"])
def test_hostile_arguments(name):
    choose = random.Random(name)
    call, good = fresh(name)
    refused = 0
    for _ in range(200):
        keywords = dict(good)
        for key in choose.sample(sorted(good), min(len(good), choose.choice((1, 1, 2)))):
            keywords[key] = hostile(choose)
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                call(**keywords)
        except (TypeError, ValueError, MemoryError, OSError, rhw.Error) as error:
            refused += 1
            assert "\n" not in str(error) and len(str(error)) < 400, keywords
            named = any(key in str(error) for key in good)
            assert named or isinstance(error, (MemoryError, FileNotFoundError, NotADirectoryError)), (error, keywords)
    assert refused > 20


def test_numbers_that_are_no_pixels_are_left_alone():
    """Triangles that are not there, coordinates and slopes of any size, positions of any sign."""
    choose = np.random.default_rng(3)
    extremes = np.array([0, -0.0, 1, -1, 2, 7, 1e-38, -1e-30, 1e9, 3e38, -3e38, 2**31, 2**32, 0.5, 1e4], np.float32)

    def any_of(*shape):
        return choose.choice(extremes, shape)

    for _ in range(60):
        pos, tri, rast = any_of(2, 5, 4), choose.integers(0, 5, (6, 3)), any_of(2, 4, 6, 4)
        dr.rasterize(pos, tri, (4, 6))
        with np.errstate(all="ignore"):
            dr.rasterize_grad(pos, tri, rast, any_of(2, 4, 6, 4), any_of(2, 4, 6, 4))
            dr.interpolate_grad(any_of(2, 5, 3), rast, tri, any_of(2, 4, 6, 3), any_of(2, 4, 6, 4), any_of(2, 4, 6, 6), "all")
            dr.antialias_grad(any_of(2, 4, 6, 3), rast, pos, tri, any_of(2, 4, 6, 3))
            for boundary, sides, n in (("cube", (6, 4, 4), 3), ("wrap", (4, 8), 2), ("clamp", (4, 8), 2), ("zero", (4, 8), 2)):
                for mode in ("nearest", "linear", "linear-mipmap-nearest", "linear-mipmap-linear"):
                    dr.texture_grad(any_of(1, *sides, 2), any_of(2, 4, 6, n), any_of(2, 4, 6, 2), any_of(2, 4, 6, 2 * n),
                                    any_of(2, 4, 6), None, mode, boundary)


@pytest.mark.skipif(SANITIZED, reason="sanitizers cannot fork beside threads that allocate")
def test_an_array_that_changes_while_it_is_drawn():
    """What is in the memory may be anything, at any time."""
    vertices = np.random.default_rng(1).random((3000, 3), np.float32)
    stop = threading.Event()

    def change():
        while not stop.is_set():
            vertices[...] = vertices[::-1]

    thread = threading.Thread(target=change)
    thread.start()
    try:
        for _ in range(20):
            rhw.Model(vertices, np.arange(3000).reshape(-1, 3)).render(32)
    finally:
        stop.set()
        thread.join()
