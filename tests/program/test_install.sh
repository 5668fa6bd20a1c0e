#!/bin/sh
# SPDX-License-Identifier: MIT
# The installed libraries, as a project of its own meets them: examples/project is built with find_package and
# rhw_add_shaders, and with pkg-config and make, and draws the same bytes with every copy of its shaders; and a program is
# linked with the static and the shared library in every way there is.
# usage: test_install.sh BUILD_FOLDER SOURCE_ROOT C_COMPILER
set -u

build=$(realpath "$1")
root=$(realpath "$2")
export CC="$3"
for tool in pkg-config make objdump readelf; do
    command -v $tool >/dev/null 2>&1 || { echo "no $tool here"; exit 77; }
done
failures=0
checks=0
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
trap 'exit 1' INT TERM
cd "$folder" || exit 1
unset CMAKE_PREFIX_PATH MAKEFLAGS MAKELEVEL

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
    if "$@" >log 2>&1 || ! tr -s '\n ' ' ' <log | grep -Eq "$pattern"; then
        failures=$((failures + 1))
        echo "FAILED: $* is not refused with '$pattern'" >&2
        tail -20 log >&2
    fi
}

# Installed in one place and moved to another: nothing names the first.
check "install" cmake --install "$build" --prefix "$folder/first"
mv first prefix
check "a man page of the library" test -s prefix/share/man/man3/rhw.3
if [ -x prefix/bin/rhw ]; then # a build of the library alone has no program
    for file in man/man1/rhw.1 bash-completion/completions/rhw zsh/site-functions/_rhw fish/vendor_completions.d/rhw.fish; do
        check "installed: $file" test -s prefix/share/$file
    done
    check "types of models for desktops" grep -q 'glob pattern="\*.ply"' prefix/share/mime/packages/rhw-models.xml
    check "thumbnails for desktops" grep -q 'application/x-ply' prefix/share/thumbnailers/rhw.thumbnailer
fi
library=$(dirname "$(find "$folder/prefix" -name pkgconfig)")
export PKG_CONFIG_PATH="$library/pkgconfig" LD_LIBRARY_PATH="$library"
isas=$(pkg-config --variable=isas rhw)
case $isas in baseline*) ;; *) check "pkg-config names the instruction sets: '$isas'" false ;; esac
strict="-Wall -Wextra -Wpedantic -Wconversion -Wmissing-prototypes -Werror"

cp -r "$root/examples/project" make
check "make without the package says so" sh -c '! PKG_CONFIG_LIBDIR=/nowhere PKG_CONFIG_PATH=/nowhere make -C make >said 2>&1 && grep -q "pkg-config does not find rhw: set PKG_CONFIG_PATH" said'
check "make" make -C make CFLAGS="-std=gnu17 -O2 $strict"
cp -r "$root/examples/project" cmake
check "cmake configures" cmake -S cmake -B cmake/build -DCMAKE_PREFIX_PATH="$folder/prefix" \
    -DCMAKE_BUILD_TYPE=Release -DCMAKE_C_FLAGS="$strict"
check "cmake builds" cmake --build cmake/build

make/ripples make.ppm >make.txt || check "the program of make ends with 0" false
cmake/build/ripples cmake.ppm >cmake.txt || check "the program of cmake ends with 0" false
check "a picture" test "$(head -c 15 make.ppm | tr '\n' ' ')" = "P6 500 400 255 "
check "one picture" cmp make.ppm cmake.ppm
check "the baseline and the one-at-a-time form ran" test "$(grep -cE '^(baseline|one at a time) ' make.txt)" = 2
check "the same lines" cmp make.txt cmake.txt
check "the same bytes: $(cat make.txt)" test "$(awk '{print $NF}' make.txt | sort -u | wc -l)" = 1

# Every copy is there, compiled for what its name says: 32-byte registers from AVX2 on.
for program in make/ripples cmake/build/ripples; do
    for isa in $isas; do
        objdump -d --disassemble="paint_$isa" $program >code
        check "$program has paint_$isa" grep -q "<paint_$isa>:" code
        case $isa in
        avx*) check "paint_$isa of $program" grep -q '%ymm' code ;;
        *) check "paint_$isa of $program" test "$(grep -c '%ymm' code)" = 0 ;;
        esac
    done
done

