#!/bin/sh
# SPDX-License-Identifier: MIT
# rhw shader: what it tells of shaders, what it writes and computes, and files that are none.
. "$(dirname "$0")/harness.sh"

cat >double.comp <<'GLSL'
layout(local_size_x = 8) in;
layout(constant_id = 3) const float factor = 2.0;
layout(constant_id = 4) const int more = 0;
layout(set = 0, binding = 1) readonly buffer Source { float source[]; };
layout(set = 0, binding = 2) buffer Sink { float sink[]; };
layout(push_constant) uniform Push { float shift; };

void main()
{
    sink[gl_GlobalInvocationID.x] = source[gl_GlobalInvocationID.x] * factor + shift + float(more);
}
GLSL
"$rhw" shader double.comp >"$folder/log/out" 2>"$folder/log/err"
if grep -q "built without glslang" "$folder/log/err"; then
    refuse 1 "double.comp: this rhw was built without glslang, so it reads SPIR-V alone" shader double.comp
    refuse 1 "double.txt: a shader's file is named .vert, .frag, .comp \(GLSL\) or .spv" shader double.txt
    finish
fi

# What a shader is.
cat >want <<'TEXT'
double.comp: compute shader main
resources, by set and binding
  0:1   storage buffer, read only, Source, 0 bytes and an array of any length
         0  float[]      source
  0:2   storage buffer Sink, 0 bytes and an array of any length
         0  float[]      sink
push constants, 4 bytes
         0  float        shift
specialization constants
  id 3       float  factor = 2
  id 4       int    more = 0
workgroup of 8x1x1, 0 bytes shared
TEXT
succeed shader double.comp
check "the table" cmp want "$folder/log/out"
succeed shader --print info double.comp
check "the table by name" cmp want "$folder/log/out"
succeed shader --json double.comp
check "JSON" grep -q '{"set": 0, "binding": 1, "kind": "storage buffer", "count": 1, "name": "Source", "read_only": true, "bytes": 0, "members": \[{"name": "source", "offset": 0, "type": "float\[\]"}\]}' \
    "$folder/log/out"
check "constants in JSON" grep -q '"constants": \[{"id": 3, "type": "float", "default": 2, "name": "factor"}, {"id": 4, "type": "int", "default": 0, "name": "more"}\]' \
    "$folder/log/out"
cat >kinds.frag <<'GLSL'
#extension GL_EXT_samplerless_texture_functions : enable
layout(constant_id = 1) const bool sharp = true;
layout(constant_id = 0) const uint most = 4000000000u;
layout(location = 0) flat in uint number;
layout(location = 1) flat in ivec3 three;
layout(location = 0) out uvec4 color;
layout(binding = 0) uniform sampler2DArrayShadow shadow;
layout(binding = 1) uniform usamplerCube cube;
layout(binding = 2, rgba16f) uniform image3D volume;
layout(binding = 3, r32i) uniform iimageBuffer texels;
layout(binding = 4) uniform samplerBuffer table;
layout(binding = 5) uniform texture2DMS samples;
layout(binding = 6) uniform sampler plain;

void main()
{
    imageStore(volume, ivec3(0), texelFetch(table, 0) * texture(shadow, vec4(0)) + texelFetch(samples, ivec2(0), 0));
    imageStore(texels, 0, ivec4(three, 0));
    color = texture(cube, vec3(1)) + number + most;
}
GLSL
cat >want.kinds <<'TEXT'
kinds.frag: fragment shader main
resources, by set and binding
  0:0   sampled texture shadow, sampler2DArrayShadow
  0:1   sampled texture cube, usamplerCube
  0:2   storage image volume, image3D, rgba16f
  0:3   texel buffer texels, iimageBuffer, r32i
  0:4   texel buffer table, samplerBuffer
  0:5   texture samples, texture2DMS
specialization constants
  id 0       uint   most = 4000000000
  id 1       bool   sharp = true
inputs
  location 0  uint   number
  location 1  ivec3  three
outputs
  location 0  uvec4  color
TEXT
succeed shader kinds.frag
check "kinds of images, and numbers without sign" cmp want.kinds "$folder/log/out"
succeed shader --json kinds.frag
check "kinds in JSON" grep -q '"name": "volume", "image": "image3D", "format": "rgba16f", "read_only": false' "$folder/log/out"
if command -v python3 >/dev/null 2>&1; then
    check "JSON of a shader" python3 -m json.tool "$folder/log/out" /dev/null
