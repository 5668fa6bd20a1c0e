# SPDX-License-Identifier: MIT
"""Programs from Python: GLSL texts draw and compute what their formulas say, and what is wrong is named with its line."""

import gc
import mmap
import pickle
import pathlib
import signal

import numpy as np
import pytest

import rhw
from rhw import _rhw
from rhw.pipeline import Buffer, CompileError, Pass, Pipeline, Program, Sampler, Texture

if not _rhw.compiles:
    pytest.skip("this build has no glslang: Debian's glslang-dev", allow_module_level=True)

SIZE = 16, 8
#: Covers the picture.
CORNERS = np.array([[-1, -1], [3, -1], [-1, 3]], np.float32)

COVER = """
layout(location = 0) in vec2 position;
void main() { gl_Position = vec4(position, 0.5, 1); }
"""

BLOCKS = """#version 450
struct Light { vec3 color; float power; };
layout(set = 0, binding = 0) uniform Scene {
    mat4 turn;
    layout(row_major) mat2x3 slope;
    vec3 eye;
    int count;
    Light lights[2];
    uvec2 pairs[3];
    bool is_on;
} scene;
layout(location = 0) out vec4 color;
layout(location = 1) out vec4 other;
void main()
{
    color = scene.turn * vec4(scene.eye, 1) + vec4(scene.slope * vec2(1, 10), scene.count);
    other = vec4(scene.lights[1].color * scene.lights[0].power, scene.is_on ? scene.pairs[2].y : 0u);
}
"""

SCALE = """#version 450
layout(local_size_x = 8) in;
layout(constant_id = 3) const int STEP = 1;
layout(set = 1, binding = 2, std430) buffer Data { int numbers[]; } data;
layout(set = 0, binding = 0) readonly buffer Table { int table[]; };
layout(push_constant) uniform Push { int factor; } push;
void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i < data.numbers.length()) {
        data.numbers[i] = data.numbers[i] * push.factor + table[i % 2] * STEP;
    }
}
"""


def drawn(fragment, values=None, form="rgba32_float", **options):
    """The first target of a fragment shader that covers the picture."""
    program = Program(vertex=COVER, fragment=fragment)
    targets = {name: Texture(SIZE, form) for name in program.outputs}
    with Pass(targets) as draw:
        draw(Pipeline(targets, program=program, depth=None, **options), {"position": CORNERS}, None, values)
    return targets[program.outputs[0]].array, targets


SCENE = {"turn": np.arange(16).reshape(4, 4), "slope": [[1, 2], [3, 4], [5, 6]], "eye": (1, 2, 3), "count": 7,
         "lights": [{"color": (1, 1, 1), "power": 2}, {"color": (3, 4, 5), "power": 9}], "pairs": [[1, 2], [3, 4], [5, 6]],
         "is_on": True}


@pytest.mark.parametrize("values", [SCENE, {"scene": SCENE}, {"Scene": SCENE}, {(0, 0): SCENE},
                                    {f"scene.{name}": value for name, value in SCENE.items()}])
def test_blocks_by_name(values):
    color, targets = drawn(BLOCKS, values)
    wanted = SCENE["turn"] @ [1, 2, 3, 1] + np.append(np.array(SCENE["slope"]) @ [1, 10], 7)
    assert (color == wanted).all()
    assert (targets["other"].array == (6, 8, 10, 6)).all()


def test_a_whole_block_as_memory():
    block = np.zeros(64, np.uint8)
    block[:16].view(np.float32)[:] = 1, 2, 3, 4
    text = "layout(binding = 5) uniform Block { vec4 one; } block; layout(location = 0) out vec4 color; void main() { color = block.one; }"
    for value in (block, Buffer(block), block.tobytes(), np.arange(1.0, 5, dtype=np.float32)):
        assert (drawn(text, {"block": value})[0] == (1, 2, 3, 4)).all()


