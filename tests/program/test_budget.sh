#!/bin/sh
# SPDX-License-Identifier: MIT
# What a file may take and read: --max-memory, --max-texture, --confine.
. "$(dirname "$0")/harness.sh"

# A picture of one colour, each way as given, and a triangle that shows it.
make_textured() { # NAME SIDE
    "$rhw" render cube.obj --size "$2" --background "#336699" --lights none -o "$1.png" --samples 1 -q ||
        fail "no texture for $1"
    cat >"$1.gltf" <<GLTF
{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "buffers": [{"byteLength": 60, "uri": "triangle.bin"}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 24}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
               {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"}],
 "images": [{"uri": "$1.png"}], "textures": [{"source": 0}],
 "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}, "extensions": {"KHR_materials_unlit": {}}}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}]}]}
GLTF
}
make_cube cube
# (0,0,0) (1,0,0) (0,1,0) and (0,0) (1,0) (0,1), little endian
printf '\0\0\0\0\0\0\0\0\0\0\0\0\0\0\200\077\0\0\0\0\0\0\0\0\0\0\0\0\0\0\200\077\0\0\0\0' >triangle.bin
printf '\0\0\0\0\0\0\0\0\0\0\200\077\0\0\0\0\0\0\0\0\0\0\200\077' >>triangle.bin

# Textures: larger than the picture can use they change nothing that is seen, and cost less.
make_textured wide 4096
succeed render wide.gltf --size 64 -o small.png --stats=small.json
succeed render wide.gltf --size 64 -o whole.png --stats=whole.json --max-texture 4096
run compare small.png whole.png --tolerance 1/255
check "the same picture within one unit: $(cat "$folder/log/out")" test "$status" = 0
memory_of() {
    sed -n 's/.*"process_memory_peak": *\([0-9]*\).*/\1/p' "$1"
}
check "less memory" test "$(memory_of small.json)" -lt "$(($(memory_of whole.json) / 2))"
succeed render wide.gltf --size 64 -o one.png --max-texture 1
run compare one.png whole.png
check "one texel for all" test "$status" = 1
refuse 2 "--max-texture: '0' is not a number of 1 to 16384" render wide.gltf -o a.png --max-texture 0
refuse 2 "--max-texture: '20000' is not" render wide.gltf -o a.png --max-texture 20000

# Memory. A sanitizer takes address space without a limit.
for size in 12 1k 63M -2G 2T nan; do
    refuse 2 "--max-memory: '$size' is not a size like 512M or 2G, and at least 64M" render cube.obj -o a.png \
        --max-memory="$size"
done
succeed render cube.obj -o cube.png --max-memory 2G
if ! grep -aq __asan_init "$rhw" && ! grep -aq __tsan_init "$rhw"; then
    refuse 1 'wide.gltf: needs more memory than there is for texture "wide.png"' render wide.gltf -o a.png \
        --max-memory 80M --max-texture 4096 --threads 1
    # Of each format it is memory that lacks, not an end or a beginning of the file, whoever reads it.
    python3 - <<'PY'
import struct, zlib
SIDE = 4096
def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
rows = sum(-(-(SIDE - y) // dy) * (1 + 4 * -(-(SIDE - x) // dx)) for x, y, dx, dy in
           [(0, 0, 8, 8), (4, 0, 8, 8), (0, 4, 4, 8), (2, 0, 4, 4), (0, 2, 2, 4), (1, 0, 2, 2), (0, 1, 1, 2)])
deflate = zlib.compressobj(1)
packed = b"".join(deflate.compress(bytes(min(1 << 20, rows - at))) for at in range(0, rows, 1 << 20)) + deflate.flush()
open("short.png", "wb").write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", SIDE, SIDE, 8, 6, 0, 0, 1)) +
                              chunk(b"IDAT", packed) + chunk(b"IEND", b""))
open("short.tga", "wb").write(struct.pack("<BBBHHBHHHHBB", 0, 0, 10, 0, 0, 0, 0, 0, SIDE, SIDE, 32, 8) +
                              b"\xff\1\2\3\4" * (SIDE * SIDE // 128))
strip = zlib.compress(bytes(SIDE * SIDE * 3), 1)
tags = [(256, 4, SIDE), (257, 4, SIDE), (258, 3, 8), (259, 3, 8), (262, 3, 2), (273, 4, 512), (277, 3, 3),
        (278, 4, SIDE), (279, 4, len(strip))]
head = b"II*\0\x08\0\0\0" + struct.pack("<H", len(tags)) + b"".join(
    struct.pack("<HHII", tag, kind, 1, value) for tag, kind, value in tags) + bytes(4)
open("short.tif", "wb").write(head.ljust(512, b"\0") + strip)
PY
    for name in short.png short.tga short.tif; do
        sed "s/wide.png/$name/" wide.gltf >short.gltf
        refuse 1 "short.gltf: needs more memory than there is for texture \"$name\"" render short.gltf -o a.png \
            --max-memory 64M --threads 1
    done
    rm short.png short.tga short.tif
    # A damaged picture that asks for more than one of its size takes, and of few bytes that would be large, are no
    # lack of memory: the model is drawn without them.
    python3 - <<'PY'
import struct, zlib
def chunk(kind, data, length=None):
    return struct.pack(">I", len(data) if length is None else length) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
def png(side, length):
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", side, side, 8, 2, 0, 0, 1)) +
            chunk(b"IDAT", zlib.compress(bytes(100)), length) + chunk(b"IEND", b""))
open("asks.png", "wb").write(png(8, 1 << 30))
open("few.png", "wb").write(png(16384, None))
open("few.tga", "wb").write(struct.pack("<BBBHHBHHHHBB", 0, 0, 10, 0, 0, 0, 0, 0, 16384, 16384, 32, 8) + b"\xff\1\2\3\4")
PY
    for name in asks.png few.png few.tga; do
        sed "s/wide.png/$name/" wide.gltf >asks.gltf
        run render asks.gltf -o asked.png --size 64 --max-memory 256M --threads 1
        check "drawn without $name: $(cat "$folder/log/err")" test "$status" = 0 -a -s asked.png
        check "told of $name: $(cat "$folder/log/err")" grep -q "texture \"$name\": damaged.*; drawn in magenta" \
            "$folder/log/err"
        rm asked.png
    done
    truncate -s 400M huge.png # too long to be read at all
    sed 's/wide.png/huge.png/' wide.gltf >huge.gltf
    refuse 1 'huge.gltf: needs more memory than there is for texture "huge.png"' render huge.gltf -o a.png --max-memory 256M
    refuse 1 "cube.obj: .*memory" render cube.obj --size 16384 -o a.png --max-memory 512M
fi

# Many small objects take time and memory by their number. A sanitizer takes more of both.
if command -v python3 >/dev/null 2>&1; then
    small=
    if grep -aq __asan_init "$rhw" || grep -aq __tsan_init "$rhw"; then
        small=small
    fi
    mkdir many
    check "time and memory of an object" sh -c 'cd many && python3 "$@"' - "$root/tests/program/small_objects.py" \
        "$rhw" $small
    rm -r many
fi

# Time: of a process, and for thumbs of each model.
for seconds in 0 -1 1e9 soon nan; do
    refuse 2 "--max-time: '$seconds' is not a number of seconds, 0.1 to 86400" render cube.obj -o a.png \
        --max-time="$seconds"
done
succeed render cube.obj -o cube.png --max-time 600
refuse 1 "cube.obj: takes longer than --max-time, 0.5 seconds" render cube.obj -o late.apng --turntable 10000 \
    --size 1024 --max-time 0.5
mkdir late
cp cube.obj cube.mtl late
run thumbs late -o slow --size 8192 --max-time 0.3
check "thumbs, too late: status" test "$status" = 1
check "thumbs, too late: says so" grep -q '^rhw: late/cube.obj: takes longer than --max-time, 0.3 seconds$' "$folder/log/err"
check "no half picture" test "$(find slow -type f | wc -l)" = 0

# A signal to thumbs and what it started leaves no temporary file.
setsid "$rhw" thumbs late -o slow --size 4096 2>/dev/null &
tries=0
while ! is_writing slow && [ $tries -lt 3000 ]; do
    sleep 0.02
    tries=$((tries + 1))
done
check "a temporary file" test $tries -lt 3000
kill -TERM "-$!"
status=0
wait $! || status=$?
check "ended by the signal" test "$status" = 143
tries=0
while [ -n "$(find slow -type f)" ] && [ $tries -lt 100 ]; do
    sleep 0.02
    tries=$((tries + 1))
done
check "which is gone" test "$(find slow -type f | wc -l)" = 0

# Files that the model names.
mkdir -p shop/stock
cp wide.png shop
sed 's,"triangle.bin","../triangle.bin",' wide.gltf >shop/outside.gltf
cp wide.gltf shop/stock/inside.gltf
cp wide.png shop/above.png
sed 's,"wide.png","../above.png",' wide.gltf >shop/stock/above.gltf
cp triangle.bin wide.png shop/stock
succeed render shop/outside.gltf -o free.png --size 32
refuse 1 'shop/outside.gltf: buffers\[0\]: "../triangle.bin": is not a file of the folder that may be read' \
    render shop/outside.gltf -o a.png --confine
refuse 1 'shop/outside.gltf: buffers\[0\]: "../triangle.bin": is not a file of' render shop/outside.gltf -o a.png \
    --confine=shop
succeed render shop/outside.gltf -o b.png --size 32 --confine=.
run render shop/stock/above.gltf -o c.png --size 32 --confine
check "a texture outside is missing" grep -q 'texture "../above.png": is not a file of the folder' "$folder/log/err"
succeed render shop/stock/above.gltf -o d.png --size 32 --confine=shop
ln -s ../triangle.bin shop/link.bin
sed 's,"triangle.bin","link.bin",' wide.gltf >shop/link.gltf
refuse 1 'shop/link.gltf: buffers\[0\]: "link.bin": is not a file of' render shop/link.gltf -o a.png --confine
for place in "$PWD/triangle.bin" "file://$PWD/triangle.bin"; do
    sed "s,\"triangle.bin\",\"$place\"," wide.gltf >shop/absolute.gltf
    refuse 1 'shop/absolute.gltf: .*is not a file of' render shop/absolute.gltf -o a.png --confine
done
sed 's,^mtllib.*,mtllib ../cube.mtl,' cube.obj >shop/cube.obj
run render shop/cube.obj -o e.png --size 32 --confine
check "a material library outside" grep -q 'material library "../cube.mtl": is not a file of' "$folder/log/err"
refuse 1 "cube.obj: the folder nowhere, which it may read: No such file or directory" render cube.obj -o a.png \
    --confine=nowhere
# assimp opens files itself: a scene of LightWave names its objects.
cp cube.obj secret.obj
printf 'LWSC\n3\nLoadObjectLayer 1 %s/secret.obj\n' "$PWD" >shop/scene.lws
run render shop/scene.lws -o f.png --size 32
check "assimp opens files" test "$status" = 0
refuse 1 "shop/scene.lws: the file has nothing to draw" render shop/scene.lws -o a.png --size 32 --confine

# Who made a model does not learn what there is outside, by what is said or by what is drawn.
refusal_of() { # NAME
    sed "s,\"triangle.bin\",\"$1\"," wide.gltf >shop/asks.gltf
    refuse 1 "shop/asks.gltf: buffers" render shop/asks.gltf -o a.png --confine
    sed 's/"[^"]*"/NAME/' "$folder/log/err"
}
there=$(refusal_of ../triangle.bin)
for name in ../none.bin "$PWD/triangle.bin" /none/none.bin link.bin ../late/none.bin; do
    check "one refusal, $name" test "$(refusal_of "$name")" = "$there"
done
cp wide.png shop/near.png
sed 's,"triangle.bin","stock/triangle.bin",' wide.gltf >shop/inside.gltf
for name in ../late/../shop/near.png ../none/../shop/near.png late/../near.png; do
    sed "s,\"wide.png\",\"$name\"," shop/inside.gltf >shop/asks.gltf
    succeed render shop/asks.gltf -o a.png --size 32 --confine
done
rm a.png

# A pipe that a model names would be waited for, and a device may do something: neither is opened.
mkdir pipes
mkfifo pipes/pipe.bin pipes/pipe.png pipes/pipe.mtl pipes/pipe.obj
cp triangle.bin wide.png cube.mtl pipes
sed 's,"triangle.bin","pipe.bin",' wide.gltf >pipes/buffer.gltf
sed 's,"wide.png","pipe.png",' wide.gltf >pipes/texture.gltf
sed 's,^mtllib.*,mtllib pipe.mtl,' cube.obj >pipes/library.obj
{ cat cube.mtl && echo "map_Kd pipe.png"; } >pipes/textured.mtl
sed 's,^mtllib.*,mtllib textured.mtl,' cube.obj >pipes/textured.obj
printf 'LWSC\n3\nLoadObjectLayer 1 pipe.obj\n' >pipes/scene.lws
for confine in --samples=1 --confine; do
    refuse 1 'pipes/buffer.gltf: buffers\[0\]: "pipe.bin": ' render pipes/buffer.gltf -o a.png --max-time 20 $confine
    refuse 1 'pipes/scene.lws: the file has nothing to draw' render pipes/scene.lws -o a.png --max-time 20 $confine
    for name in texture.gltf library.obj textured.obj; do
        run render pipes/$name -o a.png --size 16 --max-time 20 $confine
        check "$name, which names a pipe: $(cat "$folder/log/err")" test "$status" = 0
        check "$name: it says so" grep -q '"pipe\.[a-z]*": ' "$folder/log/err"
    done
    rm a.png
done

# A name with a slash at every other byte costs no more than another.
slashes=$(printf '%040000d' 0 | sed 's,00,a/,g')
for length in 3000 40000; do
    sed "s,\"wide.png\",\"$(printf %.${length}s "$slashes")\"," wide.gltf >slashes.gltf
    run render slashes.gltf -o a.png --size 32 --max-memory 300M --max-time 20
    check "a texture of $length bytes' name is left out: $status" test "$status" = 0
    check "for its name or because it is not there" grep -Eq 'a/": (No such file|the name is longer than)' "$folder/log/err"
done
rm a.png

# thumbs confines to its folder.
run thumbs shop -o thumbs --size 16
for name in outside link absolute; do
    check "$name.gltf has no thumbnail" test ! -e "thumbs/$name.gltf.png"
done
check "stock/above.gltf has one" test -s thumbs/stock/above.gltf.png
succeed thumbs shop/stock -o free --size 16 --confine shop --max-memory 2G --max-texture 64
check "--confine of another folder: $(size_of free/above.gltf.png)" test "$(size_of free/above.gltf.png)" = 16x16
refuse 2 "--max-memory: 'much' is not a size" thumbs shop -o x --max-memory much
no_temporary_files
finish