fi
refuse 2 "--run: draws colours, which are floats, and the first output" shader kinds.frag --run -o a.png

# SPIR-V is written whole, and read again.
succeed shader double.comp -o double.spv
check "words" test "$(od -A n -t x4 -N 8 double.spv | tr -d ' ')" = 0723020300010300
check "nothing is said of what is written" test ! -s "$folder/log/out"
succeed shader double.spv
check "the table of a module" test "$(tail -n +2 "$folder/log/out" | cksum)" = "$(tail -n +2 want | cksum)"
succeed shader --print spirv double.spv
check "instructions" grep -q 'OpEntryPoint GLCompute %main "main" %gl_GlobalInvocationID' "$folder/log/out"
succeed shader --print ir double.comp
check "lines of the source" grep -q "^; double.comp:10  sink\[gl_GlobalInvocationID.x\] = source" "$folder/log/out"
check "operations" grep -Eq "^v[0-9]+ = fmul v[0-9]+ 2.0$" "$folder/log/out"
cp "$folder/log/out" passes
succeed shader --print ir --after build double.comp
check "no operation is uniform before passes" sh -c "! grep -q '^u' '$folder/log/out' && grep -q '^u' passes"
succeed shader --print bytecode double.comp
check "bytecode" grep -Eq "^ +[0-9]+  end *$" "$folder/log/out"
succeed shader --print code double.comp
check "machine code" grep -Eq "^ +[0-9a-f]+  c3 +ret$" "$folder/log/out"
check "lines of the source beside it" grep -q "^; double.comp:10  sink" "$folder/log/out"
export RHW_JIT=0
succeed shader --print code double.comp
unset RHW_JIT
check "who executes it" grep -q "^; the interpreter executes this stage here$" "$folder/log/out"
printf '#version 450\nvoid main() {}\n' >nothing.frag
succeed shader --print code nothing.frag
check "that nobody executes it" test "$(cat "$folder/log/out")" = "; this stage does nothing and is not called"

# What a file is made of, for make.
printf '#define ONE 1.0\n' >'o n$e.glsl'
printf '#include "o n$e.glsl"\nlayout(location = 0) out vec4 c;\nvoid main() { c = vec4(ONE); }\n' >one.frag
for out in one.c one.spv; do
    succeed shader one.frag -o $out --depfile $out.d
    check "what $out is made of" test "$(cat $out.d)" = "$out: one.frag o\\ n\$\$e.glsl"
done
refuse 2 "--depfile: goes with -o OUT.spv or OUT.c alone" shader one.frag --depfile one.d

# A program as C.
succeed shader double.spv -o twice.c
check "names of C" grep -q "^const struct rhw_compute_program twice_program" twice.c
refuse 1 "2.c: its name without .c begins the names of the program" shader double.spv -o 2.c

# What it computes.
succeed shader double.comp --run --buffer 0:1=f32:1,2,3,4.5 --buffer 0:2=20 --push f32:0.25 --result 0:2=f32
check "numbers" test "$(cat "$folder/log/out")" = "2.25,4.25,6.25,9.25,0.25"
succeed shader double.spv --run --buffer 0:1=f32:1,2,3,4.5 --buffer 0:2=20 --result 0:2=f32 --constant 3=3 --constant 4=10
check "constants" test "$(cat "$folder/log/out")" = "13,16,19,23.5,10"
succeed shader double.comp -o given.spv --constant 3=3 --constant 4=10
succeed shader given.spv --run --buffer 0:1=f32:1,2,3,4.5 --buffer 0:2=20 --result 0:2=f32
check "constants that are written" test "$(cat "$folder/log/out")" = "13,16,19,23.5,10"
succeed shader given.spv --run --buffer 0:1=f32:1 --buffer 0:2=4 --result 0:2=f32 --constant 4=0
check "and may be chosen again" test "$(cat "$folder/log/out")" = 3
succeed shader kinds.frag --print spirv --constant 1=false --constant 0=7
check "constants that are printed" sh -c "grep -q '%sharp = OpSpecConstantFalse' '$folder/log/out' && grep -q '%most = OpSpecConstant %uint 7' '$folder/log/out'"
succeed shader double.spv --run --buffer Source=f32:1 --buffer Sink=8 --result Sink=sink.bin --result 0:2=u32
check "bits" test "$(cat "$folder/log/out")" = "1073741824,0"
check "a file" test "$(od -A n -t f4 sink.bin | tr -d ' ')" = 20
succeed shader double.comp --run --buffer 0:1=sink.bin --buffer 0:2=80 --result 0:2=f32 --groups 2
check "groups, and a file read" test "$(cat "$folder/log/out")" = "4,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0"