def test_vertices_by_name_and_number():
    program = Program(vertex="""
layout(location = 3) in vec3 tint;
layout(location = 1) in ivec2 place;
layout(location = 0) out vec4 color;
void main() { gl_Position = vec4(place + gl_InstanceIndex * ivec2(2, 0), 0, 1); color = vec4(tint, gl_VertexIndex); }
""", fragment="layout(location = 0) flat in vec4 color; layout(location = 0) out vec4 shown; void main() { shown = color; }")
    assert program.inputs == ("place", "tint") and program.outputs == ("shown",) and program.values == ()
    target = {"shown": Texture(SIZE, "rgba32_float")}
    given = {"tint": np.arange(12.0).reshape(4, 3), "place": np.array([[-2, -2], [-1, -1], [0, -1], [-1, 1]])}
    with Pass(target) as draw:
        draw(Pipeline(target, program=program, depth=None), given, [[1, 2, 3]], instances=2)
    assert draw.stats["triangles_in"] == 2
    shown = np.unique(target["shown"].array.reshape(-1, 4), axis=0)
    assert shown.tolist() == [[0, 0, 0, 0], [3, 4, 5, 1]]
    numbered = Program(vertex="void main() { gl_Position = vec4(gl_VertexIndex == 1 ? 3 : -1, gl_VertexIndex == 2 ? 3 : -1, 0, 1); }",
                       fragment="layout(location = 0) out uint id; void main() { id = 7u; }")
    ids = {"id": Texture(SIZE, "r32_uint")}
    with Pass(ids) as draw:
        draw(Pipeline(program=numbered, depth=None), 3)
    assert (ids["id"].array == 7).all()


def test_textures():
    text = """layout(binding = 0) uniform sampler2D image;
layout(location = 0) out vec4 color;
void main() { color = textureLod(image, vec2(gl_FragCoord.x / 16, 0.5), 0); }"""
    image = np.zeros((2, 16, 3), np.uint8)
    image[:, 8:] = 255
    near = Sampler("nearest")
    for value in (image, (image, near), Texture.of(image), (Texture.of(image), near)):
        color = drawn(text, {"image": value}, "rgba8_unorm")[0]
        assert (color[:, 1:7, :3] == 0).all() and (color[:, 9:15] == 255).all()
    numbers = np.linspace(0, 1e6, 32, dtype=np.float32).reshape(2, 16)
    assert (drawn(text, {(0, 0): (numbers[:1], near)})[0][..., 0] == numbers[:1]).all()
    many = """layout(binding = 1) uniform texture2D images[2];
layout(binding = 2) uniform sampler how;
layout(location = 0) out vec4 color;
void main() { color = texture(sampler2D(images[int(gl_FragCoord.x) % 2], how), vec2(0)); }"""
    ones = np.ones((1, 1), np.float32)
    color = drawn(many, {"images": [ones, 3 * ones], "how": near})[0]
    assert (color[:, ::2, 0] == 1).all() and (color[:, 1::2, 0] == 3).all()


def test_images_and_texels_are_written_in_place():
    image = Texture(SIZE, "r32_uint")
    texels = np.zeros((16, 2), np.float32)
    Program(compute="""layout(local_size_x = 16) in;
layout(binding = 0, r32ui) uniform uimage2D image;
layout(binding = 1, rg32f) uniform imageBuffer texels;
void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID);
    imageStore(image, at, uvec4(at.x + 100 * at.y));
    if (at.y == 0) { imageStore(texels, at.x, vec4(at.x, 0.5, 0, 0)); }
}""").dispatch((1, 8), {"image": image, "texels": texels})
    y, x = np.mgrid[0:8, 0:16]
    assert np.array_equal(image.array, x + 100 * y)
    assert np.array_equal(texels, np.stack([np.arange(16), np.full(16, 0.5)], 1))
    image.array[...] = 1
    Program(compute="""layout(local_size_x = 16) in;
layout(binding = 0, r32ui) uniform uimage2D image;
void main() { imageAtomicAdd(image, ivec2(gl_LocalInvocationID.x / 2, 0), 3u); }""").dispatch(1, {"image": image})
    assert (image.array[0, :8] == 7).all() and (image.array[1:] == 1).all()


def test_computing_in_place(context):
    program = Program(compute=SCALE, constants={3: 1000})
    numbers, table = np.arange(20, dtype=np.int32), np.array([1, 2], np.int32)
    table.flags.writeable = False
    program.dispatch(3, {"data": numbers, "table": table, "factor": 10}, context=context)
    wanted = 10 * np.arange(20) + 1000 * np.where(np.arange(20) % 2, 2, 1)
    assert np.array_equal(numbers, wanted)
    buffer = Buffer(np.arange(20, dtype=np.int32), context=context)
    program.dispatch((3, 1, 1), {(1, 2): buffer, (0, 0): Buffer(table, context=context), "Push": {"factor": 10}}, context=context)
    assert np.array_equal(buffer.array, wanted)