# A program with each of the libraries. Which one rhw is, and whether both are there, the build was told.
setting() { # NAME: what it is in the build
    sed -n "s/^$1:[A-Z]*=//p" "$build/CMakeCache.txt"
}
case $(setting BUILD_SHARED_LIBS) in ON) kind=shared ;; *) kind=static ;; esac
kinds=$kind
[ "$(setting RHW_BOTH_LIBRARIES)" != ON ] || kinds="static shared"
sed -n '/^#include/,/^```/{/^```/!p}' "$root/docs/hello.md" >hello.c
needs() { # PROGRAM KIND: the shared library, or not
    readelf -d "$1" >dynamic
    case $2 in
    shared) grep -q 'NEEDED.*\[librhw\.so\.[0-9]*\.[0-9]*\]' dynamic ;;
    *) ! grep -q 'NEEDED.*librhw' dynamic ;;
    esac
}
draws() { # PROGRAM KIND: is linked as it should be, and draws what the first one draws
    check "$1 is linked with the $2 library" needs "./$1" "$2"
    rm -f hello.ppm
    check "$1 runs" "./$1"
    [ -f first.ppm ] || cp hello.ppm first.ppm
    check "$1 draws the same" cmp hello.ppm first.ppm
}
links() { # PROGRAM PKG-CONFIG-ARGUMENT...
    program=$1
    shift
    check "$program is built" sh -c "$CC -O2 hello.c $* -o $program"
}
version=$("$CC" -E -dM "$root/include/rhw/base.h" | awk '/RHW_VERSION_/ { print $3 }' | paste -sd .)
for one in $kinds; do
    case $one in
    static) check "librhw.a, librhw-shader.a" test -s "$library/librhw.a" -a -s "$library/librhw-shader.a" ;;
    shared)
        check "librhw.so leads to that of the version" test "$(readlink -f "$library/librhw.so")" = "$(realpath "$library")/librhw.so.$version"
        check "its name is that of its ABI" sh -c "readelf -d '$library/librhw.so' | grep -q 'SONAME.*\[librhw.so.${version%.*}\]'"
        check "it says what it shows" "$root/tests/structure/symbols.sh" "$library/librhw.so" "$library/librhw-shader.so"
        check "librhw-shader.so leads to that of the version" test \
            "$(readlink -f "$library/librhw-shader.so")" = "$(realpath "$library")/librhw-shader.so.$version"
        ;;
    esac
    links "pc_$one" "\$(pkg-config --cflags --libs rhw-$one)"
    draws "pc_$one" $one
done
links pc_rhw '$(pkg-config --cflags --libs rhw)'
draws pc_rhw $kind
case $kinds in
*static*)
    links pc_wholly_static '-static $(pkg-config --static --cflags --libs rhw)'
    draws pc_wholly_static static
    ;;
esac

# librhw-shader brings librhw along. What is no module is refused by either.
cat >spirv.c <<'C'
#include <rhw/spirv.h>
#include <stdio.h>
int main(void)
{
    char message[RHW_SHADER_MESSAGE];
    rhw_shader *shader;
    rhw_shader_program *program;
    const struct rhw_shader_program_def nothing = {0};
    if (rhw_shader_create("words", 5, &(struct rhw_shader_def){0}, &shader, message) != RHW_ERROR_MISUSE) { return 1; }
    printf("%s\n%s\n", rhw_version(), message);
    return rhw_shader_program_create(&nothing, &program, message) != RHW_ERROR_MISUSE;
}
C
refuses() { # PROGRAM KIND
    check "$1 is linked with the $2 library" needs "./$1" "$2"
    check "$1 refuses what is no module" sh -c "./$1 | grep -q 'whole words'"
}
for one in $kinds; do
    check "spirv_$one is built" sh -c "$CC -O2 spirv.c \$(pkg-config --cflags --libs rhw-shader-$one) -o spirv_$one"
    refuses spirv_$one $one
done
check "spirv is built" sh -c "$CC -O2 spirv.c \$(pkg-config --cflags --libs rhw-shader) -o spirv"
refuses spirv $kind

mkdir linked
cat >linked/CMakeLists.txt <<'CMAKE'
cmake_minimum_required(VERSION 3.22)
project(linked LANGUAGES C)
find_package(rhw REQUIRED)
foreach(library IN LISTS LIBRARIES)
  add_executable(cmake_${library} ../hello.c)
  target_link_libraries(cmake_${library} PRIVATE rhw::${library})
  string(REPLACE rhw rhw_shader shader ${library})
  add_executable(cmake_${shader} ../spirv.c)
  target_link_libraries(cmake_${shader} PRIVATE rhw::${shader})
endforeach()
CMAKE
libraries=rhw
for one in $kinds; do
    libraries="$libraries;rhw_$one"
done
check "linked configures" cmake -S linked -B linked/build -DCMAKE_PREFIX_PATH="$folder/prefix" -DLIBRARIES="$libraries"
check "linked builds" cmake --build linked/build
for one in $kinds; do
    draws linked/build/cmake_rhw_$one $one
    refuses linked/build/cmake_rhw_shader_$one $one
done
draws linked/build/cmake_rhw $kind
refuses linked/build/cmake_rhw_shader $kind

# The copies see what their target has, also what it is given after the call, and a target may be called for twice.
mkdir given given/folder
cat >given/CMakeLists.txt <<'CMAKE'
cmake_minimum_required(VERSION 3.22)
project(given LANGUAGES C)
add_subdirectory(folder)
rhw_add_shaders(given two.c)
CMAKE
cat >given/folder/CMakeLists.txt <<'CMAKE'
find_package(rhw REQUIRED)
add_library(given SHARED one.c)
rhw_add_shaders(given one.c)
target_compile_definitions(given PRIVATE GIVEN=1)
target_link_libraries(given PRIVATE rhw::rhw)
CMAKE
cat >given/two.c <<'C'
#include <rhw/isa.h>
#if GIVEN != 1
#error "no definition"
#endif
#ifdef RHW_ISA_SUFFIX
RHW_ISA_DECLARE(const int, FILE_NAME);
const int RHW_ISA_NAME(FILE_NAME) = 1;
#endif
C
sed 's/FILE_NAME/one/' given/two.c >given/folder/one.c
sed -i 's/FILE_NAME/two/' given/two.c
check "given configures" cmake -S given -B given/build -DCMAKE_PREFIX_PATH="$folder/prefix"
check "given builds" cmake --build given/build
for isa in $isas; do
    for name in one two; do
        check "given has ${name}_$isa" sh -c "nm -D given/build/folder/libgiven.so | grep -q ' ${name}_$isa\$'"
    done