# What it draws: uniforms by their names, a texture, and a macro from a file that is included.
mkdir library
echo 'vec3 tone(vec3 c) { return c * TONE; }' >library/tone.glsl
cat >paint.frag <<'GLSL'
#include "tone.glsl"
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 color;
layout(binding = 0) uniform sampler2D picture;
uniform vec3 iResolution;
uniform float iTime;

void main()
{
    float side = gl_FragCoord.x < iResolution.x / 2.0 ? iTime : 1.0;
    color = vec4(tone(texture(picture, uv).rgb) * side, 1.0);
}
GLSL
printf 'P6 2 2 255\n\310\000\000\000\310\000\000\000\310\310\310\310' >four.ppm
succeed shader paint.frag -D TONE=0.5 -I library --run --size 2x2 --time 0 --texture picture=four.ppm -o paint.png
printf 'P6 2 2 255\n\000\000\000\000\144\000\000\000\000\144\144\144' >want.ppm
succeed compare paint.png want.ppm
no_temporary_files
cat >red.vert <<'GLSL'
layout(location = 3) out float red;
void main()
{
    gl_Position = vec4(gl_VertexIndex == 1 ? 3 : -1, gl_VertexIndex == 2 ? 3 : -1, 0, 1);
    red = 1.0;
}
GLSL
printf 'layout(location = 3) in float red;\nlayout(location = 0) out vec4 c;\nvoid main() { c = vec4(red, 0, 0, 1); }\n' >red.frag
succeed shader red.vert red.frag --run --size 1 -o red.png
printf 'P6 1 1 255\n\377\000\000' >want.ppm
succeed compare red.png want.ppm
succeed shader red.vert red.frag
check "both tables" test "$(grep -c '^red.*shader main$' "$folder/log/out")" = 2

# Texts that are none for Vulkan: what they share goes by its name. green stands behind red in one and before it in the
# other, and so do the textures; both have uniforms of their own and one together.
cat >loose.vert <<'GLSL'
uniform float iTime;
uniform sampler2D picture;
out float red;
out float green;
void main()
{
    gl_Position = vec4(gl_VertexIndex == 1 ? 3 : -1, gl_VertexIndex == 2 ? 3 : -1, 0, 1);
    red = 0.25 * iTime;
    green = textureLod(picture, vec2(0.5), 0.0).g;
}
GLSL
cat >loose.frag <<'GLSL'
uniform sampler2D other;
uniform vec3 iResolution;
uniform float iTime;
in float green;
in float red;
out vec4 color;
void main() { color = vec4(red * iTime, green, texture(other, vec2(0.5)).b * iResolution.x, 1.0); }
GLSL
printf 'P6 1 1 255\n\000\377\000' >green.ppm
printf 'P6 1 1 255\n\000\000\377' >blue.ppm
succeed shader loose.vert loose.frag --run --size 1 --time 2 --texture picture=green.ppm --texture other=blue.ppm -o loose.png
printf 'P6 1 1 255\n\377\377\377' >want.ppm
succeed compare loose.png want.ppm
refuse 1 "loose.vert:1: 'non-opaque uniforms outside a block'" shader loose.vert loose.frag
sed 's/in float red;/in float blue;/; s/red \*/blue */' loose.frag >blue.frag
refuse 1 "blue.frag: the fragment shader reads 'blue', which the vertex shader does not write; what has no location goes by its name" \
    shader loose.vert blue.frag --relaxed
sed 's/uniform float iTime/uniform int iTime/' loose.frag >whole.frag
refuse 1 "whole.frag: uniform 'iTime' is of another type in the other shader" shader loose.vert whole.frag --run -o a.png

