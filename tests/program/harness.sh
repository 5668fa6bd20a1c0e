# SPDX-License-Identifier: MIT
# What the tests of the command line share. Sourced with the arguments PROGRAM SOURCE_ROOT; leaves the test
# in an empty folder of its own that is removed at the end.

rhw=$(realpath "$1")
root=$(realpath "$2")
[ -x "$rhw" ] || { echo "$1 is no program" >&2; exit 1; }
failures=0
checks=0
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
trap 'exit 1' INT TERM
mkdir "$folder/work" "$folder/log"
cd "$folder/work" || exit 1

fail() {
    failures=$((failures + 1))
    echo "FAILED: $*" >&2
}

check() { # DESCRIPTION COMMAND...
    checks=$((checks + 1))
    description=$1
    shift
    "$@" || fail "$description: $*"
}

run() { # ARGUMENT...: runs rhw; $status, log/out and log/err keep what came of it
    status=0
    "$rhw" "$@" >"$folder/log/out" 2>"$folder/log/err" </dev/null || status=$?
}

# Every name in the folder, temporary files included, and of files their number, size and time: what is written anew is
# another then, whatever is written.
names() {
    find . -type f -printf '%p %i %s %T@\n' -o -printf '%p\n' | sort
}

# rhw ARGUMENT... ends with STATUS, prints one line "rhw: ..." that matches PATTERN (an extended regular
# expression) on stderr and nothing on stdout, and no file appears, vanishes or changes.
refuse() { # STATUS PATTERN ARGUMENT...
    checks=$((checks + 1))
    wanted=$1
    pattern=$2
    shift 2
    names >"$folder/log/before"
    run "$@"
    names >"$folder/log/after"
    [ "$status" = "$wanted" ] || fail "rhw $*: status $status, expected $wanted: $(cat "$folder/log/err")"
    [ "$(wc -l <"$folder/log/err")" = 1 ] || fail "rhw $*: not one line: $(cat "$folder/log/err")"
    grep -Eq "^rhw: $pattern" "$folder/log/err" ||
        fail "rhw $*: said '$(cat "$folder/log/err")', expected 'rhw: $pattern'"
    [ -s "$folder/log/out" ] && fail "rhw $*: wrote to standard output"
    cmp -s "$folder/log/before" "$folder/log/after" ||
        fail "rhw $*: files changed: $(diff "$folder/log/before" "$folder/log/after")"
}

# rhw ARGUMENT... ends with 0 and says nothing on stderr.
succeed() { # ARGUMENT...
    checks=$((checks + 1))
    run "$@"
    [ "$status" = 0 ] || fail "rhw $*: status $status: $(cat "$folder/log/err")"
    [ -s "$folder/log/err" ] && fail "rhw $*: said '$(cat "$folder/log/err")'"
}

no_temporary_files() {
    checks=$((checks + 1))
    [ -z "$(find . -name '.rhw-*')" ] || fail "left behind: $(find . -name '.rhw-*')"
}

# Whether a process writes a file below a folder, with a name or still without one.
is_writing() { # FOLDER
    [ -n "$(find "$1" -name '.rhw-*')" ] || ls -l /proc/*/fd 2>/dev/null | grep -q " $(realpath "$1")/.*(deleted)\$"
}

finish() {
    echo "$checks checks, $failures failed"
    [ "$failures" = 0 ]
    exit
}

# A cube with a colour on each of two materials, texture coordinates and normals.
make_cube() { # NAME
    cat >"$1.mtl" <<'MTL'
newmtl red
Kd 0.8 0.1 0.1
newmtl blue
Kd 0.1 0.2 0.9
MTL
    cat >"$1.obj" <<OBJ
mtllib $1.mtl
v -1 -1 -1
v 1 -1 -1
v 1 1 -1
v -1 1 -1
v -1 -1 1
v 1 -1 1
v 1 1 1
v -1 1 1
vt 0 0
vt 1 0
vt 1 1
vt 0 1
usemtl red
f 5/1 6/2 7/3 8/4
f 2/1 1/2 4/3 3/4
f 8/1 7/2 3/3 4/4
usemtl blue
f 1/1 2/2 6/3 5/4
f 6/1 2/2 3/3 7/4
f 1/1 5/2 8/3 4/4
OBJ
}

# A triangle that moves to the right within a second, and one animation that does nothing.
make_moving() { # NAME
    base64 -d >"$1.bin" <<'B64'
AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAABAAAAAAAAAAAA=
B64
    cat >"$1.gltf" <<GLTF
{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "name": "n"}],
 "buffers": [{"byteLength": 68, "uri": "$1.bin"}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 8},
                 {"buffer": 0, "byteOffset": 44, "byteLength": 24}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
               {"bufferView": 1, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [1]},
               {"bufferView": 2, "componentType": 5126, "count": 2, "type": "VEC3"}],
 "materials": [{"doubleSided": true}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
 "animations": [{"name": "slide", "samplers": [{"input": 1, "output": 2}],
                 "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]},
                {"name": "rest", "samplers": [], "channels": []}]}
GLTF
}

# Says WIDTHxHEIGHT of a picture.
size_of() { # FILE
    "$rhw" compare --json "$1" "$1" | tr -d ' \n' | sed -n 's/.*"width":\([0-9]*\),"height":\([0-9]*\).*/\1x\2/p'
}
