# SPDX-License-Identifier: MIT
"""Passes from Python: values against their formulas and against the pictures of models, in place and without a copy."""

import gc

import numpy as np
import pytest

import rhw
from rhw.pipeline import Buffer, Pass, Pipeline, Sampler, Texture
from test_model import sphere

SIZE = 64, 48
#: x right, y up over the whole picture, at a depth of 1/4.
CORNERS = np.array([[-1, -1, 0.25], [1, -1, 0.25], [-1, 1, 0.25], [1, 1, 0.25]], np.float32)
FACES = np.array([[0, 1, 2], [2, 1, 3]], np.uint32)


def middles():
    """x and y of clip space in the middle of each pixel."""
    columns, rows = np.meshgrid(np.arange(SIZE[0]), np.arange(SIZE[1]))
    return (columns + 0.5) * 2 / SIZE[0] - 1, 1 - (rows + 0.5) * 2 / SIZE[1]


def draw_one(outputs, **options):
    """The targets, after one draw of the two triangles."""
    targets = {name: Texture(SIZE, form) for name, form in outputs.items()}
    given = {key: options.pop(key) for key in ("colors", "uv", "normals", "matrix", "world", "color", "texture", "sampler",
                                              "object", "first_triangle") if key in options}
    pipeline = Pipeline(targets, colors=None if "colors" not in given else str(given["colors"].dtype),
                        uv="uv" in given, normals="normals" in given, texture="texture" in given, **options)
    with Pass(targets, depth=True) as draw:
        draw(pipeline, CORNERS, FACES, **given)
    return {name: texture.array for name, texture in targets.items()}


def test_values():
    x, y = middles()
    colors = np.stack([np.array([0, 1, 0, 1]), np.array([0, 0, 1, 1]), np.full(4, 0.5), np.full(4, 0.25)], 1)
    got = draw_one({"color": "rgba32_float", "depth": "r32_float", "distance": "r32_float", "uv": "rg32_float",
                    "normal": "rgba32_float", "triangle": "r32_uint", "object": "r32_uint", "position": "rgba32_float"},
                   colors=colors.astype(np.float32), uv=CORNERS[:, :2] * 3, normals=np.full((4, 3), 2.0), object=9,
                   first_triangle=70, color=(1, 1, 4, 1), world=np.diag([2.0, 3.0, 1.0, 1.0]),
                   matrix=np.diag([0.5, 1 / 3, 1, 1]))
    assert np.allclose(got["color"], np.stack([(x + 1) / 2, (y + 1) / 2, 0 * x + 2, 0 * x + 0.25], -1), atol=1e-6)
    assert (got["depth"] == 0.25).all() and (got["distance"] == 1).all() and (got["object"] == 9).all()
    assert np.allclose(got["uv"], np.stack([3 * x, 3 * y], -1), atol=1e-5)
    assert np.allclose(got["normal"][..., :3], np.array([3, 2, 6]) / 7, atol=1e-6)  # by the inverse, transposed
    assert np.array_equal(got["triangle"], np.where(x + y < 0, 70, 71))
    assert np.allclose(got["position"], np.stack([2 * x, 3 * y, 0 * x + 0.25, 0 * x + 1], -1), atol=1e-5)


def test_one_output_alone():
    """Where nothing else goes to the fragments with it."""
    assert np.allclose(draw_one({"normal": "rgba32_float"}, normals=np.full((4, 3), 2.0))["normal"][..., :3], 3**-0.5)
    assert np.allclose(draw_one({"uv": "rg32_float"}, uv=np.full((4, 2), 0.75))["uv"], 0.75)
    assert np.allclose(draw_one({"position": "rgba32_float"})["position"][..., 2], 0.25)


def test_perspective():
    """Smooth, noperspective and flat, on a triangle with three different W."""
    positions = np.array([[-1, -1, 0, 1], [4, -4, 0, 4], [-2, 2, 0, 2]], np.float32)
    values = np.array([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]], np.float32)
    x, y = middles()
    s, t = (x + 1) / 2, (y + 1) / 2
    screen = np.stack([1 - s - t, s, t], -1)
    inside = screen.min(axis=-1) > 0
    space = screen / [1, 4, 2]
    space /= space.sum(axis=-1, keepdims=True)
    for kind, wanted in (("smooth", space), ("noperspective", screen), ("flat", np.broadcast_to([1, 0, 0], space.shape))):
        target = {"color": Texture(SIZE, "rgba32_float")}
        with Pass(target) as draw:
            draw(Pipeline(target, positions=4, colors="float32", depth=None, interpolate=kind), positions, colors=values)
        assert np.allclose(target["color"].array[inside][:, :3], wanted[inside], atol=1e-6), kind
        assert not target["color"].array[~inside].any()