# Blocks without locations go by the names of their types, whatever stands before them and what they are called. What is
# declared and not read need not be written.
cat >blocks.vert <<'GLSL'
out Colors { float red; vec2 rest[2]; } given;
out Shade { float factor; };
out Half { float part; } halves[2];
out float green;
void main()
{
    gl_Position = vec4(gl_VertexIndex == 1 ? 3 : -1, gl_VertexIndex == 2 ? 3 : -1, 0, 1);
    given.red = 0.25;
    given.rest[0] = vec2(0.0, 0.25);
    given.rest[1] = vec2(0.5, 1.0);
    green = 0.5;
    factor = 2.0;
    halves[0].part = 0.125;
    halves[1].part = 0.375;
}
GLSL
cat >blocks.frag <<'GLSL'
in vec4 unread;
in float green;
in Shade { float factor; };
in Half { float part; } parts[2];
in Colors { float red; vec2 rest[2]; } taken;
out vec4 color;
void main() { color = vec4(taken.red * 4.0, green * factor, (taken.rest[0].y + taken.rest[1].x) * factor - parts[0].part - parts[1].part, 1.0); }
GLSL
succeed shader blocks.vert blocks.frag --run --size 1 -o blocks.png
succeed compare blocks.png want.ppm
sed 's/in Shade/in Light/' blocks.frag >light.frag
refuse 1 "light.frag: the fragment shader reads 'Light', which the vertex shader does not write" \
    shader blocks.vert light.frag --relaxed

# What is declared and not read leaves the picture as it is, in whatever place and however it is interpolated.
cat >sides.vert <<'GLSL'
out vec4 first;
out vec4 second[2];
out vec4 side;
void main()
{
    vec2 corner = vec2(gl_VertexIndex == 1 ? 3 : -1, gl_VertexIndex == 2 ? 3 : -1);
    gl_Position = vec4(corner, 0, 1);
    first = second[0] = second[1] = vec4(0);
    side = vec4(0.5 * corner + 0.5, 0, 1);
}
GLSL
printf 'in vec4 side;\nout vec4 color;\nvoid main() { color = side; }\n' >sides.frag
succeed shader sides.vert sides.frag --run --size 4 -o sides.png
for unread in 'flat in vec4 a;' 'flat in vec4 a, b[28];' 'flat in mat4 a; flat in vec4 b[2];' \
    'struct S { vec2 a; float b[3]; }; flat in S c; flat in S d;' 'layout(location = 3) flat in vec4 a;'; do
    { echo "$unread" && cat sides.frag; } >unread.frag
    succeed shader sides.vert unread.frag --run --size 4 -o unread.png
    succeed compare unread.png sides.png
done

# mainImage, as ShaderToy has it: y points up.
cat >toy.frag <<'GLSL'
/* void main() */ uniform float iTime;
void mainImage(out vec4 color, in vec2 at) // main(
{
    color = vec4(at.x < 0.5 * iResolution.x ? 1 : 0, at.y < 0.5 * iResolution.y ? 1 : 0, iTime, 0);
}
GLSL
succeed shader toy.frag --run --size 2x2 --time 1 -o toy.png
printf 'P6 2 2 255\n\377\000\377\000\000\377\377\377\377\000\377\377' >want.ppm
succeed compare toy.png want.ppm
# Its uniforms, two of them declared: the sizes of textures, the date without a clock, the frame of the time. 1 where one is right.
cat >toys.frag <<'GLSL'
uniform vec3 iChannelResolution[4];
uniform int iFrame;
void mainImage(out vec4 color, in vec2 at)
{
    color.r = float(iChannelResolution[1] == vec3(3, 2, 1) && iChannelResolution[0] == vec3(0) && texture(iChannel1, at).b == 1.0);
    color.g = float(iDate == vec4(1970, 0, 1, 1.5) && iFrame == 90 && iFrameRate * iTimeDelta == 1.0);
    color.b = float(iMouse == vec4(3, 4, 3, 4) && iChannelTime[3] == 1.5 && iSampleRate == 44100.0);
}
GLSL
printf 'P6 3 2 255\n\000\000\377\000\000\377\000\000\377\000\000\377\000\000\377\000\000\377' >wide.ppm
succeed shader toys.frag --run --size 1 --time 1.5 --mouse 3,4 --texture iChannel1=wide.ppm -o toys.png
printf 'P6 1 1 255\n\377\377\377' >want.ppm
succeed compare toys.png want.ppm
# Its pictures stand upright, by coordinates and by texels.
printf 'void mainImage(out vec4 color, in vec2 at) { color = texture(iChannel0, at / iResolution.xy); }\n' >upright.frag
printf 'P6 2 3 255\n123456789abcdefghi' >want.ppm
succeed shader upright.frag --run --size 2x3 --texture iChannel0=want.ppm -o upright.png
succeed compare upright.png want.ppm
printf 'void mainImage(out vec4 color, in vec2 at) { color = texelFetch(iChannel0, ivec2(at), 0); }\n' >upright.frag
succeed shader upright.frag --run --size 2x3 --texture iChannel0=want.ppm -o upright.png
succeed compare upright.png want.ppm
refuse 1 "--texture: 'iChannel1=want.ppm': no shader here uses such a texture; there is iChannel0$" shader upright.frag \
    --run --texture iChannel1=want.ppm -o a.png