def test_what_a_draw_uses_lives_as_long_as_its_pass():
    text = """layout(binding = 0) buffer Seen { uint seen[]; };
layout(binding = 1) uniform sampler2D image;
layout(push_constant) uniform Push { float part; };
layout(location = 0) out vec4 color;
void main() { seen[int(gl_FragCoord.x)] = 5u; color = texture(image, vec2(0.5)) * part; }"""
    target, seen = {"color": Texture(SIZE, "rgba32_float")}, np.zeros(16, np.uint32)
    with Pass(target, keep=True) as draw:
        for part in range(20):
            draw(Pipeline(target, program=Program(vertex=COVER, fragment=text), depth=None), {"position": CORNERS.copy()}, None,
                 {"seen": seen, "image": np.full((3, 3), 2, np.float32), "part": part})
        gc.collect()
    assert (target["color"].array[..., 0] == 38).all() and (seen == 5).all()
    target["color"].array[...] = seen[...] = 0
    draw.run()
    assert (target["color"].array[..., 0] == 38).all() and (seen == 5).all()
    with pytest.raises(ZeroDivisionError):
        with Pass(target) as draw:
            draw(Pipeline(target, program=Program(vertex=COVER, fragment=text), depth=None), {"position": CORNERS}, None,
                 {"seen": seen, "image": np.ones((1, 1), np.float32), "part": 1})
            1 / 0


def test_depth_alone_and_pipelines_of_both_kinds():
    depth = Texture(SIZE, "d32_float")
    with Pass(depth=depth) as draw:
        draw(Pipeline(program=Program(vertex=COVER)), {"position": CORNERS})
    assert (depth.array == 0.5).all()
    target = {"color": Texture(SIZE, "rgba32_float")}
    half = Program(vertex=COVER, fragment="layout(location = 0) out vec4 color; void main() { color = vec4(1, 0, 0, 0.5); }")
    with Pass(target, clear={"color": (0, 0, 1, 1)}) as draw:
        draw(Pipeline(target, program=half, depth=None, blend=True), {"position": CORNERS})
        draw(Pipeline(target, depth=None), np.array([[-1, -1, 0], [0, -1, 0], [-1, 0, 0]], np.float32), color=(9, 9, 9, 9))
    assert (target["color"].array[0, 0] == (0.5, 0, 0.5, 1)).all() and (target["color"].array[-1, 0] == 9).all()


def test_sources(tmp_path):
    words = _rhw.compile(2, SCALE.encode(), b"scale", False)[0]
    (tmp_path / "scale.spv").write_bytes(words)
    (tmp_path / "part.glsl").write_text("const int FROM = 3;\n")
    (tmp_path / "scale.comp").write_text('#version 450\n#extension GL_GOOGLE_include_directive : require\n#include "part.glsl"\n'
                                         + SCALE.replace("#version 450", "").replace("* push.factor", "* push.factor * FROM"))
    for source, factor in ((words, 2), (bytearray(words), 2), (tmp_path / "scale.spv", 2), (tmp_path / "scale.comp", 6)):
        numbers = np.arange(8, dtype=np.int32)
        Program(compute=source).dispatch(1, {"data": numbers, "table": np.zeros(2, np.int32), "factor": 2})
        assert np.array_equal(numbers, factor * np.arange(8))