def test_as_a_model_is_drawn(context):
    """Ids and depths of a sphere are those of Model.render with the same camera."""
    vertices, faces, _ = sphere()
    camera = rhw.Camera.look_at((3, 2, 2), (0, 0, 0))
    pictures = rhw.Model(vertices, faces).render(SIZE, camera, outputs=("triangle", "distance", "barycentric"))
    targets = {"triangle": Texture(SIZE, "r32_uint", context=context), "distance": Texture(SIZE, "r32_float", context=context),
               "barycentric": Texture(SIZE, "rgba32_float", context=context)}
    with Pass(targets, depth=True) as draw:
        draw(Pipeline(targets, context=context), vertices, faces, matrix=pictures.view.matrix)
    assert np.array_equal(targets["triangle"].array, pictures["triangle"])
    seen = pictures["triangle"] > 0
    assert seen.sum() > 300
    assert np.allclose(targets["distance"].array[seen], pictures["distance"][seen], rtol=1e-5)
    assert np.allclose(targets["barycentric"].array[seen], pictures["barycentric"][seen], atol=1e-4)
    assert draw.stats["triangles_in"] == len(faces)


def test_depth_test_and_depth_maps():
    depth = Texture(SIZE, "d32_float")
    target = {"object": Texture(SIZE, "r32_uint")}
    pipeline = Pipeline(target)
    near, far = CORNERS * (0.5, 0.5, 0.4), CORNERS * (1, 1, 2)
    with Pass(target, depth=depth) as draw:
        draw(pipeline, near, FACES, object=1)
        draw(pipeline, far, FACES, object=2)
    x, y = middles()
    inside = (abs(x) < 0.5) & (abs(y) < 0.5)
    assert np.array_equal(target["object"].array, np.where(inside, 1, 2))
    assert np.allclose(depth.array, np.where(inside, 0.1, 0.5))
    with Pass(target, depth=depth, load=True) as draw:  # goes on with what is there
        draw(Pipeline(target), CORNERS, FACES, object=3)
    assert np.array_equal(target["object"].array, np.where(inside, 1, 3))
    with Pass(depth=depth) as draw:  # depth alone
        draw(Pipeline(()), CORNERS, FACES)
    assert (depth.array == 0.25).all()


def test_texture_is_read_as_it_was_written_last():
    image = np.zeros((16, 16, 3), np.uint8)
    image[:8] = (200, 100, 50)
    uv = CORNERS[:, :2] * (0.5, -0.5) + 0.5
    for srgb in (True, False):
        texture = Texture.of(image, srgb=srgb)
        nearest = Sampler("nearest", "clamp")
        form = {"color": "rgba8_srgb" if srgb else "rgba8_unorm"}
        got = draw_one(form, uv=uv.astype(np.float32), texture=texture, sampler=nearest)["color"]
        assert (got[:20, :, :3] == (200, 100, 50)).all() and (got[28:, :, :3] == 0).all()
        texture.array[...] = 77
        texture.generate_mips()
        got = draw_one(form, uv=uv.astype(np.float32), texture=texture)["color"]
        assert (got == 77).all(), srgb


def test_buffers_are_read_in_place():
    positions = Buffer(CORNERS)
    assert positions.array.flags.writeable and np.array_equal(positions.array, CORNERS)
    target = {"color": Texture(SIZE, "r8_unorm")}
    pipeline = Pipeline(target, depth=None)
    shown = target["color"].array
    for part in (1.0, 0.5):
        positions.array[:, :2] = CORNERS[:, :2] * part
        with Pass(target) as draw:
            draw(pipeline, positions, Buffer(FACES))
        assert (shown == 255).sum() == part * part * shown.size
    assert Buffer([[0.0, 7.0]], np.uint8).array.tolist() == [[0, 7]] and Buffer([2**40], np.float32).array[0] == 2**40
    assert Buffer((5, 3)).array.shape == (5, 3) and Buffer(4, np.uint32).array.dtype == np.uint32