sed 's/iTime, 0/iTimes, 0/' toy.frag >bad.frag
refuse 1 "bad.frag:4: 'iTimes' : undeclared identifier" shader bad.frag --run -o a.png

printf 'layout(location = 0) out vec4 c;\nvoid main() { c = vec4(1); }\n' >flat.frag

succeed shader red.vert red.frag -o red.c
check "a program of two shaders" grep -q "red.vert and red.frag" red.c
succeed shader flat.frag -o flat.c
check "a program that covers the picture" grep -q "^const struct rhw_program flat_program" flat.c

# What is wrong is told in one line, and nothing is written.
printf 'void main()\n{\n    foo = 1;\n    bar();\n}\n' >wrong.frag
refuse 1 "wrong.frag:3: 'foo' : undeclared identifier$" shader wrong.frag -o wrong.spv
run shader --all-errors wrong.frag
check "all errors" grep -q "^rhw: wrong.frag:4: 'bar' : no matching overloaded function found$" "$folder/log/err"
printf '#extension GL_none : enable\nvoid main() {}\n' >warned.frag
run shader warned.frag
check "a warning" test "$status:$(cat "$folder/log/err")" = "0:rhw: warned.frag:1: warning: '#extension' : extension not supported: GL_none"
refuse 1 "warned.frag:1: warning: '#extension' : extension not supported: GL_none" shader --strict warned.frag
mkfifo pipe.glsl
printf '#include "pipe.glsl"\nvoid main() {}\n' >piped.comp
refuse 1 "piped.comp:1: '#include' : it is no regular file for header name: pipe.glsl" shader piped.comp --max-time 20
refuse 1 "paint.frag:1: '#include' : there is no such file for header name: tone.glsl" shader paint.frag -D TONE=1
refuse 1 "paint.frag:5: 'non-opaque uniforms outside a block'" shader paint.frag -D TONE=1 -I library
succeed shader paint.frag -D TONE=1 -I library --relaxed
refuse 1 "red.frag: reads red at location 3; a vertex shader beside it gives that" shader red.frag --run -o a.png
printf 'layout(location = 2) in float red;\nlayout(location = 0) out vec4 c;\nvoid main() { c = vec4(red); }\n' >other.frag
refuse 1 "other.frag: the fragment shader reads location 2, component 0, which the vertex shader does not write" shader red.vert other.frag
refuse 1 "red.frag: is a fragment shader, and another is one, too" shader other.frag red.frag
refuse 1 "double.comp: a compute shader goes alone" shader double.comp red.frag
refuse 1 "none.frag: cannot be opened: No such file" shader none.frag
refuse 1 "library.frag: cannot be opened" shader library.frag
head -c 61 double.spv >cut.spv
refuse 1 "cut.spv: a SPIR-V module is a number of whole words, 5 at least" shader cut.spv
head -c 400 double.spv >cut.spv
refuse 1 "cut.spv: " shader cut.spv
printf '\001\000\000\000\001\000\000\000\001\000\000\000\001\000\000\000\001\000\000\000' >cut.spv
refuse 1 "cut.spv: .*magic number" shader cut.spv
: >empty.spv
refuse 1 "empty.spv: a SPIR-V module is a number of whole words" shader empty.spv
# Capability Kernel, in the words behind the header.
{ head -c 20 double.spv; printf '\021\000\002\000\006\000\000\000'; tail -c +29 double.spv; } >kernel.spv
refuse 1 "kernel.spv: word 5, OpCapability: capability 6 is not supported" shader kernel.spv
refuse 1 "double.spv: the module has no compute entry point \"other\"|double.spv: the module has no .* entry point" shader double.spv --entry other
succeed shader flat.frag -o red.spv
refuse 1 "--run: buffer 0:1 has no length of its own; --buffer 0:1=BYTES" shader double.spv --run --result 0:2=f32
refuse 1 "--buffer: '0:7=4': no shader here uses such a buffer; there is [^ ]+, [^ ]+$" shader double.spv --run --buffer 0:7=4 --buffer 0:1=4 \
    --buffer 0:2=4 --result 0:2=f32
