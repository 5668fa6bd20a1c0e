#!/bin/sh
# SPDX-License-Identifier: MIT
# rhw render does what its help says: names, formats, sizes, outputs, statistics; and models that cannot be
# drawn end in one line.
. "$(dirname "$0")/harness.sh"
make_cube cube
view="--size 96x64"

# Byte OFFSET, COUNT bytes of a file, as decimal numbers on one line.
bytes() {
    echo $(od -A n -t u1 -j "$2" -N "$3" "$1")
}

equal() { # A B: as pictures
    "$rhw" compare "$1" "$2" >/dev/null 2>&1
}

# PNG: size, bits and colour type stand in the header at 16..25.
succeed render cube.obj $view -o a.png
check "PNG header" test "$(bytes a.png 16 10)" = "0 0 0 96 0 0 0 64 8 2"
succeed render cube.obj $view -o t.png --background transparent
check "transparent PNG header" test "$(bytes t.png 16 10)" = "0 0 0 96 0 0 0 64 8 6"
succeed render cube.obj $view -o d.png --output depth
check "depth is 16 bit grey" test "$(bytes d.png 24 2)" = "16 0"
succeed render cube.obj $view -o d8.png --output depth --bits 8
check "depth in 8 bits" test "$(bytes d8.png 24 2)" = "8 0"
succeed render cube.obj $view -o n16.png --output normal --bits 16
check "normals in 16 bits" test "$(bytes n16.png 24 2)" = "16 2"

# What shows the work: the same with any threads, into all kinds of files and on sheets.
for threads in 1 2; do
    succeed render cube.obj $view -o work-$threads.png --output overdraw,tiles --threads $threads
done
for output in overdraw tiles; do
    check "$output with any threads" cmp -s work-1.$output.png work-2.$output.png
done
check "the most is told" sh -c "grep -a -q 'surfaces above each other: black is none, white is 2' work-1.overdraw.png"
succeed render cube.obj $view -o work.exr --output overdraw,tiles,plan
for channel in overdraw.count tiles.triangles plan.bits; do
    check "EXR has $channel" grep -a -q $channel work.exr
done
succeed render cube.obj $view -o sheet.png --output plan --views front,top
refuse 2 "render: transparency: of exact there is no one pass" render cube.obj -o a.png --output tiles --transparency exact
succeed render cube.obj -o A.PNG
check "default size" test "$(bytes A.PNG 16 8)" = "0 0 5 0 0 0 2 208"

# The same picture through every door.
succeed render cube.obj $view -o a.ppm
check "PPM header" test "$(head -c 13 a.ppm | tr '\n' ' ')" = "P6 96 64 255 "
check "PPM equals PNG" equal a.ppm a.png
succeed render cube.obj $view -o n16.ppm --output normal --bits 16
check "PPM equals PNG in 16 bits" equal n16.ppm n16.png
run render cube.obj $view -o -
check "standard output is the PNG file" cmp -s a.png "$folder/log/out"
succeed render cube.obj $view --format png -o plain
check "--format names the format" cmp -s a.png plain
succeed render $view -o again.png cube.obj
check "options stand anywhere" cmp -s a.png again.png
succeed render cube.obj $view -o c16.png --bits 16 --samples 1 --background white
succeed render cube.obj $view -o one.png --samples 1 --background white
check "16 bit colour" test "$(bytes c16.png 24 2)" = "16 2"
check "16 bit colour rounds to the 8 bit one" "$rhw" compare one.png c16.png --tolerance 0.501/255 >"$folder/log/compare"
if equal one.png c16.png; then
    fail "16 bit colour has no more precision than 8 bits"
fi

# The background has 16 bits too: a run of the code 257 · (134 − 68 (row + ½) / 64) without dither.
succeed render cube.obj $view -o c16.ppm --bits 16
tail -c 36864 c16.ppm | od -A n -v -t u1 -w576 | awk '
    { code = 257 * (134 - 68 * (NR - 0.5) / 64); red = 256 * $1 + $2
      if (red < code - 1 || red > code + 1 || red != 256 * $7 + $8) print NR, red, code }' >uneven
check "the background has 16 bits" test ! -s uneven

# Any number of threads, any instruction set, the same bytes.
succeed render cube.obj $view -o all.exr --output all
for threads in 1 2 5 64; do
    succeed render cube.obj $view -o same.png --threads $threads
    check "$threads threads" cmp -s a.png same.png
    succeed render cube.obj $view -o same.exr --output all --threads $threads
    check "$threads threads, EXR" cmp -s all.exr same.exr
done
for paths in all in-order general; do
    succeed render cube.obj $view -o same.png --paths $paths --stats=paths.json
    check "$paths paths" cmp -s a.png same.png
done
for isa in baseline avx2 avx512; do
    run render cube.obj $view -o same.png --isa $isa
    if [ $status = 0 ]; then
        check "isa $isa" cmp -s a.png same.png
    else
        check "isa $isa is missing" grep -q "^rhw: --isa: this computer or this build has no $isa" "$folder/log/err"
    fi
