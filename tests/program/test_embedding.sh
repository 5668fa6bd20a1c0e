#!/bin/sh
# SPDX-License-Identifier: MIT
# The recipes of docs/embedding.md, outside the tree and on the installed library: built by make, CMake and Meson, also
# with rhw as a subproject, and run; their numbers are known. With a sanitized library: that they run without a report,
# and that a mistake is found.
# usage: test_embedding.sh BUILD_FOLDER SOURCE_ROOT C_COMPILER [SANITIZERS]
set -u

build=$(realpath "$1")
root=$(realpath "$2")
export CC="$3"
sanitizers=${4:-}
case $(basename "$CC") in
*clang*) export CXX="$(printf %s "$CC" | sed 's/clang\([^/]*\)$/clang++\1/')" ;;
*) export CXX="${CXX:-c++}" ;;
esac
for tool in pkg-config make meson ninja nm "$CXX"; do
    command -v "$tool" >/dev/null 2>&1 || { echo "no $tool here"; exit 77; }
done
pkg-config --exists sdl2 || { echo "no SDL2 here"; exit 77; }
failures=0
checks=0
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
trap 'exit 1' INT TERM
cd "$folder" || exit 1
unset CMAKE_PREFIX_PATH MAKEFLAGS MAKELEVEL CFLAGS CXXFLAGS LDFLAGS

check() { # DESCRIPTION COMMAND...
    checks=$((checks + 1))
    description=$1
    shift
    "$@" >log 2>&1 || {
        failures=$((failures + 1))
        echo "FAILED: $description: $*" >&2
        tail -20 log >&2
    }
}

refuse() { # PATTERN COMMAND...: fails, and says what PATTERN matches
    checks=$((checks + 1))
    pattern=$1
    shift
    if "$@" >log 2>&1 || ! grep -Eq "$pattern" log; then
        failures=$((failures + 1))
        echo "FAILED: $* is not refused with '$pattern'" >&2
        tail -20 log >&2
    fi
}

# What the programs print, on every machine.
mkdir expected
cat >expected/resize <<'TEXT'
640 x 480 3b948c01de6e2772
1280 x 720 9736edd0f935e5e8
1 x 1 8e602dbe32d23d76
1 x 1 8e602dbe32d23d76
300 x 900 296155288c5e74fa
640 x 480 3b948c01de6e2772
TEXT
echo 94e285e5189f603d >expected/stream
cat >expected/threads <<'TEXT'
bc7f64ac1fc2a8e3 No error
bc7f64ac1fc2a8e3 No error
TEXT
cat >expected/allocator <<'TEXT'
500 x 500: No error
5000 x 5000: Out of memory
600 x 600: No error
refused: 1, left: 0 bytes
TEXT
echo b7b6f989734a816b >expected/mesh
echo 2caafbd101cb2219 >expected/arrays
echo 62b565a1b2c7f325 >expected/bindings
cat >expected/replay <<'TEXT'
d21083fa23d52325
30e0f0047d694225
1ef89db7ed80d725
d21083fa23d52325
TEXT
cat >expected/compute <<'TEXT'
0/8 14
1/8 244071
2/8 967
3/8 3032
4/8 6152
5/8 9056
6/8 15010
7/8 28898
TEXT
cat >expected/handles <<'TEXT'
f112808d386bc02a
e83ada50aa5db41f
bc00c8b80c5c0655
Out of memory
TEXT
echo e83ada50aa5db41f >expected/badge_user

says() { # FOLDER PROGRAM...: each prints what is expected
    in=$1
    shift
    for program in "$@"; do
        "$in/$program" >said 2>errors
        status=$?
        check "$in/$program ends with $status: $(head -30 errors)" test $status = 0
        check "$in/$program says what it should: $(cat said)" cmp said expected/$program
    done
}

closed() { # LIBRARY: shows badge_draw and nothing else
    nm -D --defined-only "$1" | awk '{ print $NF }' >shown
    check "$1 shows $(tr '\n' ' ' <shown)" test "$(cat shown)" = badge_draw
}

