#!/bin/sh
# SPDX-License-Identifier: MIT
# rhw render --fragment-shader: what a shader reads and writes, what it does not shade, and files that are none.
. "$(dirname "$0")/harness.sh"

# Two squares beside each other, the left one half transparent, which face the camera and lie in x, y of -1 to 1.
cat >squares.mtl <<'MTL'
newmtl glass
Kd 0.5 0.25 1
d 0.5
newmtl plain
Kd 1 0.5 0.25
MTL
cat >squares.obj <<'OBJ'
mtllib squares.mtl
v -1 -1 0
v 0 -1 0
v 0 1 0
v -1 1 0
v 1 -1 0
v 1 1 0
vt 0.25 0.75
usemtl glass
f 1/1 2/1 3/1 4/1
usemtl plain
f 2/1 5/1 6/1 3/1
OBJ
front="--ortho --camera 0,0,5,0,0,0,0,1,0,2 --size 4x4 --samples 1 --background black --ambient-occlusion off"

words_of() { # BODY: a shader that declares all there is
    "$rhw" render --fragment-shader-template | sed '/^void main/,$d'
    printf 'void main()\n{\n    %s\n}\n' "$1"
}

# The color of a column of the picture that a shader draws, red green blue.
pixel() { # COLUMN OPTION...
    column=$1
    shift
    "$rhw" render squares.obj -o - --format ppm $front --fragment-shader "$@" 2>"$folder/log/err" |
        tail -c 48 | od -An -v -tu1 -w3 | sed -n "$((column + 1))p" | tr -s ' ' | sed 's/^ //'
}

draws() { # COLUMN COLOR BODY
    words_of "$3" >body.frag
    check "column $1 of $3" test "$(pixel "$1" body.frag)" = "$2"
}

words_of 'color = vec4(1);' >body.frag
"$rhw" render squares.obj -o - --fragment-shader body.frag >/dev/null 2>"$folder/log/err"
if grep -q "built without glslang" "$folder/log/err"; then
    refuse 1 "body.frag: this rhw was built without glslang" render squares.obj -o a.png --fragment-shader body.frag
    finish
fi

# Colors are linear, and neither lit nor tone-mapped; alpha counts where the material blends, over black.
draws 3 "255 0 188" 'color = vec4(1, 0, 0.5, 1);'
draws 3 "255 0 188" 'color = vec4(1, 0, 0.5, 0.25);'
draws 0 "188 0 0" 'color = vec4(1, 0, 0, 0.5);'
# What there is to read.
draws 3 "255 128 64" 'color = vec4(base_color.rgb, 1);' # of sRGB in the file
draws 0 "0 0 188" 'color = vec4(0, 0, 1, base_color.a);'
draws 3 "188 188 255" 'color = vec4(0.5 + 0.5 * normal, 1);'
draws 3 "225 137 0" 'color = vec4(position.xy * vec2(1, 1.0 / 3.0), position.z, 1);'
draws 3 "137 137 255" 'color = vec4(uv, 1, 1);'
draws 3 "255 255 255" 'color = vertex_color * texture(base_color_texture, uv);'
draws 3 "0 0 255" 'color = vec4(camera.w, camera.xz, 1);'
draws 3 "255 0 0" 'color = vec4(dot(light.xyz, light.xyz) > 0.999 && light.z > 0.0 ? 1 : 0, light.w, 0, 1);'
draws 3 "255 0 0" 'if (position.x < 0.5) { discard; } color = vec4(1, 0, 0, 1);'
draws 2 "0 0 0" 'if (position.x < 0.75) { discard; } color = vec4(1, 0, 0, 1);'

# A text as OpenGL has it says what things are called alone, in any order.
cat >loose.frag <<'GLSL'
uniform vec4 base_color;
uniform sampler2D base_color_texture;
uniform vec4 camera;
in vec4 vertex_color;
in vec2 uv;
in vec3 normal;
out vec4 c;
void main() { c = vec4((0.5 + 0.5 * normal.z) * camera.x, base_color.g, vertex_color.b * texture(base_color_texture, uv).b, 1); }
GLSL
check "names" test "$(pixel 3 loose.frag)" = "0 128 255"

# The template and the shader of the document draw; the picture is one at every thread count, and from SPIR-V.
succeed render --fragment-shader-template
cp "$folder/log/out" mine.frag
succeed render squares.obj -o mine.png --size 64 --fragment-shader mine.frag
succeed render squares.obj -o one.png --size 64 -j 1 --isa baseline --fragment-shader mine.frag
check "one picture" cmp mine.png one.png
succeed render squares.obj -o materials.png --size 64
check "another than that of materials" sh -c "! cmp -s mine.png materials.png"
sed -n '/^```glsl/,/^```$/{/^```/d;p}' "$root/docs/outputs.md" >toon.frag
succeed render squares.obj -o toon.png --size 64 --fragment-shader toon.frag
succeed shader mine.frag -o mine.spv
succeed render squares.obj -o spirv.png --size 64 --fragment-shader mine.spv
check "SPIR-V" cmp mine.png spirv.png
succeed render squares.obj -o 'view-{view}.png' --size 32 --views front,back --fragment-shader mine.frag