def test_texts_of_opengl():
    """Names fit two texts together, whatever order they have; a uniform of both is one."""
    vertex = """uniform mat3 turn; uniform float scale; uniform sampler2D map;
in vec2 uv; in vec2 position; out vec2 at; out float far;
void main() { at = uv; far = scale; gl_Position = vec4(turn * vec3(position, 1), 1) + textureLod(map, uv, 0.0) * 0.0; }"""
    fragment = """uniform sampler2D image; uniform vec4 tint; uniform float scale; in float far; in vec2 at; out vec4 color;
void main() { color = vec4(texture(image, at).r * tint.r, far, scale * tint.b, 1); }"""
    program = Program(vertex=vertex, fragment=fragment)
    assert sorted(program.values) == ["image", "map", "scale", "tint", "turn"]
    target = {"color": Texture(SIZE, "rgba32_float")}
    turn = np.array([[1, 0, 0], [0, 1, 0], [0, 0, 0.5]], np.float32)
    with Pass(target) as draw:
        draw(Pipeline(target, program=program, depth=None), {"position": CORNERS, "uv": np.zeros((3, 2), np.float32)},
             values={"turn": turn, "scale": 0.25, "tint": (0.5, 0, 8, 0), "map": np.ones((1, 1), np.float32),
                     "image": np.full((1, 1), 0.5, np.float32)})
    assert (target["color"].array == (0.25, 0.25, 2, 1)).all()
    with pytest.raises(ValueError, match="the fragment shader reads 'at', which the vertex shader does not write"):
        Program(vertex=vertex.replace("vec2 at;", "vec2 there;").replace("at =", "there ="), fragment=fragment)


def test_a_large_process_compiles():
    """The limit of memory counts from what the process has. The text needs more than is free in what it has."""
    long = "".join(f"float f{i}(float x) {{ return x * {i}.0 + sin(x); }}\n" for i in range(5000))
    with mmap.mmap(-1, 1 << 37, flags=mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS | 0x4000, prot=0):
        Program(vertex=long + COVER)


def test_texts_that_are_wrong(tmp_path):
    with pytest.raises(CompileError) as caught:
        Program(vertex=COVER, fragment="#version 450\nlayout(location = 0) out vec4 color;\n\nvoid main()\n{\n    color = colour;\n}\n")
    error = caught.value
    assert str(error) == "fragment:6: 'colour' : undeclared identifier"
    assert (error.stage, error.line, error.text) == ("fragment", 6, "color = colour;") and isinstance(error, ValueError)
    assert error.log.splitlines()[0] == str(error)
    again = pickle.loads(pickle.dumps(error))  # as a pool of processes hands it on
    assert (type(again), str(again), vars(again)) == (CompileError, str(error), vars(error))
    path = tmp_path / "wrong.comp"
    path.write_text("void main() {\n  return 1;\n}\n")
    with pytest.raises(CompileError, match="wrong.comp:2: ") as caught:
        Program(compute=path)
    assert caught.value.line == 2
    with pytest.raises(rhw.Error, match="nowhere.frag: No such file"):
        Program(vertex=COVER, fragment=pathlib.Path("/nowhere.frag"))


scale = Program(compute=SCALE)
plain = Program(vertex=COVER, fragment="layout(location = 0) out vec4 color; void main() { color = vec4(1); }")
target = {"color": Texture(SIZE, "rgba8_unorm")}
numbers = np.zeros(8, np.int32)
table = {"table": np.zeros(2, np.int32), "factor": 1}


def one(positions, faces=None, values=None, of=plain, **options):
    with Pass(target) as draw:
        draw(Pipeline(target, program=of, depth=None), positions, faces, values, **options)


def scaled(**values):
    scale.dispatch(1, {**table, "data": numbers, **values})


sampling = Program(vertex=COVER, fragment="""layout(binding = 0) uniform sampler2D image;
layout(location = 0) out vec4 color; void main() { color = texture(image, vec2(0)); }""")
cubes = Program(vertex=COVER, fragment="""layout(binding = 0) uniform samplerCube image;
layout(location = 0) out vec4 color; void main() { color = texture(image, vec3(1)); }""")