done

# Several outputs: names, and a single one of them is the same picture.
mkdir set
succeed render cube.obj $view -o set/x.png --output all
check "names of a set" test "$(ls set | tr '\n' ' ')" = \
    "x.bary.png x.depth.png x.distance.png x.normal.png x.object.png x.png x.position.png x.triangle.png x.uv.png "
check "depth in a set" cmp -s set/x.depth.png d.png
check "colour in a set" cmp -s set/x.png a.png
mkdir braces
succeed render cube.obj $view -o 'braces/a-{}.v1.ppm' --output color,uv
check "names with braces" test "$(ls braces | tr '\n' ' ')" = "a-color.v1.ppm a-uv.v1.ppm "
succeed render cube.obj $view -o 'braces/{}.png' --output bary
check "one name with braces" test -f braces/bary.png
succeed render cube.obj $view -o whole.png --output barycentric
check "barycentric is bary" cmp whole.png braces/bary.png
rm whole.png
for output in normal position uv object triangle bary; do
    for other in normal position uv object triangle bary; do
        [ $output = $other ] || ! equal set/x.$output.png set/x.$other.png || fail "$output and $other look alike"
    done
done

# EXR: all layers, and those of a part alone are the same numbers.
succeed compare all.exr all.exr
for channel in R G B A depth.Z distance.Z normal.X normal.Y normal.Z normal.A position.X position.Y position.Z \
    position.A uv.U uv.V object.id triangle.id bary.a bary.b bary.c; do
    check "EXR channel $channel" grep -q "^$channel " "$folder/log/out"
