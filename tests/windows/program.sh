#!/bin/sh
# SPDX-License-Identifier: MIT
# The program for Windows beside the native one, on the models of tests/: both get the same command lines, and every file,
# every byte on standard output, every line of an error and every status has to be the same; names of files have slashes in
# both. script/windows test starts it.
# usage: program.sh NATIVE_PROGRAM WINE WINDOWS_PROGRAM
set -eu

tests=$(cd "$(dirname "$0")/.." && pwd)
native=$1
wine=$2
windows=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
passed=0
failed=0

# check WHAT COMMAND...
check() {
    what=$1
    shift
    if "$@" >/dev/null 2>&1; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "failed: $what" >&2
    fi
}

# both ARGUMENT...: runs both, each in a folder of its own, with the file "$input" as standard input.
input=/dev/null
both() {
    native_status=0
    windows_status=0
    (cd "$work/native" && "$native" "$@" <"$input" >out 2>err) || native_status=$?
    (cd "$work/windows" && "$wine" "$windows" "$@" <"$input" >out 2>err) || windows_status=$?
    check "the status of $* is $windows_status, not $native_status" test $native_status = $windows_status
}

# same ARGUMENT...: both, and all that they left; then both folders are as they were.
same() {
    both "$@"
    check "$*: $(diff -r "$work/native" "$work/windows" 2>&1 | head -5)" diff -r "$work/native" "$work/windows"
    for side in native windows; do
        rm -rf "$work/$side"
        cp -r "$work/models" "$work/$side"
    done
}

# what VERB... says on Windows alone
alone() {
    windows_status=0
    (cd "$work/windows" && "$wine" "$windows" "$@" </dev/null >out 2>err) || windows_status=$?
}

mkdir -p "$work/models/folder/deep"
cp "$tests"/fuzz/seeds/*.gl* "$tests"/fuzz/seeds/*.obj "$tests"/fuzz/seeds/*.ply "$tests"/fuzz/seeds/*.stl \
    "$tests"/fuzz/seeds/*.3mf "$tests/program/patches.gltf" "$work/models"
cp "$tests"/fuzz/seeds/square.glb "$tests"/fuzz/seeds/roof.stl "$work/models/folder"
cp "$tests"/fuzz/seeds/cube.ply "$work/models/folder/deep"
cat >"$work/models/box.obj" <<'END'
mtllib box.mtl
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 .5
vt 0 0
vt 1 0
vt 1 1
vt 0 1
usemtl box
f 1/1 2/2 3/3 4/4
END
printf 'newmtl box\nmap_Kd .\\textures\\Wall.PPM\n' >"$work/models/box.mtl"
mkdir "$work/models/Textures"
printf 'P6 2 2 255\n\377\0\0\0\377\0\0\0\377\377\377\0' >"$work/models/Textures/wall.ppm"
cp -r "$work/models" "$work/native"
cp -r "$work/models" "$work/windows"

# Every format that has a reader here: pictures and what is in them.
for model in square.glb square.gltf draco.gltf meshopt.gltf turns.gltf patches.gltf square.obj box.obj cube.ply roof.stl \
    steps.stl sheet.3mf; do
    same render $model --size 160x120 -o picture.png
    same info --json $model
done
same info patches.gltf

# Every encoder, and standard streams.
for ending in ppm jpg webp exr png; do
    same render patches.gltf --size 96 --samples 4 -o picture.$ending
    same render patches.gltf --size 32 --format $ending -o -
done
same render patches.gltf --size 96 --output color,depth,normal,id -o picture.png
same render box.obj --size 64 --output color,depth,normal,uv -o picture.exr
same render turns.gltf --animation move --animate 10 --size 48 -o moving.png
same render turns.gltf --animation move --animate 10 --size 48 -o moving.webp
same render square.glb --turntable 4 --size 48 -o 'frame_{frame}.png'
input=$work/models/square.glb
same render - --size 64 -o picture.png
same info --json -
input=/dev/null

same explain square.glb --at 32,32 --size 64
same explain patches.gltf --at 32,32 --size 64 --json
same explain square.glb --at 32,32 --size 64 --picture picture.svg

same thumbs folder -o thumbs --size 48
same thumbs folder -o folder --size 48 --jobs 1 --max-time 100
both thumbs folder -o folder --size 48
same thumbs folder -o folder --size 48 # what is there is kept

both render square.glb --size 64 -o one.png
both render square.glb --size 64 --samples 4 -o two.png
both compare one.png two.png -o difference.png
same compare one.png two.png --json
same compare two.png two.png

# A command line that is wrong, files that are not what they should be: one line each, and nothing is left.
same
same frobnicate
same render --size 0 square.glb
same render absent.glb -o picture.png
same render folder -o picture.png
same render square.glb -o absent/picture.png
same render square.glb -o folder
same render square.glb -o folder/
same render square.glb -o '{word}.png'
same render square.glb --literal --size 32 -o '{word}.png'
same thumbs absent -o thumbs
same help compare
same info absent.glb
same compare absent.png square.glb
for side in models native windows; do
    head -c 200 "$work/models/square.glb" >"$work/$side/cut.glb"
    head -c 150 "$work/models/draco.gltf" >"$work/$side/cut.gltf"
    head -c 100 "$work/models/sheet.3mf" >"$work/$side/cut.3mf"
    : >"$work/$side/empty.ply"
    echo "ply" >"$work/$side/short.ply"
    cp "$work/models/square.glb" "$work/$side/kept.png"
done
for model in cut.glb cut.gltf cut.3mf empty.ply short.ply; do
    same render $model -o kept.png # what was there stays
    same info --json $model
done
same render square.glb --confine=folder -o picture.png
same render box.obj --confine --size 32 -o picture.png
cp "$work/models/kept.png" "$work/native/in.glb"
cp "$work/models/kept.png" "$work/windows/in.glb"
same render in.glb -o in.glb
same thumbs . -o thumbs --size 16 --jobs 1 # some cannot be drawn, and their lines have an order then

# A picture takes its name when it is whole, also where there is a file of that name, and goes where time is up.
(
    sleep 2
    find "$work/windows" -name '.rhw-*' >"$work/begun"
) &
alone render patches.gltf --size 400 --turntable 2000 --max-time 4 -o kept.png
wait
check "a file is begun beside the one that it replaces" test -s "$work/begun"
check "time is up: status $windows_status" test $windows_status = 1
check "time is up: the line" grep -q '^rhw: patches.gltf: takes longer than --max-time, 4 seconds$' "$work/windows/err"
check "time is up: the old file" cmp "$work/windows/kept.png" "$work/models/kept.png"
check "time is up: nothing else" test -z "$(find "$work/windows" -name '.rhw-*')"
alone render square.glb --size 16 -o kept.png
check "a file is replaced" test $windows_status = 0 -a "$(head -c 4 "$work/windows/kept.png" | tail -c 3)" = PNG

# What Windows has otherwise: its slashes, and no limit of memory, which is said.
alone info --json '.\folder\deep\cube.ply'
cp "$work/windows/out" "$work/backslashes"
alone info --json ./folder/deep/cube.ply
check "backslashes" cmp "$work/backslashes" "$work/windows/out"
alone render square.glb --size 16 --max-memory 1G -o picture.png
check "--max-memory" test $windows_status = 0 -a "$(wc -l <"$work/windows/err")" = 1
check "--max-memory: the line" grep -q '^rhw: --max-memory: warning: is not kept' "$work/windows/err"

echo "$passed passed, $failed failed"
[ $failed = 0 ]