@pytest.mark.parametrize("call, kind, line", [
    (lambda: Program(), ValueError, "vertex: a program has a vertex shader"),
    (lambda: Program(fragment=COVER), ValueError, "vertex: a program has a vertex shader"),
    (lambda: Program(vertex=COVER, compute=SCALE), ValueError, "vertex: a program has a vertex shader"),
    (lambda: Program(vertex=3), TypeError, "vertex: must be a text of GLSL, bytes of SPIR-V or a path, not 3"),
    (lambda: Program(vertex="shaders/plain.vert"), TypeError, r"vertex: .*pathlib.Path\('shaders/plain.vert'\) is a path"),
    (lambda: Program(vertex=b"abcd" * 5), ValueError, "vertex: .*magic number"),
    (lambda: Program(compute=SCALE, constants=3), TypeError, "constants: must be a dictionary, not 3"),
    (lambda: Program(compute=SCALE, constants={"STEP": 3}), TypeError, "constants: must be a whole number"),
    (lambda: Program(vertex=COVER, fragment="layout(location = 2) in vec4 a; layout(location = 0) out vec4 c; void main() { c = a; }"),
     ValueError, "the fragment shader reads location 2, component 0, which the vertex shader does not write"),
    (lambda: Program(vertex="layout(location = 0) in mat4 m; void main() { gl_Position = m[0]; }"), ValueError,
     "vertex: m at location 1: an input is a number or vector"),
    (lambda: Pipeline(program=3), TypeError, "program: must be a Program, not 3"),
    (lambda: Pipeline(program=scale), ValueError, "program: computes"),
    (lambda: Pipeline(program=plain, uv=True), ValueError, "program: says itself what positions, colors, uv"),
    (lambda: Pipeline("colour", program=plain), ValueError, r"outputs: must be .* by location, color, not \['colour'\]"),
    (lambda: Pipeline({"color": "r32_uint"}, program=plain), ValueError, "outputs: color cannot be drawn into r32_uint"),
    (lambda: Pass({3: Texture(3)}), TypeError, "targets: must be named by texts, not 3"),
    (lambda: one(3), TypeError, "positions: must be a dictionary of position, not 3"),
    (lambda: one({}), ValueError, "position: missing; the vertex shader reads it"),
    (lambda: one({"position": CORNERS, "uv": CORNERS}), ValueError, "positions: 'uv' is not one of position"),
    (lambda: one({"position": CORNERS[:, :1]}), ValueError, r"position: must have the shape \(N, 2\) and be of float32"),
    (lambda: one({"position": Buffer(CORNERS, np.float64)}), ValueError, "position: must have the shape .* of float64"),
    (lambda: one({"position": CORNERS * np.nan}), ValueError, "position: every number must be finite"),
    (lambda: one({"position": Buffer(CORNERS, context=rhw.Context(1))}), ValueError, "position: belongs to another context"),
    (lambda: one({"position": CORNERS}, [[0, 1, 3]]), ValueError, "faces: must lie between 0 and 2"),
    (lambda: one({"position": CORNERS}, instances=0), ValueError, "instances: must lie between 1 and"),
    (lambda: one({"position": CORNERS}, matrix=np.eye(4)), ValueError, "matrix: a program takes it from values"),
    (lambda: one({"position": CORNERS}, color=(1, 0, 0, 1)), ValueError, "color: a program takes it from values"),
    (lambda: one({"position": CORNERS}, object=3), ValueError, "object: a program takes it from values"),
    (lambda: one({"position": CORNERS}, values={"time": 1}), ValueError, "values: the program has no 'time'; its values are none"),
    (lambda: one({"position": CORNERS}, values=3), TypeError, "values: must be a dictionary, not 3"),
    (lambda: one({"position": CORNERS}, of=sampling), ValueError, "image: missing"),
    (lambda: one({"position": CORNERS}, of=sampling, values={"image": 3}), TypeError, r"image: there are no texels of int64"),
    (lambda: one({"position": CORNERS}, of=sampling, values={"image": Texture(3, "r32_uint")}), ValueError,
     "image: must be of another format than r32_uint, as the shader reads floats, not r32_uint"),
    (lambda: one({"position": CORNERS}, of=cubes, values={"image": CORNERS}), ValueError, "image: only images of two dimensions"),
    (lambda: one({"position": CORNERS}, of=sampling, values={"image": target["color"]}), ValueError, "image: is a target of the pass"),
    (lambda: one({"position": CORNERS}, of=sampling, values={"image": Texture(3, context=rhw.Context(1))}), ValueError,
     "image: belongs to another context"),
    (lambda: drawn(BLOCKS, {**SCENE, "eye": (1, 2)}), ValueError, r"eye: must have the shape \(3,\), not \(2,\)"),
    (lambda: drawn(BLOCKS, {**SCENE, "eye": (1, 2, np.nan)}), ValueError, "eye: every number must be finite, as float32 too"),
    (lambda: drawn(BLOCKS, {**SCENE, "eye": "abc"}), TypeError, "eye: must be of numbers, not <U3"),
    (lambda: drawn(BLOCKS, {**SCENE, "count": 0.5}), ValueError, "count: must be of numbers that int32 has, not 0.5"),
    (lambda: drawn(BLOCKS, {**SCENE, "lights": []}), ValueError, "lights: must have 2 elements, not 0"),
    (lambda: drawn(BLOCKS, {**SCENE, "lights": [{}, {}]}), ValueError, r"lights\[0\].color: missing"),
    (lambda: drawn(BLOCKS, {**SCENE, "lights": [{"color": (1, 1, 1), "power": 1, "size": 3}] * 2}), ValueError,
     r"lights\[0\]: has no member 'size'; it has color, power"),
    (lambda: drawn(BLOCKS, {"scene": {"turn": np.eye(4)}}), ValueError, "scene.slope: missing"),
    (lambda: drawn(BLOCKS, {"turn": np.eye(4)}), ValueError, "slope: missing"),
    (lambda: drawn(BLOCKS, {**SCENE, "scene": SCENE}), ValueError, "values: scene is given twice"),
    (lambda: drawn(BLOCKS, {**SCENE, "scene.eye": (0, 0, 0)}), ValueError, "values: scene.eye is given twice"),
    (lambda: drawn(BLOCKS, {"scene": np.zeros(3, np.float32)}), ValueError, "scene: must have [0-9]+ bytes, not 12"),
    (lambda: one({"position": CORNERS}, of=scale), ValueError, "program: computes"),
    (lambda: plain.dispatch(1), ValueError, "program: draws"),
    (lambda: scale.dispatch((1, 1, 1, 1)), ValueError, "groups: must be one to three numbers"),
    (lambda: scale.dispatch(-1), ValueError, "groups: must lie between 0 and 65535"),
    (lambda: scaled(data=numbers.astype(np.int64)), TypeError, "data: must be of int32, not int64"),
    (lambda: scaled(data=[1, 2]), TypeError, "data: must be of int32, not int64"),
    (lambda: scaled(data=np.zeros((4, 2), np.int32)), ValueError, r"data: must have the shape \(N, 1\), as elements stand 4 bytes"),
    (lambda: scaled(data=numbers[::2]), ValueError, "data: its elements must lie one behind the other"),
    (lambda: scaled(data=np.broadcast_to(np.int32(1), 1)), ValueError, "data: must be writable"),
    (lambda: scaled(factor=np.zeros(2, int)), ValueError, r"factor: must be one number, not \(2,\)"),
    (lambda: scaled(data=Buffer(numbers, context=rhw.Context(1))), ValueError, "data: belongs to another context"),
])
def test_bad_input(call, kind, line):
    with pytest.raises(kind, match=line) as caught:
        call()
    assert "\n" not in str(caught.value)
    one({"position": CORNERS})  # nothing is left half done


