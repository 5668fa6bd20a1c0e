#!/bin/sh
# SPDX-License-Identifier: MIT
# The programs of tests/outside and the lessons of examples/, built on the installed library by its public headers alone.
# The lines "NAME HASH" that each prints of its pictures are those of expected.txt at any number of threads, with any
# instruction set, validated or not, and sanitized; what else a lesson tells, of targets that it writes to no file, is the
# same each time. What a program works out by hand it checks itself, by its status.
# A new lesson needs its lines in expected.txt; any other program needs to be named in CMakeLists.txt, too.
# usage: test_outside.sh BUILD_FOLDER SOURCE_ROOT C_COMPILER [SANITIZERS]
set -u

build=$(realpath "$1")
root=$(realpath "$2")
export CC="$3"
sanitizers=${4:-}
failures=0
checks=0
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
trap 'exit 1' INT TERM
cd "$folder" || exit 1
unset CMAKE_PREFIX_PATH MAKEFLAGS MAKELEVEL CFLAGS LDFLAGS
export UBSAN_OPTIONS=print_stacktrace=1

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

make_programs() { # FOLDER C_FLAGS
    check "$1: cmake configures" cmake -S "$root/tests/outside" -B "$1" -G Ninja -DCMAKE_BUILD_TYPE=None \
        -DCMAKE_PREFIX_PATH="$folder/prefix" -DCMAKE_C_FLAGS="$2"
    check "$1: cmake builds" cmake --build "$1" --parallel 2
}

says() { # FOLDER [VARIABLE=VALUE]...: every program prints what is expected
    in=$1
    shift
    while read -r program; do
        env "$@" "$in/$program" >said 2>errors
        status=$?
        [ -f "told.$program" ] || cp said "told.$program"
        grep "^$program[._ ]" "$root/tests/outside/expected.txt" >expected
        grep "^$program[._ ]" said >pictures
        check "$* $in/$program ends with $status: $(head -30 errors)" test $status = 0
        check "$* $in/$program draws what it should: $(diff expected pictures)" cmp expected pictures
        check "$* $in/$program tells the same as at first: $(diff "told.$program" said)" cmp "told.$program" said
    done <"$in/programs"
}

check "install" cmake --install "$build" --prefix "$folder/prefix"
library=$(dirname "$(find "$folder/prefix" -name pkgconfig)")
export LD_LIBRARY_PATH="$library"
strict="-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wstrict-prototypes -Wmissing-prototypes -Werror"

if [ -n "$sanitizers" ]; then # a library that was built with them asks its users for the same
    make_programs sanitized "-std=gnu17 -O1 -g -fsanitize=$sanitizers -fno-sanitize-recover=all"
    says sanitized OUTSIDE_THREADS=2 OUTSIDE_VALIDATE=on
else
    make_programs plain "-std=gnu17 -O2 $strict"
    for threads in 1 2; do
        for isa in baseline avx2 avx512; do # the highest to use: of those that there are
            says plain OUTSIDE_THREADS=$threads OUTSIDE_ISA=$isa OUTSIDE_VALIDATE=off
        done
        says plain OUTSIDE_THREADS=$threads OUTSIDE_ISA=baseline OUTSIDE_VALIDATE=on
        says plain OUTSIDE_THREADS=$threads OUTSIDE_ISA=avx2 OUTSIDE_VALIDATE=on
    done
    make_programs sanitized "-std=gnu17 -O1 -g -fsanitize=address,undefined -fno-sanitize-recover=all"
    says sanitized OUTSIDE_THREADS=2
fi

echo "$checks checks, $failures failed"
[ "$failures" = 0 ]