def test_samples_and_clear():
    triangle = np.array([[-1, -1, 0], [1, -1, 0], [-1, 1, 0]], np.float32)
    target = {"color": Texture(SIZE, "rgba32_float")}
    with Pass(target, samples=4, clear={"color": (0.5, 0, 0, 1)}) as draw:
        draw(Pipeline(target, depth=None), triangle, color=(0, 1, 0, 1))
    levels = np.unique(target["color"].array[..., 1])
    assert len(levels) > 2 and set(levels) <= {0, 0.25, 0.5, 0.75, 1}
    with Pass({"object": Texture(SIZE, "r32_uint")}, clear={"object": 2**32 - 1}) as draw:
        pass
    assert draw.stats["triangles_in"] == 0


def test_blend_and_bytes():
    half = np.full((4, 4), 255, np.uint8)
    half[:, 3] = 51
    target = {"color": Texture(SIZE, "rgba32_float")}
    with Pass(target, clear={"color": (0, 0, 0, 1)}) as draw:
        draw(Pipeline(target, colors="uint8", blend=True, depth=None), CORNERS, FACES, colors=half)
    assert np.allclose(target["color"].array, [0.2, 0.2, 0.2, 1], atol=1e-6)


def test_cull_viewport_and_topology():
    target = {"color": Texture(SIZE, "r8_unorm")}
    for cull, wanted in (("back", 1), ("front", 0)):
        with Pass(target) as draw:
            draw.viewport(0, 0, 32, 24)
            draw(Pipeline(target, cull=cull, depth=None), CORNERS, FACES)
        assert (target["color"].array == 255).sum() == wanted * 32 * 24
    with Pass(target) as draw:
        draw(Pipeline(target, topology="triangle_strip", depth=None), CORNERS)
    assert (target["color"].array == 255).all()


def test_what_a_pass_uses_lives_as_long_as_it():
    target = {"object": Texture(SIZE, "r32_uint")}
    with Pass(target, depth=Texture(SIZE, "d32_float")) as draw:
        for i in range(50):
            draw(Pipeline(target, depth="less_equal"), CORNERS.copy(), FACES.copy(), object=i)
        shown = target.pop("object").array
        gc.collect()
    assert (shown == 49).all()


def test_a_pass_that_is_kept_is_run_again():
    positions, targets = Buffer(CORNERS), {"color": Texture(SIZE, "r8_unorm"), "object": Texture(SIZE, "r32_uint")}
    with Pass(targets, keep=True) as draw:
        draw(Pipeline(targets, depth=None), positions, FACES.copy(), object=7)
        with pytest.raises(ValueError, match="keep it, and end it first"):
            draw.run()
    first, shown = draw.stats, {name: texture.array.copy() for name, texture in targets.items()}
    assert (shown["object"] == 7).all() and first["triangles_in"] == 2
    gc.collect()
    for texture in targets.values():
        texture.array[...] = 3
    draw.run()
    assert draw.stats == first and all(np.array_equal(shown[name], targets[name].array) for name in targets)
    positions.array[:, :2] *= 0.5
    with Pass(targets):  # the context has passes of its own meanwhile
        with pytest.raises(ValueError, match="pass"):
            draw.run()
    draw.run()
    assert (targets["object"].array == 7).sum() == targets["object"].array.size / 4
    with pytest.raises(ValueError, match="the pass has ended"):
        draw.viewport(0, 0, 8, 8)
    for once in (Pass(targets), Pass(targets, keep=True)):
        with pytest.raises(ValueError, match="cannot be run again"):
            once.run()
    with Pass(targets) as once:
        pass
    with pytest.raises(ValueError, match="cannot be run again"):
        once.run()


def test_an_exception_draws_nothing():
    target = {"color": Texture(SIZE, "r8_unorm")}
    with pytest.raises(ZeroDivisionError):
        with Pass(target) as draw:
            draw(Pipeline(target, depth=None), CORNERS, FACES)
            1 / 0
    assert (target["color"].array == 0).all()
    with Pass(target) as draw:  # and the context is free for the next one
        draw(Pipeline(target, depth=None), CORNERS, FACES)
    assert (target["color"].array == 255).all()


