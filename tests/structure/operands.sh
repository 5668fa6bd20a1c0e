#!/bin/sh
# SPDX-License-Identifier: MIT
# operands.c as every dialect in which shaders are written, without a warning; then that lanes of the wrong kind are
# refused. usage: operands.sh PROJECT_FOLDER C_COMPILER
set -eu
project=$1
case $(basename "$2") in
*clang*) cxx=$(printf %s "$2" | sed 's/clang\([^/]*\)$/clang++\1/') ;;
*) cxx=${CXX:-c++} ;;
esac
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
flags="-O1 -I$project/include -ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wno-psabi -Werror"
passed=0
failed=0

result() { # NAME STATUS
    if [ "$2" -eq 0 ]; then passed=$((passed + 1)); else
        failed=$((failed + 1))
        echo "$1: failed"
    fi
}

# Sampling is the library's: nothing here calls it, but a linker may ask.
echo 'void rhw_sample(void); void rhw_sample(void) {} void rhw_sample1(void); void rhw_sample1(void) {}' >"$folder/sample.c"
"$2" -c -o "$folder/sample.o" "$folder/sample.c"
for language in gnu11 gnu17 gnu++11 gnu++17 gnu++20; do
    case $language in
    *++*) compiler="$cxx -x c++" ;;
    *) compiler="$2 -x c" ;;
    esac
    status=0
    $compiler -std=$language $flags -c -o "$folder/operands.o" "$project/tests/structure/operands.c" &&
        "$2" -o "$folder/operands" "$folder/operands.o" "$folder/sample.o" && "$folder/operands" || status=1
    result "operands.c as $language" $status
done

# Integers for floats, and the other way: no conversion by itself.
for call in 'rhw_max(v, i)' 'rhw_less(i, 0)' 'rhw_mix(v, v, i)' 'rhw_min_int(v, 3)' 'rhw_dual_add(rhw_dual_constant(v), i)'; do
    for language in gnu17 gnu++17; do
        case $language in
        *++*) compiler="$cxx -x c++" ;;
        *) compiler="$2 -x c" ;;
        esac
        printf '#include <rhw/shader_dual.h>\nvoid use(rhw_float v, rhw_int i); void use(rhw_float v, rhw_int i) { (void)v; (void)i; (void)%s; }\n' \
            "$call" >"$folder/wrong"
        status=0
        $compiler -std=$language -I"$project/include" -Wno-psabi -fsyntax-only "$folder/wrong" 2>"$folder/log" && status=1
        result "$call as $language must be refused" $status
    done
done
echo "$passed passed, $failed failed"
[ $failed -eq 0 ]