check "install" cmake --install "$build" --prefix "$folder/prefix"
library=$(dirname "$(find "$folder/prefix" -name pkgconfig)")
export PKG_CONFIG_PATH="$library/pkgconfig" LD_LIBRARY_PATH="$library"
cp -r "$root/examples/embedding" make
warnings="-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror"
all="resize stream threads allocator mesh arrays compute replay bindings handles badge_user"

if [ -n "$sanitizers" ]; then
    # A library that was built with the sanitizer, in programs that are.
    flags="-O1 -g -fsanitize=$sanitizers -fno-sanitize-recover=all"
    export UBSAN_OPTIONS=print_stacktrace=1
    check "make, sanitized" make -C make -j2 CFLAGS="-std=gnu17 $flags" CXXFLAGS="-std=c++17 $flags"
    says make $all
    check "golden, sanitized" make/golden make/golden.txt

    # Mistakes of a program: fewer vertices than are written, and a shader that counts its calls.
    sed 's/vertices\[3 \* DROPS\]/vertices[DROPS]/' make/stream.c >make/overflow.c
    sed -i 's/^static inline void cube_fragment.*/static int calls;\n&/; s/^    f->color\[0\]\[3\] = 1;/    calls++;\n&/' make/cube.h
    sed 's/rhw_context_def def = {0}/rhw_context_def def = {.threads = 2}/' make/resize.c >make/race.c
    check "mistakes, sanitized" make -C make CFLAGS="-std=gnu17 $flags" overflow race
    case $sanitizers in
    *address*) refuse 'global-buffer-overflow|insufficient space for an object' make/overflow ;;
    *thread*) refuse 'ThreadSanitizer: data race' make/race ;;
    esac
    echo "$checks checks, $failures failed"
    [ "$failures" = 0 ]
    exit
fi

# make, with every warning on.
check "make" make -C make -j2 CFLAGS="-std=gnu17 -O2 -Wmissing-prototypes $warnings" \
    CXXFLAGS="-std=c++17 -O2 $warnings" all window
says make $all
closed make/libbadge.so
check "the wrapper has at most 60 lines" test "$(wc -l <make/handles.hpp)" -le 60

# What a window shows is what was drawn: SDL saves its frames.
check "window_hash" "$CC" -I make -o window_hash "$root/tests/program/window_hash.c" \
    $(pkg-config --cflags --libs rhw sdl2)
SDL_VIDEODRIVER=dummy SDL_VIDEO_DUMMY_SAVE_FRAMES=1 make/window --frames 3 >drawn
check "window ends with 0" test $? = 0
check "three frames" test "$(ls SDL_window*.bmp | wc -l)" = 3
for frame in SDL_window*.bmp; do ./window_hash "$frame"; done >shown
check "the window shows $(tail -1 shown), drawn is $(cat drawn)" test "$(tail -1 shown)" = "$(cat drawn)"
check "the cube turns" test "$(sort -u shown | wc -l)" = 3
check "the last frame: $(cat drawn)" test "$(cat drawn)" = "640 x 480 f465748b791aba47"
refuse 'usage: window' make/window --frames none
refuse '^window: ' env SDL_VIDEODRIVER=absent make/window --frames 1

# Shaders from files, of texts that glslangValidator compiles; and files that are none.
if command -v glslangValidator >/dev/null 2>&1; then
    check "a vertex shader" glslangValidator -V --quiet -o vert.spv make/screen.vert
    check "a fragment shader" glslangValidator -V --quiet -o frag.spv "$root/examples/disc.frag"
    check "glsl draws" sh -c "make/glsl vert.spv frag.spv | grep -qx 89ea6ada19e175a5"
    check "the size of its picture" test "$(wc -c <glsl.ppm)" = $((15 + 512 * 512 * 3))
    refuse '^frag.spv: the module has no vertex entry point' make/glsl frag.spv frag.spv
    refuse '^absent: cannot be opened$' make/glsl absent frag.spv
    rm glsl.ppm