def test_a_name_of_several_things():
    program = Program(vertex="""layout(location = 0) in vec2 position;
layout(binding = 0) uniform A { float part; } a;
void main() { gl_Position = vec4(position, a.part, 1); }""", fragment="""layout(binding = 1) uniform B { float part; } b;
layout(location = 0) out vec4 color; void main() { color = vec4(b.part); }""")
    assert program.values == ("A.part", "B.part")
    with pytest.raises(ValueError, match=r"values: part may be one of several; say BLOCK.part or \(set, binding\)"):
        one({"position": CORNERS}, of=program, values={"part": 1})
    one({"position": CORNERS}, of=program, values={"a.part": 0.25, "B.part": 1})
    assert (target["color"].array == 255).all()


def test_nothing_is_computed_within_a_pass():
    with Pass(target):
        with pytest.raises(ValueError, match="pass"):
            scaled()
    scaled()


def test_a_shader_that_never_ends_is_given_up():
    program = Program(compute="layout(binding = 0) buffer D { uint d[]; }; void main() { while (d[0] == 0u) { d[1] += 1u; } }")

    def ring(*_):
        raise TimeoutError

    before = signal.signal(signal.SIGALRM, ring)
    signal.setitimer(signal.ITIMER_REAL, 0.1)
    try:
        with pytest.raises(TimeoutError):
            program.dispatch(1, {"D": np.zeros(2, np.uint32)})
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