done

# Shaders in GLSL become C on the way: the program needs librhw alone.
if [ -x prefix/bin/rhw ]; then
    mkdir translated
    cat >translated/CMakeLists.txt <<'CMAKE'
cmake_minimum_required(VERSION 3.22)
project(translated LANGUAGES C)
find_package(rhw REQUIRED)
add_executable(translated main.c)
target_link_libraries(translated PRIVATE rhw::rhw)
rhw_add_shaders(translated more.comp flat-red.vert flat-red.frag)
find_program(GLSLANG glslangValidator)
if(GLSLANG)
  rhw_add_glsl(translated in-words.comp)
endif()
CMAKE
    cat >translated/more.comp <<'GLSL'
#version 450
#extension GL_GOOGLE_include_directive : enable
#include "factor.glsl"
layout(local_size_x = 8) in;
layout(set = 0, binding = 3) buffer Numbers { float numbers[]; };
void main() { numbers[gl_LocalInvocationIndex] *= FACTOR; }
GLSL
    cp translated/more.comp translated/in-words.comp
    echo '#define FACTOR 2.0' >translated/factor.glsl
    echo 'void main() { gl_Position = vec4(0.0, 0.0, 0.0, 1.0); }' >translated/flat-red.vert
    echo 'layout(location = 0) out vec4 color; void main() { color = vec4(1.0); }' >translated/flat-red.frag
    cat >translated/main.c <<'C'
#include <rhw/bind.h>
#include <rhw/rhw.h>
#include <rhw/spirv.h>
#include <stdlib.h>

extern const struct rhw_compute_program more_program;
extern const struct rhw_shader_layout more_layout[1];
extern const struct rhw_program flat_red_program;

int main(int argc, char **argv)
{
    const float factor = argc > 1 ? strtof(argv[1], NULL) : 0;
    const struct rhw_context_def def = rhw_context_def_default();
    float numbers[8] = {0, 1, 2, 3, 4, 5, 6, 7};
    struct rhw_binding set;
    rhw_context *context;
    if (rhw_context_create(&def, &context) != RHW_OK || !flat_red_program.fragment[RHW_ISA_BASELINE] ||
        more_layout[0].binding != 3 || !rhw_binding_of_memory(numbers, sizeof numbers, false, &set)) {
        return 2;
    }
    const struct rhw_shader_frame frame = {.sets = {&set}};
    const struct rhw_dispatch_def dispatch = {
        .program = more_program, .uniforms = &frame, .uniform_bytes = sizeof frame};
    const enum rhw_result result = rhw_dispatch(context, &dispatch, 1, 1, 1);
    rhw_context_destroy(context);
    return result == RHW_OK && numbers[1] == factor && numbers[7] == 7 * factor ? 0 : 1;
}
C
    check "translated configures" cmake -S translated -B translated/build -DCMAKE_PREFIX_PATH="$folder/prefix"
    check "translated builds" cmake --build translated/build
    check "translated runs" translated/build/translated 2
    words=translated/build/translated_glsl/in_words_comp.h
    check "words of 2" sh -c "[ ! -e $words ] || grep -q 0x40000000 $words"
    # What a text includes is a part of it.
    echo '#define FACTOR 3.0' >translated/factor.glsl
    touch -d '+2 seconds' translated/factor.glsl
    check "translated builds again" cmake --build translated/build
    check "translated has changed" translated/build/translated 3
    check "words of 3" sh -c "[ ! -e $words ] || grep -q 0x40400000 $words"
fi

# Mistakes end with a line that says what is wrong.
mistake() { # PATTERN CALL
    mkdir -p mistake
    printf 'cmake_minimum_required(VERSION 3.22)\nproject(mistake LANGUAGES C)\nfind_package(rhw REQUIRED)\n%s\n' "$2" \
        >mistake/CMakeLists.txt
    refuse "$1" cmake -S mistake -B mistake/build -DCMAKE_PREFIX_PATH="$folder/prefix"
}
mistake 'rhw_add_shaders: there is no target ripples' 'rhw_add_shaders(ripples shaders.c)'
mistake 'rhw_add_shaders: rhw::rhw is imported' 'rhw_add_shaders(rhw::rhw shaders.c)'
mistake 'rhw_add_shaders: mistake is given no file' 'add_library(mistake a.c)
rhw_add_shaders(mistake)'

echo "$checks checks, $failures failed"
[ "$failures" = 0 ]