fi

check "the size of a mesh's picture" test "$(wc -c <mesh.ppm)" = $((15 + 640 * 360 * 3))
rm mesh.ppm

# A golden hash that differs is told, its picture written; --update writes the file as it was.
check "golden" make/golden make/golden.txt
sed 's/^corner .*/corner 1/' make/golden.txt >changed
refuse '^corner: [0-9a-f]{16}, golden is 0000000000000001; see corner.ppm$' make/golden changed
check "one picture" test "$(echo *.ppm)" = corner.ppm
check "its size" test "$(wc -c <corner.ppm)" = $((15 + 160 * 120 * 3))
check "golden --update" make/golden changed --update
check "golden.txt is as it was" cmp changed make/golden.txt
refuse 'usage: golden' make/golden

# Sanitizers in the program alone, on the library as it is.
flags="-O1 -g -fsanitize=address,undefined -fno-sanitize-recover=all"
cp -r "$root/examples/embedding" sanitized
check "make, sanitized" make -C sanitized -j2 CFLAGS="-std=gnu17 $flags" CXXFLAGS="-std=c++17 $flags" $all
says sanitized $all

# CMake, with the package; and a checkout of rhw as a subproject. What is tested is the way to build, so quickly.
check "cmake configures" cmake -S "$root/examples/embedding" -B cmake -G Ninja -DCMAKE_PREFIX_PATH="$folder/prefix" \
    -DCMAKE_BUILD_TYPE=Release
check "cmake without SDL2" cmake -S "$root/examples/embedding" -B no_window -DCMAKE_PREFIX_PATH="$folder/prefix" \
    -DCMAKE_DISABLE_FIND_PACKAGE_SDL2=ON
mv log configured
check "which it says" grep -q '^-- SDL2 is not here (libsdl2-dev): the recipe of a window is left out$' configured
check "cmake builds" cmake --build cmake --parallel 2
says cmake $all
closed cmake/libbadge.so
check "cmake: golden" ctest --test-dir cmake -R golden
check "cmake configures a subproject" cmake -S "$root/examples/embedding" -B under_cmake -G Ninja \
    -DRHW_SOURCE="$root" -DCMAKE_BUILD_TYPE=Debug -DCMAKE_C_FLAGS_DEBUG=-O0
check "cmake builds a subproject" cmake --build under_cmake --parallel 2
says under_cmake $all
check "cmake: golden of a subproject" ctest --test-dir under_cmake -R golden

# Meson, with pkg-config; shaders for every instruction set; and a checkout in subprojects/.
check "meson configures" meson setup meson "$root/examples/embedding"
check "meson builds" meson compile -C meson -j 2
says meson $all
closed meson/libbadge.so
check "meson: golden" meson test -C meson
check "meson configures shaders" meson setup shaders "$root/examples/project"
check "meson builds shaders" meson compile -C shaders -j 2
check "shaders run" shaders/ripples ripples.ppm
shaders/ripples >said
check "the same bytes: $(cat said)" test "$(awk '{print $NF}' said | sort -u | wc -l)" = 1
check "a copy for each instruction set" test \
    "$(nm shaders/ripples | grep -c ' T paint_')" = "$(pkg-config --variable=isas rhw | wc -w)"
cp -r "$root/examples/embedding" over_meson
mkdir over_meson/subprojects
ln -s "$root" over_meson/subprojects/rhw
unset PKG_CONFIG_PATH LD_LIBRARY_PATH
check "meson configures a subproject" meson setup under_meson over_meson -Doptimization=0
check "meson builds a subproject" meson compile -C under_meson -j 2
says under_meson $all
check "meson: golden of a subproject" meson test -C under_meson

echo "$checks checks, $failures failed"
[ "$failures" = 0 ]
