#!/bin/sh
# SPDX-License-Identifier: MIT
# The two files of script/amalgamate, as a user takes them: made twice the same, compiled without a flag and without a
# warning, with the bytes of the library on every instruction set, and refused under flags that would change them. More
# compilers and systems are script/determinism's.
# usage: test_amalgamation.sh SOURCE_ROOT C_COMPILER GOLDEN GOLDEN_OBJECT...
#   GOLDEN is the program of tests/golden on the library, the objects are what it is linked of, the library left out
set -u

root=$(realpath "$1")
compiler=$2
golden=$(realpath "$3")
shift 3
failures=0
checks=0
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
trap 'exit 1' INT TERM
cd "$folder" || exit 1
unset CFLAGS LDFLAGS CPATH C_INCLUDE_PATH

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

quiet() { # COMMAND...: without a warning; gcc's note on what GCC 4.6 changed is none
    "$@" >log 2>&1 && ! grep -q "warning" log
}

refused() { # PATTERN FLAGS...: by an #error of ours
    pattern=$1
    shift
    ! "$compiler" "$@" -fsyntax-only rhw.c >log 2>&1 && grep -q "error.*$pattern" log
}

check "it is made" "$root/script/amalgamate" .
check "it is made again" "$root/script/amalgamate" again
check "rhw.c is the same" cmp rhw.c again/rhw.c
check "rhw.h is the same" cmp rhw.h again/rhw.h
rm -r again

check "a bare compile says nothing" quiet "$compiler" -O2 -pthread -c rhw.c
ar rc librhw.a rhw.o
check "it shows no other symbols, and has no state" "$root/tests/structure/symbols.sh" librhw.a
for other in gcc clang; do
    command -v $other >/dev/null || continue
    check "$other has nothing to warn of" quiet $other -Wall -Wextra -fsyntax-only rhw.c
done

# Bytes, of the instruction sets that there are.
check "the golden scenes are linked" "$compiler" -o golden "$@" rhw.o -pthread -lm
# gcc makes the kernels a third smaller, and as slow, where -O2 is not taken for -O3.
check "it is optimized as the library is" \
    test "$(size golden | awk 'END { print 100 * $1 }')" -gt "$(size "$golden" | awk 'END { print 85 * $1 }')"
"$golden" "$root/tests/golden/scenes.txt" --matrix 2 1 >library.cells 2>>differences
./golden "$root/tests/golden/scenes.txt" --matrix 2 1 >cells 2>>differences
check "the bytes are the library's, of the same instruction sets" cmp library.cells cells
check "scenes were drawn" grep -q '^baseline 2 [1-9]' cells
check "nothing differs" test ! -s differences

# Programs that include rhw.h under the names of the headers it is made of.
mkdir rhw
for header in "$root"/include/rhw/*.h; do
    echo '#include "../rhw.h"' >"rhw/$(basename "$header")"
done
for name in 12_mirror 13_reflection; do
    check "$name is compiled" "$compiler" -O2 -pthread -Wno-psabi -ffp-contract=off -I. -I"$root/examples" \
        "$root/examples/$name.c" "$root/examples/picture.c" "$root/examples/solid.c" "$root/tests/outside/picture_hash.c" \
        rhw.o -lm -o $name
    grep "^$name[._ ]" "$root/tests/outside/expected.txt" >expected
    OUTSIDE_THREADS=2 ./$name 2>errors | grep "^$name[._ ]" >said
    check "$name draws what it should: $(head -5 errors)" cmp expected said
done
case $(basename "$compiler") in
*clang*) cxx=$(printf %s "$compiler" | sed 's/clang\([^/]*\)$/clang++\1/') ;;
*) cxx=$(printf %s "$compiler" | sed 's/gcc\([^/]*\)$/g++\1/; s/\(^\|\/\)cc$/\1c++/') ;;
esac
printf '#include "rhw.h"\n#include "rhw.h"\nint main() { return rhw_version() ? 0 : 1; }\n' >program.cpp
check "rhw.h is C++ too" quiet "$cxx" -Wall -Wextra -Wno-psabi program.cpp rhw.o -pthread -o program
check "a C++ program runs" ./program

# The first program of the documents.
sed -n '/^#include/,/^```/{/^```/!p}' "$root/docs/hello.md" | sed 's/<rhw\/.*\.h>/"rhw.h"/' >hello.c
check "the program of docs/hello.md" quiet "$compiler" -O2 -pthread -ffp-contract=off hello.c rhw.o -o hello
check "it runs" ./hello
check "it draws" test "$(head -c 15 hello.ppm | tr '\n' ' ')" = "P6 512 512 255 "

# What equal bytes ask for holds within the file, whatever the flags, or the flags are refused.
case $(uname -m) in
x86_64)
    sed '/^#include/,$d' rhw.c >head.c
    echo 'float f(float a, float b, float c) { return a * b + c; }' >>head.c
    check "it is compiled for fused multiply-adds" "$compiler" -O3 -mfma -S head.c
    check "and fuses none" sh -c '! grep -q fmadd head.s'
    if echo '#include <assert.h>' | "$compiler" -m32 -fsyntax-only -x c - 2>/dev/null; then # with 32-bit headers alone
        check "-mno-sse is refused" refused "msse2 -mfpmath=sse" -m32 -mno-sse
    fi
    ;;
esac
check "-ffast-math is refused" refused "-ffast-math" -O2 -ffast-math
check "-Ofast is refused" refused "-Ofast" -Ofast
check "-ffinite-math-only is refused" refused "-ffinite-math-only" -O2 -ffinite-math-only
case $("$compiler" --version) in
*clang*) ;;
*) check "-funsafe-math-optimizations is refused" refused "-funsafe-math-optimizations" -O2 -funsafe-math-optimizations ;;
esac

echo "$checks checks, $failures failed"
[ "$failures" = 0 ]