refuse 1 "--texture: 'Sink=four.ppm': no shader here uses such a texture; there is none$" shader double.spv --run --buffer 0:1=4 \
    --buffer 0:2=4 --texture Sink=four.ppm --result 0:2=f32
refuse 1 "--constant: '9=1': double.spv has no constant 9" shader double.spv --constant 9=1
refuse 1 "--constant: '4=0.5': constant 4 of double.spv is a whole number" shader double.spv --constant 4=0.5
refuse 1 "--push: no shader here has push constants" shader red.spv --run --push u32:1 -o a.png
refuse 1 "--buffer: '0:2=0': a buffer has 1 to" shader double.spv --run --buffer 0:1=4 --buffer 0:2=0 --result 0:2=f32
refuse 1 "--buffer: '0:2=f32:1,x': number 2 is no f32" shader double.spv --run --buffer 0:1=4 --buffer 0:2=f32:1,x --result 0:2=f32
refuse 1 "standard input: is not read: the name of a shader's file tells what it is; it ends with .vert" shader -
refuse 1 "--result: 'Sinks=f32': no shader here uses such a buffer or storage image; there is [^ ]+, Sink$" shader double.spv --run --buffer 0:1=4 \
    --buffer 0:2=4 --result Sinks=f32
refuse 1 "none/sink.bin: cannot be written" shader double.spv --run --buffer 0:1=4 --buffer 0:2=4 --result Sink=none/sink.bin \
    --result 0:2=f32
refuse 2 "--result: 'Sink=f16': f16 is not f32, i32 or u32, and the name of a file has a point or a slash" shader double.spv \
    --run --buffer 0:1=4 --buffer 0:2=4 --result Sink=f16
refuse 1 "wrong.txt: a shader's file is named .vert, .frag, .comp \(GLSL\) or .spv" shader wrong.txt
refuse 1 "'2' cannot be defined: a macro's name has letters" shader red.frag -D 2

refuse 2 "--run: of a compute shader needs --result" shader double.spv --run
refuse 2 "--run: of a fragment shader needs -o" shader red.spv --run
refuse 2 "red.vert: a vertex shader runs with a fragment shader beside it" shader red.vert --run -o a.png
refuse 2 "a.png: a compute shader has no picture" shader double.spv --run --result 0:2=f32 -o a.png
refuse 2 "a.png: SPIR-V is named .spv, and C .c; a picture, .png, is drawn with --run" shader red.frag -o a.png
refuse 2 "a.spv: a picture of --run is named .png" shader red.frag --run -o a.spv
refuse 2 "a.spv: SPIR-V is written of one FILE" shader red.vert red.frag -o a.spv
refuse 2 "--print: 'glsl' is not info, spirv, ir, bytecode or code" shader red.frag --print glsl
refuse 2 "--json: goes with --print info alone" shader red.frag --json --print ir
refuse 2 "--after: goes with --print ir alone" shader red.frag --after build
refuse 2 "--time: goes with --run alone" shader red.frag --time 1
refuse 2 "--run: prints results alone" shader double.spv --run --json --result 0:2=f32
refuse 2 "--constant: '3' is not ID=NUMBER" shader double.comp --constant 3
refuse 2 "--buffer: '1=4' is not SET:BINDING=VALUE, with a SET of 0 to 7, and not NAME=VALUE" shader double.spv --run --buffer 1=4
refuse 2 "--result: '8:1=f32' is not SET:BINDING=VALUE" shader double.spv --run --result 8:1=f32
refuse 2 "--groups: '1,2,3,4' is not X,Y,Z, each 0 to 65535" shader double.spv --run --groups 1,2,3,4
refuse 2 "--threads: '0' is not a number of 1 to 64" shader red.frag --run --threads 0
refuse 2 "shader: expected FILE" shader
refuse 2 "red.frag: one argument too many" shader red.vert red.vert red.frag

# A loop without end is given up.
printf 'layout(location = 0) out vec4 c;\nvoid main() { int i = 0; while (i < 1 + int(gl_FragCoord.x)) { i *= 2; } c = vec4(i); }\n' >endless.frag
refuse 1 "endless.frag: " shader endless.frag --run --size 8 --max-time 0.2 -o a.png
no_temporary_files

finish
