#!/bin/sh
# SPDX-License-Identifier: MIT
# A program whose flags would make its shaders draw other bytes is refused: by an #error of the headers, or, where only
# arithmetic can tell, by rhw_pipeline_create. Flags that change nothing are taken. With gcc and clang, C and C++.
# usage: test_flags.sh LIBRHW SOURCE_ROOT C_COMPILER
set -u

library=$(realpath "$1")
include=$(realpath "$2")/include
compiler=$3
failures=0
checks=0
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
trap 'exit 1' INT TERM
cd "$folder" || exit 1
LD_LIBRARY_PATH=$(dirname "$library")
export LD_LIBRARY_PATH

# One file with its shaders and its pipeline, C and C++ alike. Status 3 and the message: misuse.
cat >program.c <<'C'
#include <rhw/rhw.h>
#include <rhw/shader.h>
#include <stdio.h>
#include <stdlib.h>

static void told(void *user, const char *message)
{
    (void)user;
    printf("%s\n", message);
    exit(3);
}

static void place(struct rhw_vertex1 *v)
{
    v->position[0] = v->position[1] = v->position[2] = 0;
    v->position[3] = 1;
}

int main(void)
{
    struct rhw_context_def context_def = rhw_context_def_default();
    struct rhw_pipeline_def def = rhw_pipeline_def_default();
    rhw_context *context;
    rhw_pipeline pipeline;
    context_def.threads = 1;
    context_def.assert_ = told;
    def.program.vertex1 = place;
    def.target_count = 0;
    if (rhw_context_create(&context_def, &context) != RHW_OK) {
        return 1;
    }
    const bool created = rhw_pipeline_create(context, &def, &pipeline) == RHW_OK;
    rhw_context_destroy(context);
    return created ? 0 : 1;
}
C
cp program.c program.cpp
# The rest of a program, which has no shaders, may be compiled as it likes.
echo '#include <rhw/rhw.h>' >without_shaders.c

failed() { # TEXT
    failures=$((failures + 1))
    echo "FAILED: $*" >&2
    tail -5 log >&2
}

compile() { # COMPILER FILE FLAGS...
    with=$1
    file=$2
    shift 2
    "$with" "$@" -Wno-psabi -I"$include" "$file" "$library" -pthread -o program >log 2>&1
}

takes() { # COMPILER FILE FLAGS...: compiled and created
    checks=$((checks + 1))
    compile "$@" && ./program >log 2>&1 || failed "$* is not taken"
}

tells() { # PATTERN COMPILER FILE FLAGS...: compiled, and told when the pipeline is created
    checks=$((checks + 1))
    pattern=$1
    shift
    compile "$@" || { failed "$* is not compiled"; return; }
    ./program >log 2>&1
    [ $? = 3 ] && grep -Eq "^rhw_pipeline_create: .*$pattern" log || failed "$* is not told with '$pattern'"
}

refuses() { # PATTERN COMPILER FILE FLAGS...: an #error
    checks=$((checks + 1))
    pattern=$1
    shift
    compile "$@" && { failed "$* is compiled"; return; }
    grep -Eq "#?error:? .*$pattern" log || failed "$* is not refused with '$pattern'"
}

# How this machine's compilers are told to use fused multiply-adds, where it has them.
fuse=none
case $(uname -m) in
x86_64) grep -qw fma /proc/cpuinfo && fuse=-mfma ;;
aarch64) fuse= ;;
esac

try() { # COMPILER FILE STANDARD
    cc=$1
    file=$2
    gnu=$3
    for flags in -O0 -O2 "-O3 -ffp-contract=off" "-O2 -fno-math-errno -fno-trapping-math -frounding-math"; do
        takes "$cc" "$file" "-std=$gnu" -ffp-contract=off $flags
    done
    refuses "-ffast-math" "$cc" "$file" "-std=$gnu" -ffast-math
    refuses "-Ofast" "$cc" "$file" "-std=$gnu" -Ofast
    refuses "-ffinite-math-only" "$cc" "$file" "-std=$gnu" -O2 -ffinite-math-only
    unsafe="-O2 -ffp-contract=off -fno-signed-zeros -fno-trapping-math -fassociative-math"
    case $cc in
    *clang*) tells "-fassociative-math" "$cc" "$file" "-std=$gnu" $unsafe ;;
    *)
        refuses "-funsafe-math-optimizations" "$cc" "$file" "-std=$gnu" $unsafe
        refuses "-funsafe-math-optimizations" "$cc" "$file" "-std=$gnu" -funsafe-math-optimizations
        ;;
    esac
    [ "$fuse" != none ] || return 0
    takes "$cc" "$file" "-std=$gnu" -O2 $fuse -ffp-contract=off
    tells "-ffp-contract=off" "$cc" "$file" "-std=$gnu" -O2 $fuse -ffp-contract=fast
    # What is missing is the flag: this is the compilers' default, but for clang before 14.
    case $cc in
    *clang*) ;;
    *) tells "-ffp-contract=off" "$cc" "$file" "-std=$gnu" -O2 $fuse ;;
    esac
}

found=
for cc in "$compiler" gcc clang; do
    path=$(command -v "$cc") || continue
    path=$(realpath "$path")
    case " $found " in *" $path "*) continue ;; esac
    found="$found $path"
    case $(basename "$cc") in
    *clang*) cxx=$(printf %s "$cc" | sed 's/clang\([^/]*\)$/clang++\1/') ;;
    *) cxx=$(printf %s "$cc" | sed 's/gcc\([^/]*\)$/g++\1/; s/\(^\|\/\)cc$/\1c++/') ;;
    esac
    try "$cc" program.c gnu17
    if [ "$cxx" != "$cc" ] && command -v "$cxx" >/dev/null; then
        try "$cxx" program.cpp gnu++17
    fi

    checks=$((checks + 1))
    "$cc" -Ofast -I"$include" -fsyntax-only without_shaders.c >log 2>&1 ||
        failed "$cc refuses -Ofast where no shader header is included"
    # This header compiles without a C library, so a compiler that targets 64 bits alone can be asked.
    [ "$(uname -m)" = x86_64 ] || continue
    checks=$((checks + 2))
    "$cc" -m32 -mno-sse -ffreestanding -I"$include" -fsyntax-only -include rhw/shader_lanes.h -x c \
        /dev/null >log 2>&1
    grep -q 'error.*-msse2 -mfpmath=sse' log || failed "$cc -m32 -mno-sse is not refused"
    "$cc" -m32 -msse2 -mfpmath=sse -ffreestanding -I"$include" -fsyntax-only -include rhw/shader_lanes.h -x c \
        /dev/null >log 2>&1 ||
        failed "$cc -m32 -msse2 -mfpmath=sse is refused"
done

echo "$checks checks, $failures failed"
[ "$failures" = 0 ]