# What it does not shade, and other outputs, are as without it.
words_of 'color = vec4(0, 1, 0, 1);' >green.frag
printf 'v 0 0 0\nv 1 1 0\nv 2 0 0\nl 1 2 3\n' >lines.obj
succeed render lines.obj -o lines.png --size 32
succeed render lines.obj -o other.png --size 32 --fragment-shader green.frag
check "lines" cmp lines.png other.png
succeed render squares.obj -o depth.exr --output depth,object --size 16
succeed render squares.obj -o other.exr --output depth,object --size 16 --fragment-shader green.frag
check "other outputs" cmp depth.exr other.exr

# What is wrong.
words_of 'color = vec4(nothing);' >wrong.frag
line=$(grep -n nothing wrong.frag | cut -d : -f 1)
refuse 1 "wrong.frag:$line: 'nothing' : undeclared identifier" render squares.obj -o a.png --fragment-shader wrong.frag
refuse 1 "none.frag: cannot be opened: No such file" render squares.obj -o a.png --fragment-shader none.frag
refuse 1 "squares.obj: a shader's file is named .vert, .frag" render squares.obj -o a.png --fragment-shader squares.obj
echo 'void main() { gl_Position = vec4(0); }' >a.vert
refuse 1 "a.vert: is a vertex shader, and no fragment shader" render squares.obj -o a.png --fragment-shader a.vert
see="rhw render --fragment-shader-template shows what there is"
while read -r wanted text; do
    echo "layout(location = 0) out vec4 color; $text" >bad.frag
    refuse 1 "bad.frag: $(echo "$wanted" | tr _ ' '); $see" render squares.obj -o a.png --fragment-shader bad.frag
done <<'BAD'
there_is_nothing_for_'t'_at_set_0,_binding_7;_set_0_has_a_uniform_block_at_binding_0_and_a_sampler2D_at_binding_1 layout(binding = 7) uniform sampler2D t; void main() { color = texture(t, vec2(0)); }
'B'_at_set_0,_binding_1_is_no_sampler2D,_which_is_what_is_there layout(binding = 1) uniform B { vec4 b; }; void main() { color = b; }
'B'_at_set_0,_binding_0_is_no_uniform_block,_which_is_what_is_there layout(binding = 0) buffer B { vec4 b; }; void main() { color = b; }
'B'_at_set_0,_binding_0_has_1584_bytes,_and_the_block_that_is_there_96 layout(binding = 0) uniform B { vec4 b[99]; }; void main() { color = b[98]; }
'c'_at_set_0,_binding_1_is_no_sampler2D,_which_is_what_is_there layout(binding = 1) uniform samplerCube c; void main() { color = texture(c, vec3(1)); }
't'_at_set_0,_binding_1_is_an_array,_and_there_is_one layout(binding = 1) uniform sampler2D t[2]; void main() { color = texture(t[1], vec2(0)); }
has_push_constants,_which_nothing_sets layout(push_constant) uniform P { vec4 p; }; void main() { color = p; }
writes_'more',_a_vec4_at_location_1,_and_only_a_vec4_at_location_0_is_drawn layout(location = 1) out vec4 more; void main() { color = more = vec4(1); }
reads_'a'_at_location_5,_and_the_last_input_is_at_3 layout(location = 5) in vec4 a; void main() { color = a; }
reads_'a'_at_location_2_as_a_vec4,_and_uv_is_there,_a_vec2 layout(location = 2) in vec4 a; void main() { color = a; }
there_is_no_input_'tangent',_and_what_has_no_location_or_binding_goes_by_its_name in vec4 tangent; void main() { color = tangent; }
there_is_no_uniform_'time',_and_what_has_no_location_or_binding_goes_by_its_name uniform float time; void main() { color = vec4(time); }
there_is_no_block_or_texture_'wood',_and_what_has_no_location_or_binding_goes_by_its_name uniform sampler2D wood; void main() { color = texture(wood, vec2(0)); }
uniform_'camera'_is_a_vec3,_and_there_it_is_a_vec4 uniform vec3 camera; void main() { color = vec4(camera, 1); }
BAD
echo 'void main() {}' >bad.frag
refuse 1 "bad.frag: writes no colour, which is a vec4 at location 0; $see" render squares.obj -o a.png --fragment-shader bad.frag
echo 'layout(location = 0) out vec4 color; void main() {}' >black.frag
check "what is not written is 0" "$rhw" render squares.obj -o a.png --fragment-shader black.frag
echo 'void mainImage(out vec4 color, vec2 at) { color = vec4(1); }' >bad.frag
refuse 1 "bad.frag: has mainImage\(\) and no main\(\): it covers a picture, which rhw shader --run draws; what shades models has" \
    render squares.obj -o a.png --fragment-shader bad.frag
rule="render: fragment shader: has no light before tone mapping, no wireframe, no noperspective and no exact transparency"
refuse 2 "$rule" render squares.obj -o a.exr --fragment-shader green.frag
for option in --wireframe --interpolate=noperspective --transparency=exact; do
    refuse 2 "$rule" render squares.obj -o a.png --fragment-shader green.frag $option
done
refuse 2 "--fragment-shader: cannot be explained" explain squares.obj --at 1,1 --fragment-shader green.frag
refuse 2 "--fragment-shader-template: is an option of rhw render" explain squares.obj --at 1,1 --fragment-shader-template
no_temporary_files
finish