def test_a_million_triangles():
    n = 708
    v, u = np.mgrid[0:n, 0:n].astype(np.float32) / (n - 1) * 2 - 1
    positions = np.stack([u, v, np.full_like(u, 0.5)], -1).reshape(-1, 3)
    a = (np.arange(n - 1)[:, None] * n + np.arange(n - 1)).reshape(-1)
    faces = np.concatenate([np.stack([a, a + 1, a + n], 1), np.stack([a + 1, a + n + 1, a + n], 1)])
    target = {"triangle": Texture(512, "r32_uint")}
    with Pass(target, depth=True) as draw:
        draw(Pipeline(target), positions, faces)
    ids = target["triangle"].array
    assert draw.stats["triangles_in"] == len(faces) == 2 * (n - 1) ** 2
    assert ids.min() > 0 and len(np.unique(ids)) > 100000


target = {"color": Texture(SIZE, "r8_unorm")}
pipeline = Pipeline(target)


def drawn(*arguments, of=None, into=None, **keywords):
    with Pass(into or target, depth=True) as draw:
        draw(of or pipeline, *arguments, **keywords)


@pytest.mark.parametrize("call, kind, line", [
    (lambda: drawn(CORNERS, FACES + 2), ValueError, "faces: must lie between 0 and 3, the last of 4 vertices, not 5"),
    (lambda: drawn(CORNERS, FACES.ravel()[:4]), ValueError, "faces: must be a multiple of 3 indices, not 4"),
    (lambda: drawn(CORNERS, Buffer(FACES.astype(np.int64))), ValueError, "faces: must be of uint32, not int64"),
    (lambda: drawn(CORNERS[:, :2], FACES), ValueError, r"positions: must have the shape \(N, 3\) and be of float32"),
    (lambda: drawn(CORNERS, FACES, colors=CORNERS), ValueError, "colors: the pipeline does not read them"),
    (lambda: drawn(CORNERS, of=Pipeline(target, uv=True)), ValueError, "uv: missing"),
    (lambda: drawn(CORNERS, of=Pipeline(target, uv=True), uv=CORNERS[:2, :2]), ValueError, "uv: must be as many as"),
    (lambda: drawn("abc"), TypeError, "positions: must be of float32, not <U3"),
    (lambda: drawn(CORNERS, matrix=np.eye(3)), ValueError, r"matrix: must have the shape \(4, 4\)"),
    (lambda: drawn(CORNERS, color=(1, 1, 1)), ValueError, r"color: must have the shape \(4,\)"),
    (lambda: drawn(CORNERS, texture=Texture.of(np.zeros((2, 2), np.uint8))), ValueError, "texture: the pipeline has none"),
    (lambda: drawn(CORNERS, of=Pipeline(target, uv=True, texture=True), uv=CORNERS[:, :2]), ValueError, "texture: missing"),
    (lambda: drawn(CORNERS, object=-1), ValueError, "object: must lie between 0 and 4294967295"),
    (lambda: drawn(CORNERS, of=Pipeline(("triangle",))), ValueError, "pipeline: draws"),
    (lambda: drawn(CORNERS, of=Pipeline({"color": "rgba8_unorm"})), ValueError, "pipeline: draws"),
    (lambda: drawn(CORNERS, of=Pipeline(target, context=rhw.Context(1))), ValueError, "pipeline: belongs to another context"),
    (lambda: drawn(Buffer(CORNERS, context=rhw.Context(1))), ValueError, "positions: belongs to another context"),
    (lambda: drawn(CORNERS, Buffer(FACES, context=rhw.Context(1))), ValueError, "faces: belongs to another context"),
    (lambda: drawn(CORNERS * np.nan), ValueError, "positions: every number must be finite"),
    (lambda: drawn(CORNERS * 1e300), ValueError, "positions: every number must be finite, as float32 too"),
    (lambda: drawn(CORNERS, of=Pipeline(target, colors="float32"), colors=np.full((4, 4), np.inf)), ValueError, "colors: every number"),
    (lambda: drawn(CORNERS, matrix=np.eye(4) * 1e200), ValueError, "matrix: every number must be finite, as float32 too"),
    (lambda: drawn(CORNERS, matrix=np.eye(4) * 1e30, world=np.eye(4) * 1e30), ValueError, "matrix, world: every number"),
    (lambda: drawn(CORNERS, color=(1e300, 1, 1, 1)), ValueError, "color: every number must be finite, as float32 too"),
    (lambda: Buffer([1.0, np.nan], np.uint32), ValueError, "data: must be of numbers that uint32 has, not nan"),
    (lambda: Buffer([0.5], np.uint32), ValueError, "data: must be of numbers that uint32 has, not 0.5"),
    (lambda: Buffer([2.0**64], np.uint64), ValueError, "data: must be of numbers that uint64 has"),
    (lambda: Buffer(FACES.astype(int) - 1, np.uint32), ValueError, "data: must be of numbers that uint32 has, not -1"),
    (lambda: Buffer([256], np.uint8), ValueError, "data: must be of numbers that uint8 has, not 256"),
    (lambda: Buffer(True), TypeError, "data: must be of numbers, not bool"),
    (lambda: Texture(True), TypeError, "size: must be"),
    (lambda: drawn(CORNERS, texture=target["color"], of=Pipeline(target, uv=True, texture=True), uv=CORNERS[:, :2]),
     ValueError, "attachment"),
    (lambda: Pass(target)(pipeline, CORNERS), ValueError, "the pass is recorded within its `with` alone"),
    (lambda: Pass({"color": Texture(3), "uv": Texture(4, "rg32_float")}), ValueError, "targets: must be of one size"),
    (lambda: Pipeline({"triangle": Texture(3)}), ValueError, "outputs: triangle cannot be drawn into rgba8_srgb"),
    (lambda: drawn(CORNERS, into={"triangle": Texture(3)}), ValueError, "pipeline: draws .*, the targets are .*triangle"),
    (lambda: drawn(CORNERS, instances=2), ValueError, "values, instances: are for pipelines with a program"),
    (lambda: Pass({"color": 3}), TypeError, "targets: must be textures, not int"),
    (lambda: Pass(target, depth=target["color"]), ValueError, "depth: must be a texture of d32_float"),
    (lambda: Pass(target, clear={"uv": 1}), ValueError, "clear: 'uv' is not one of color, depth_test"),
    (lambda: Pass(target, clear={"color": (1, 2)}), ValueError, "clear: color must be one number or 1"),
    (lambda: Pass(target, clear={"depth_test": 2}), ValueError, "clear: depth_test must lie between 0 and 1"),
    (lambda: Pass(target, samples=3), ValueError, "samples: must be 1, 2, 4, 8 or 16"),
    (lambda: Pass(), ValueError, "size: must be given"),
    (lambda: Texture(0), ValueError, "size: width and height must lie between"),
    (lambda: Texture(9, "rgb8"), ValueError, "format: 'rgb8' is not one of"),
    (lambda: Texture(9, "r32_uint", mips=True).generate_mips(), ValueError, "R32_UINT"),
    (lambda: Texture.of(np.zeros((2, 2))), TypeError, "image: must be of uint8"),
    (lambda: Sampler("cubic"), ValueError, "filter: 'cubic' is not one of linear, nearest"),
    (lambda: Sampler(anisotropy=17), ValueError, "anisotropy: must lie between 1 and 16"),
    (lambda: Buffer(np.zeros((0, 3))), ValueError, "data: must have elements"),
    (lambda: Buffer((2, -1)), ValueError, "data: no extent may be negative"),
    (lambda: Buffer("abc"), TypeError, "data: must be of numbers"),
    (lambda: Buffer((2**40, 2**20)), (ValueError, MemoryError), ""),
    (lambda: Pipeline("colour"), ValueError, "outputs: 'colour' is not one of"),
    (lambda: Pipeline("normal"), ValueError, "normals: needed by the output normal"),
    (lambda: Pipeline(positions=2), ValueError, "positions: must be 3 or 4"),
    (lambda: Pipeline(topology="quads"), ValueError, "topology: 'quads' is not one of"),
])
def test_bad_input(call, kind, line):
    with pytest.raises(kind, match=line) as caught:
        call()
    assert "\n" not in str(caught.value)
    with Pass(target) as draw:  # nothing is left half done
        draw(Pipeline(target, depth=None), CORNERS, FACES)


def test_passes_do_not_nest():
    with Pass(target):
        with pytest.raises(ValueError, match="pass"):
            with Pass(target):
                pass