done
check "21 EXR channels" test "$(wc -l <"$folder/log/out")" = 23
# To a pipe as into a file; with the camera and the names of objects.
"$rhw" render cube.obj $view --format exr -o - --output all | cat >pipe.exr
check "EXR to a pipe" cmp -s pipe.exr all.exr
succeed render cube.obj -o camera.exr --size 32 --camera 1,2,5,1,2,0,0,1,0,90
matrix() { # NAME NUMBER: a float of a matrix in camera.exr, in hexadecimal
    at=$(grep -abo "$1" camera.exr | head -n 1 | cut -d : -f 1)
    od -A n -t x4 -j $((at + ${#1} + 1 + 5 + 4 + 4 * $2)) -N 4 camera.exr | tr -d ' '
}
check "worldToCamera moves by -1 -2 -5" test "$(matrix worldToCamera 12) $(matrix worldToCamera 13) $(matrix worldToCamera 14)" = \
    "bf800000 c0000000 c0a00000"
check "worldToNDC at 90 degrees" test "$(matrix worldToNDC 0) $(matrix worldToNDC 5)" = "3f800000 3f800000"
check "objectNames" grep -aq objectNames camera.exr
# A node's name, or where it has none its mesh's, or none; in the order of ids.
cat >names.gltf <<'GLTF'
{"asset": {"version": "2.0"}, "nodes": [{"mesh": 0, "name": "chair"}, {"mesh": 0}, {"mesh": 1}, {"mesh": 0, "name": ""}],
 "meshes": [{"name": "seat", "primitives": [{"attributes": {"POSITION": 0}}, {"attributes": {"POSITION": 0}}]},
            {"primitives": [{"attributes": {"POSITION": 0}}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36,
  "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]}
GLTF
succeed render names.gltf -o names.exr --size 16
if command -v python3 >/dev/null 2>&1; then
    check "names of nodes and meshes" python3 - <<'PYTHON'
import struct

data = open("names.exr", "rb").read()
at = data.index(b"objectNames\0stringvector\0") + len(b"objectNames\0stringvector\0")
end = at + 4 + struct.unpack_from("<i", data, at)[0]
names, at = [], at + 4
while at < end:
    (length,) = struct.unpack_from("<i", data, at)
    names.append(data[at + 4 : at + 4 + length])
    at += 4 + length
assert names == [b"chair", b"seat", b"", b"seat"], names
PYTHON
fi
succeed render cube.obj $view -o some.exr --output depth,triangle
refuse 1 "some.exr: has no channel" compare all.exr some.exr

# Models of any size have one picture: the light is not lost with the square of a length, nor is ambient occlusion in a
# corner. The planes of shadow maps leave more room around small ones, which moves single pixels.
corner() { # LENGTH: three faces that meet
    for place in "0 0 0" "$1 0 0" "$1 0 $1" "0 0 $1" "0 $1 0" "$1 $1 0" "0 $1 $1"; do
        echo "v $place"
    done
    printf 'f 1 4 3 2\nf 1 2 6 5\nf 1 5 7 4\n'
}
corner 1 >corner.obj
succeed render corner.obj --size 64 -o corner.png
for length in 8.8817841970012523e-16 8.4703294725430034e-22 8.0779356694631609e-28 1180591620717411303424 1.2379400392853803e27; do
    corner "$length" >any.obj
    succeed render any.obj --size 64 -o any.png
    check "a model of $length" "$rhw" compare corner.png any.png --tolerance 0.0157 >"$folder/log/compare"
done
for near in 0.01 1e-20; do
    cat >near.gltf <<EOF
{"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}, {"camera": 0, "translation": [0, 0, 3]}], "scenes": [{"nodes": [0, 1]}],
 "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": $near}}],
 "materials": [{"pbrMetallicRoughness": {"metallicFactor": 0.5, "roughnessFactor": 0.3}}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [-1, -1, 0], "max": [1, 1, 0]}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}],
 "buffers": [{"byteLength": 36, "uri": "data:;base64,AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAACAPwAAgD8AAAAA"}]}
EOF
    succeed render near.gltf --size 64 -o "near$near.png"
done
check "a near plane at 1e-20" "$rhw" compare near0.01.png near1e-20.png --tolerance 0.0157 >"$folder/log/compare"

# Options that must show in the picture.
differs() { # DESCRIPTION OPTION...
    checks=$((checks + 1))
    description=$1
    shift
    succeed render cube.obj $view -o other.png "$@"
    equal a.png other.png && fail "$description does not show"
}
differs "--samples" --samples 16
differs "--supersample" --supersample 16
differs "--wireframe" --wireframe
differs "--wireframe=plain" --wireframe=plain
differs "--orbit" --orbit 200,10
differs "--camera" --camera 0,0,9,0,0,0,0,1,0,30
differs "--fovy" --fovy 80
differs "--zoom" --zoom 2
differs "--margin" --margin 20
differs "--ortho" --ortho
differs "--orbit with one angle" --orbit 200
differs "--lights none" --lights none
succeed render cube.obj $view -o other.png --orbit 200,20
succeed render cube.obj $view -o one.png --orbit 200
check "one angle of --orbit is the azimuth, from 20 degrees" equal other.png one.png
succeed render cube.obj --size 64 -o square.png
check "--size N is a square" test "$(bytes square.png 16 8)" = "0 0 0 64 0 0 0 64"
succeed render cube.obj $view -o other.ppm --background '#f00'
check "three digits of a colour" test "$(bytes other.ppm 13 3)" = "255 0 0"
succeed render cube.obj $view -o other.ppm --background skyblue
check "a colour by name" test "$(bytes other.ppm 13 3)" = "135 206 235"
# A camera that was printed draws the picture again.
succeed render cube.obj $view -o one.png --orbit 50,10 --zoom 1.5 --print-camera
succeed render cube.obj $view -o other.png $(cat "$folder/log/out")
succeed compare one.png other.png --tolerance 2
succeed render cube.obj $view -o one.png --ortho --orbit 50,10 --zoom 1.5 --print-camera
check "it says that it has no perspective" grep -Eq '^--ortho --camera ([-0-9.e]+,){9}[0-9.]+$' "$folder/log/out"
succeed render cube.obj $view -o other.png $(cat "$folder/log/out")
succeed compare one.png other.png --tolerance 2
succeed render cube.obj -o square.ppm --size 64 --samples 1 --background black --output object --ortho \
    --camera 0,0,9,0,0,0,0,1,0,4
check "the tenth number is the height then" test "$(tail -c 12288 square.ppm | od -An -v -tu1 -w3 | grep -cv '^ *0 *0 *0$')" = 1024
# A picture fits its frame exactly without a margin and perspective: the cube from its front is a square.
succeed render cube.obj --size 64 -o front.ppm --ortho --margin 0 --orbit 0,0 --background black --samples 1
check "no margin" test "$(bytes front.ppm 13 3)" != "0 0 0"
# Without -o the picture has the model's name, beside us and not over a file.
mkdir -p sub && cp cube.mtl sub/ && cp cube.obj sub/named.obj
succeed sub/named.obj $view
check "a model by itself is drawn" equal a.png named.png
refuse 2 "named.png: is there already; name the picture by -o OUT" render sub/named.obj
# JPEG and WebP: what other programs make of them is what was drawn.
succeed render cube.obj $view -o a.webp
check "WebP header" test "$(head -c 4 a.webp)$(bytes a.webp 8 4)" = "RIFF87 69 66 80"
succeed render cube.obj $view -o a.jpg
check "JPEG header" test "$(bytes a.jpg 0 2)" = "255 216"
succeed render cube.obj $view -o low.jpg --quality 10
check "a lower quality is smaller" test "$(wc -c <low.jpg)" -lt "$(wc -c <a.jpg)"
succeed render cube.obj $view -o t.webp --background transparent
succeed render cube.obj $view -o d.jpg --output depth
if command -v dwebp >/dev/null && command -v djpeg >/dev/null; then
    dwebp -quiet a.webp -ppm -o back.ppm && check "WebP is lossless" equal a.png back.ppm
    djpeg a.jpg >back.ppm && succeed compare a.png back.ppm --tolerance 24
fi
refuse 2 "--background: a JPEG file cannot be transparent" render cube.obj -o b.jpg --background transparent
refuse 2 "--bits: a WebP file always holds 8 bits per sample" render cube.obj -o b.webp --bits 16
refuse 2 "--quality: is for JPEG and WebP files" render cube.obj -o b.png --quality 50
refuse 2 "--size: a WebP file has at most 16383 pixels" render cube.obj -o b.webp --size 16384
refuse 2 "--zoom: '0' is not a factor" render cube.obj -o b.png --zoom 0
refuse 2 "--margin: '50' is not a percentage of 0 to 45" render cube.obj -o b.png --margin 50
refuse 2 "--zoom: cannot be together with --camera" render cube.obj -o b.png --zoom 2 --camera 0,0,9,0,0,0,0,1,0,30
refuse 2 "--ortho: cannot be together with --fovy" render cube.obj -o b.png --ortho --fovy 20
differs "--background" --background black
differs "--exposure" --exposure=-2
# A step: its upper edge casts a shadow and its corner is dark.
cat >step.obj <<'OBJ'
v -2 0 2
v 2 0 2
v 2 0 0
v -2 0 0
v 2 2 0
v -2 2 0
v 2 2 -1
v -2 2 -1
v -1 0 1
v -1 1 1
v -1 1 0.5
v -1 0 0.5
f 1 2 3 4
f 4 3 5 6
f 6 5 7 8
f 9 10 11 12
f 12 11 10 9
OBJ
succeed render step.obj $view -o a.png
for light in shadows ambient-occlusion; do
    succeed render step.obj $view -o other.png --$light off
    equal a.png other.png && fail "--$light does not show"
    succeed render step.obj $view -o other.png --$light on
    check "--$light is on by default" equal a.png other.png
done
succeed render cube.obj $view -o a.png
# A panorama of 4 × 2 texels, red on one side.
{
    printf '#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 4\n'
    printf '\377\100\100\201\377\100\100\201\100\100\377\201\100\100\377\201'
    printf '\377\100\100\201\377\100\100\201\100\100\377\201\100\100\377\201'
} >sky.hdr
differs "--environment" --environment sky.hdr
for tone in aces agx none; do
    differs "--tone-map $tone" --tone-map $tone
done
succeed render cube.obj $view -o a.png --environment sky.hdr
differs "--environment-rotation" --environment sky.hdr --environment-rotation 90
differs "--background environment" --environment sky.hdr --background environment
# The same light as a DDS of floats.
{
    printf 'DDS \174\000\000\000\007\020\000\000\002\000\000\000\004\000\000\000'
    head -c 56 /dev/zero
    printf '\040\000\000\000\004\000\000\000DX10'
    head -c 40 /dev/zero
    printf '\002\000\000\000\003\000\000\000\000\000\000\000\001\000\000\000\000\000\000\000'
    for texel in red red blue blue red red blue blue; do
        [ $texel = red ] || printf '\000\000\000\077\000\000\000\077\000\000\377\077\000\000\200\077'
        [ $texel = blue ] || printf '\000\000\377\077\000\000\000\077\000\000\000\077\000\000\200\077'
    done
} >sky.dds
succeed render cube.obj $view -o a.png --environment sky.hdr
succeed render cube.obj $view -o b.png --environment sky.dds
check "an environment of DDS" cmp -s a.png b.png
rm b.png
succeed render cube.obj $view -o other.exr --environment sky.hdr
succeed render cube.obj $view -o a.png --environment other.exr
succeed render cube.obj $view -o a.png
refuse 1 "nowhere.hdr: cannot be opened: No such file" render cube.obj -o a.png --environment nowhere.hdr
refuse 1 "a.png: an environment must be a Radiance HDR or an OpenEXR picture" render cube.obj -o b.png --environment a.png
printf 'version https://git-lfs.github.com/spec/v1\noid sha256:00\nsize 1\n' > pointer.hdr
refuse 1 "pointer.hdr: is a Git LFS pointer, not the file \(git lfs pull\)" render cube.obj -o b.png --environment pointer.hdr
refuse 1 "cube.mtl: an environment must be a Radiance HDR or an OpenEXR picture" render cube.obj -o b.png --environment cube.mtl
: >empty.hdr
refuse 1 "empty.hdr: the file is empty" render cube.obj -o b.png --environment empty.hdr
refuse 1 "\.: Is a directory" render cube.obj -o b.png --environment .
head -c 60 sky.hdr >cut.hdr
refuse 1 "cut.hdr: the Radiance HDR file ends too early" render cube.obj -o b.png --environment cut.hdr
check "nothing is left of a failure" test ! -e b.png
succeed render cube.obj $view -o other.png --fit
check "--fit is the default here" equal a.png other.png
succeed render cube.obj $view -o other.png --output uv --camera 0,0,4,0,0,0,0,1,0,60
succeed render cube.obj $view -o wrong.png --output uv --camera 3,3,3,0,0,0,0,1,0,60 --interpolate noperspective
succeed render cube.obj $view -o right.png --output uv --camera 3,3,3,0,0,0,0,1,0,60
equal wrong.png right.png && fail "--interpolate does not show"
succeed render cube.obj $view -o color.ppm --background '#fF8001'
check "background colour" test "$(bytes color.ppm 13 3)" = "255 128 1"
succeed render cube.obj $view -o color.ppm --background grey
check "background by name" test "$(bytes color.ppm 13 3)" = "128 128 128"

# Cameras of the file: the first looks away, the second at the triangle.
cat >cameras.gltf <<'GLTF'
{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2]}],
 "nodes": [{"mesh": 0}, {"name": "away", "camera": 0, "translation": [0, 0, -5]},
           {"name": "front", "camera": 0, "translation": [0, 0, 5]}],
 "cameras": [{"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1}}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}],
 "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]}
GLTF
succeed render cameras.gltf $view -o front.png --camera-index 1
succeed render cameras.gltf $view -o name.png --camera-name front
check "index and name choose the same camera" cmp -s front.png name.png
succeed render cameras.gltf $view -o fit.png --fit
equal front.png fit.png && fail "--camera-index does not show"
run render cameras.gltf $view -o first.png
check "a camera that sees nothing is not taken" equal first.png fit.png
check "and said so" grep -q "^rhw: cameras.gltf: warning: its camera sees nothing" "$folder/log/err"
sed 's/\[0, 0, -5\]/[0.3, 0.3, 90]/' cameras.gltf >dot.gltf
run render dot.gltf $view -o dot.png
check "a camera in which the model is a dot is not taken" equal dot.png fit.png
check "and said so" grep -q "^rhw: dot.gltf: warning: its camera sees next to nothing" "$folder/log/err"
run render cameras.gltf $view -o first.png --camera-index 0
check "unless it was asked for" grep -q "^rhw: cameras.gltf: warning: nothing of the model is in" "$folder/log/err"
run render cameras.gltf $view -o first.png --camera 0,0,90,0,0,0,0,1,0,30
check "a dot that was asked for" \
    grep -q "^rhw: cameras.gltf: warning: next to nothing of the model is in" "$folder/log/err"
refuse 1 "cameras.gltf: next to nothing of the model is in the picture; --strict allows no such picture" \
    render cameras.gltf $view -o none.png --strict --camera 0,0,90,0,0,0,0,1,0,30
refuse 1 "cameras.gltf: nothing of the model is in the picture; --strict allows no such picture" \
    render cameras.gltf $view -o none.png --strict --quiet --camera-index 0
for each in cameras dot; do
    refuse 1 "$each.gltf: its camera does not show the model; --strict lets none take its place, --fit does" \
        render $each.gltf $view -o none.png --strict
    refuse 1 "$each.gltf: its camera does not show the model" \
        render $each.gltf $view -o 'none-{frame}.png' --turntable 2 --strict --quiet
done
succeed render cameras.gltf $view -o first.png --strict --fit
check "nothing is left of them" test ! -e none.png -a ! -e none-0000.png
# A triangle that the usual view sees from its edge.
cat >edge.obj <<'OBJ'
v 0 0 0
v .469846310 .342020143 .813797681
v 1.10094856 .171010072 -.093101160
f 1 2 3
OBJ
succeed render edge.obj $view -o edge.png --strict
refuse 1 "edge.obj: nothing of the model is in the picture" render edge.obj $view -o none.png --strict --orbit 30,20

# A camera of the file that stands beside the triangle, one within a cube's bounds, and what is said of neither.
partial="the file's camera shows part of the model; --fit shows all"
sed 's/"translation": \[0, 0, -5\]/"translation": [-0.18, 0, 1]/' cameras.gltf >beside.gltf
run render beside.gltf $view -o part.png
check "a partial view" grep -q "^rhw: beside.gltf: warning: $partial$" "$folder/log/err"
check "is said once" test "$(wc -l <"$folder/log/err")" = 1
run render beside.gltf $view -o part.png --camera-index 0
check "a partial view that was asked for" test ! -s "$folder/log/err"
succeed render beside.gltf $view -o part.png --quiet
sed 's/"translation": \[0, 0, -5\]/"translation": [0, 0, 5]/' cameras.gltf >whole.gltf
run render whole.gltf $view -o part.png
check "a whole view" test ! -s "$folder/log/err"
refuse 2 "--camera-index: cameras.gltf has the cameras 0..1 only" render cameras.gltf -o x.png --camera-index 2
refuse 2 "--camera-name: cameras.gltf has no camera named 'side'" render cameras.gltf -o x.png --camera-name side

# --orbit fits, so that --fit beside it says nothing else, in either order.
succeed render cube.obj $view -o orbit.png --orbit 10,50
succeed render cube.obj $view -o after.png --orbit 10,50 --fit
succeed render cube.obj $view -o before.png --fit --orbit 10,50
check "--orbit --fit" cmp -s orbit.png after.png
check "--fit --orbit" cmp -s orbit.png before.png

# Statistics.
succeed render cube.obj $view -o s.png --stats=s.json --threads 2 --isa baseline --output color,normal
run render cube.obj $view -o s.png --stats --threads 2 --isa baseline
check "statistics on standard output" grep -q '"triangles": {"in": 12, ' "$folder/log/out"
for key in model model_format width height samples outputs threads isa times_ms import upload record front back \
    resolve read encode total busy_ms vertex setup bin triangles in dropped clipped culled rasterized draws \
    vertices_shaded fragments shaded groups lane_occupancy tiles bin_entries flushes geometry_peak memory_peak \
    process_memory_peak; do
    check "statistics have $key" grep -q "\"$key\": " s.json
done
check "statistics name the outputs" grep -q '"outputs": \["color", "normal"\]' s.json
check "statistics name threads" grep -q '"threads": 2,' s.json
check "statistics name the isa" grep -q '"isa": "baseline"' s.json
if command -v python3 >/dev/null 2>&1; then
    check "statistics are JSON" python3 -c 'import json, sys
s = json.load(open("s.json"))
t = s["times_ms"]
b = s["busy_ms"]
assert b["vertex"] + b["setup"] + b["bin"] <= b["front"] + 0.01, b
assert 0 < b["front"] <= 2 * t["front"] + 0.01 and 0 < b["back"] <= 2 * t["back"] + 0.01, (b, t)
f = s["fragments"]
assert sum(v for k, v in t.items() if k != "total") <= t["total"] * 1.01, t
assert 0 < f["shaded"] <= 8 * f["groups"], f
assert abs(f["lane_occupancy"] - f["shaded"] / (8 * f["groups"])) < 1e-3, f
n = s["triangles"]
assert n["in"] == 24 and n["culled"] + n["rasterized"] + n["dropped"] == 24, n
assert n["rasterized"] <= s["bin_entries"] <= n["rasterized"] * s["tiles"], s
assert s["process_memory_peak"] > s["memory_peak"] > s["geometry_peak"] + 96 * 64 * 4, s'
fi
cp cube.obj "$(printf 'a"b\\c\td\351.obj')"
run render "$(printf 'a"b\\c\td\351.obj')" $view -o s.png --stats
check "a strange name" test $status = 0
check "a strange name in JSON" grep -qF '"model": "a\"b\\c\u0009d\ufffd.obj"' "$folder/log/out"

# Standard input, of formats that have a mark and of those that have none.
for model in cube.obj cameras.gltf; do
    succeed render $model $view -o file.png --fit
    status=0
    "$rhw" render - $view -o piped.png --fit <$model 2>"$folder/log/err" || status=$?
    check "$model on standard input" test $status = 0
    check "$model on standard input is the same" cmp -s file.png piped.png
done
refuse 1 "standard input: the file is empty$" render - -o x.png
status=0
echo words | "$rhw" info - 2>"$folder/log/err" || status=$?
check "words on standard input" grep -q "^rhw: standard input: is not a model in a format" "$folder/log/err"
check "rhw info of standard input" test "$("$rhw" info - <cube.obj | head -1)" = "standard input: Wavefront OBJ"

# What is up.
succeed render cube.obj $view -o up.png --up y
check "y is what an OBJ has" equal a.png up.png
succeed render cube.obj $view -o z.png --up z
if equal a.png z.png; then
    fail "--up z draws what y does"
fi
succeed render cube.obj $view -o up.png --up +z
check "+z is z" cmp -s z.png up.png
for axis in w +w +-z Z ''; do
    refuse 2 "--up: '[^']*' is not x, y, z, -x, -y or -z$" render cube.obj -o x.png --up "$axis"
done

# With nothing open but the files that are asked for.
"$rhw" render cube.obj $view -o closed.png <&- >&- 2>&-
check "standard streams that are closed" cmp -s a.png closed.png
"$rhw" render cube.obj $view -o - >&- 2>"$folder/log/err"
check "a picture to a closed stream" grep -q "^rhw: standard output: cannot be written: Bad file desc" "$folder/log/err"
# Their numbers are no file's, which would get what is printed.
if [ -d /dev/fd ]; then
    "$rhw" info /dev/fd/0 <&- 2>"$folder/log/0"
    "$rhw" info /dev/fd/1 >&- 2>"$folder/log/1"
    check "the number of a closed stream is taken" grep -q "is not a regular file" "$folder/log/0"
    check "of standard output too" grep -q "is not a regular file" "$folder/log/1"
fi

# A picture does not take the model's place.
cp cube.obj self.png
ln -s self.png link.png
for out in self.png ./self.png link.png; do
    refuse 1 "$out: is the model itself; name another file for the picture$" render self.png -o $out
done
refuse 1 "self.png: is the model itself" render self.png -o y.png --stats=self.png

# Everything of the file that is not drawn is said, and --strict takes it for a failure.
sed 's/"asset": {"version": "2.0"}/"extensionsUsed": ["EXT_a", "EXT_b"], &/' cameras.gltf >used.gltf
run render used.gltf $view -o x.png --fit
check "extensions that are not drawn" test $status = 0
check "the first" grep -q "^rhw: used.gltf: warning: glTF extension EXT_a: ignored$" "$folder/log/err"
check "the second" grep -q "^rhw: used.gltf: warning: glTF extension EXT_b: ignored$" "$folder/log/err"
refuse 1 "used.gltf: is not drawn as it is meant, for the reasons above \(2\); --strict allows none" \
    render used.gltf -o strict.png --strict --quiet
succeed render cube.obj $view -o strict.png --strict

# A terminal sees what goes on, and nothing of it remains.
if command -v script >/dev/null 2>&1; then
    script -qec "'$rhw' render cube.obj $view -o s.png" "$folder/log/typescript" >/dev/null 2>&1 </dev/null
    check "progress on a terminal" grep -q "reading cube.obj" "$folder/log/typescript"
fi

# Models that cannot be drawn.
: >empty.obj
echo "just words" >words.txt
echo "just words" >words.glb
printf 'o nothing\nvn 0 0 1\n' >bare.obj
printf 'glTF\2\0\0\0\100\0\0\0' >cut.glb
mkdir folder.obj
for ending in usd usda usdc usdz 3dm skp splat; do
    echo words >scene.$ending
    refuse 1 "scene.$ending: is .*, which is not supported$" render scene.$ending -o x.png
done
echo '#usda 1.0' >scene.txt
refuse 1 "scene.txt: is USD \(text\), which is not supported$" render scene.txt -o x.png
printf '\211PNG\r\n\032\n' >picture.glb
refuse 1 "picture.glb: is no model but a PNG picture$" render picture.glb -o x.png
printf '\357\273\277\n\n<!doctype HTML>\n' >page.obj
refuse 1 "page.obj: is no model but a web page$" render page.obj -o x.png
refuse 1 "none.obj: cannot be opened: No such file or directory" render none.obj -o x.png
for model in empty.obj words.txt words.glb bare.obj cut.glb folder.obj; do
    refuse 1 "$model: " render $model -o x.png
done
printf 'v 0 0 0\nv 1 0 0\nv nan 1 0\nv 0 1 0\nf 1 2 3\nf 1 2 4\n' >nan.obj
run render nan.obj $view -o x.png
check "NaN vertices end in a status, not a crash" test $status -le 1
printf 'v 0 0 0\nv 1 0 0\nv nan 1 0\nf 1 2 3\n' >bad.obj
refuse 1 "bad.obj: the file has nothing to draw: mesh .* positions that are not finite are left out, 1 of them$" \
    render bad.obj -o x.png
# What a file has instead is the reason, here curves; a crash of a library is told as its own.
cat >curves.fbx <<'FBX'
; FBX 7.4.0 project file
FBXHeaderExtension:  {
	FBXHeaderVersion: 1003
	FBXVersion: 7400
}
Objects:  {
	Geometry: 12, "Geometry::", "NurbsCurve" {
		NurbsCurveVersion: 100
	}
	Model: 11, "Model::curve", "NurbsCurve" {
		Version: 232
	}
}
Connections:  {
	C: "OO",11,0
	C: "OO",12,11
}
FBX
refuse 1 "curves.fbx: the file has nothing to draw: NURBS curves: not drawn(; .*)?$" render curves.fbx -o x.png
cat >crash.ifc <<'IFC'
ISO-10303-21;
HEADER;
FILE_DESCRIPTION((''),'2;1');
FILE_NAME('','',(''),(''),'','','');
FILE_SCHEMA(('IFC4'));
ENDSEC;
DATA;
#25= IFCPROJECT('2oT9YYbSrBUghtexcAcblU',#6,'P',$,$,'P',$,(#15),#26);
ENDSEC;
END-ISO-10303-21;
IFC
if ! grep -aq __asan_init "$rhw"; then # a sanitizer has more lines to say
    refuse 1 "crash.ifc: assimp, the library that reads it, crashed; assimp knows IFC2X3, and this is IFC4 \(.* [0-9]+\)$" \
        render crash.ifc -o x.png
fi
cat >missing.mtl <<'MTL'
newmtl m
map_Kd not-there.png
MTL
printf 'mtllib missing.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3\n' >missing.obj
run render missing.obj $view -o x.png
check "a missing texture is no failure" test $status = 0
check "a missing texture is a warning" \
    grep -q '^rhw: missing.obj: warning: texture "not-there.png": .*; drawn in magenta$' "$folder/log/err"
succeed render missing.obj $view -o x.png --quiet
# What some of assimp's importers call no texture.
cat >dummy.ac <<'AC'
AC3Db
MATERIAL "m" rgb 1 1 1 amb 1 1 1 emis 0 0 0 spec 0 0 0 shi 0 trans 0
OBJECT world
kids 1
OBJECT poly
texture "$texture_dummy.bmp"
numvert 3
0 0 0
1 0 0
0 1 0
numsurf 1
SURF 0x20
mat 0
refs 3
0 0 0
1 1 0
2 0 1
kids 0
AC
run render dummy.ac $view -o x.png
check "a dummy texture is none: $(cat "$folder/log/err")" test ! -s "$folder/log/err"
sed 's/^mat 0/mat 1/' dummy.ac >lacks.ac
refuse 1 "lacks.ac: line 13: a surface has material 1; the file has 1, counted from 0$" render lacks.ac $view -o x.png
sed '/^MATERIAL/d; /^mat/d' dummy.ac >none.ac
run render none.ac $view -o x.png
check "where a file has no materials there is one" grep -q 'AC3D: No material has been found' "$folder/log/err"
sed 's/.texture_dummy.bmp/nowhere.bmp/' dummy.ac >other.ac
run render other.ac $view -o x.png
check "another is" grep -q 'nowhere.bmp.*drawn in magenta' "$folder/log/err"
run render cube.obj $view -o x.png --camera 0,0,9,0,0,18,0,1,0,30
check "nothing in view is a warning" grep -q "^rhw: cube.obj: warning: nothing of the model is in the picture" "$folder/log/err"
printf 'v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n' >thin.obj
run render thin.obj $view -o x.png
check "no area is one warning" test "$(cat "$folder/log/err")" = \
    "rhw: thin.obj: warning: none of its triangles has an area: there is nothing to see"
run render thin.obj $view -o x.png --camera 0,0,9,0,0,18,0,1,0,30
check "and one by any camera" test "$(wc -l <"$folder/log/err")" = 1

# Far from the origin a model looks as it does there, by the same camera too, and so does each of two that are far apart.
move_cube() { # X Y Z, added to the places of cube.obj
    awk -v x="$1" -v y="$2" -v z="$3" -v CONVFMT=%.17g -v OFMT=%.17g \
        '$1 == "v" { $2 += x; $3 += y; $4 += z } $1 !~ /mtl/ { print }' cube.obj
}
look_at() { # X Y Z of the cube
    awk -v x="$1" -v y="$2" -v z="$3" \
        'BEGIN { printf "%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,0,1,0,30", x + 4, y + 3, z + 6, x, y, z }'
}
move_cube 0 0 0 >near.obj
move_cube 5000000 4000000 -6000000 >far.obj
{
    move_cube 0 0 0
    move_cube 5000000 4000000 -6000000 | awk '$1 == "f" { for (i = 2; i <= NF; i++) { $i += 8 } } { print }'
} >both.obj
run render near.obj $view -o near.png --camera "$(look_at 0 0 0)"
succeed render far.obj $view -o far.png --camera "$(look_at 5000000 4000000 -6000000)"
check "far away a model looks the same" cmp near.png far.png
run render both.obj $view -o near.png --camera "$(look_at 0 0 0)"
run render both.obj $view -o far.png --camera "$(look_at 5000000 4000000 -6000000)"
check "each of two that are far apart looks the same" cmp near.png far.png
# A sheet says where its places count from, and what its ids are called, as a picture does; it has no one camera.
attribute() { # NAME FILE: whether an EXR has the attribute
    grep -aq "$1" "$2"
}
succeed render far.obj $view -o far.exr --output position,object
succeed render far.obj $view -o sheet.exr --output position,object --views front,top
origin_of() { # FILE: the three doubles of its origin, in hexadecimal
    at=$(grep -abo "origin.v3d" "$1" | head -n 1 | cut -d : -f 1)
    od -A n -t x8 -j $((at + 15)) -N 24 "$1" | tr -d '\n'
}
check "a far picture has an origin" test -n "$(origin_of far.exr)"
check "a sheet has the origin of a picture" test "$(origin_of sheet.exr)" = "$(origin_of far.exr)"
check "a sheet has names of objects" attribute objectNames sheet.exr
check "a picture has a camera" attribute originToNDC far.exr
check "a sheet has no camera" sh -c '! grep -aq ToCamera sheet.exr && ! grep -aq ToNDC sheet.exr'
run render near.obj $view -o near.png
run render far.obj $view -o far.png
check "and fitted" cmp near.png far.png
{
    cat far.obj
    printf 'v 0 0 0\np 9\n'
} >speck.obj
run render speck.obj $view -o speck.png
check "beside a speck at 0 too" cmp far.png speck.png
no_temporary_files

finish
