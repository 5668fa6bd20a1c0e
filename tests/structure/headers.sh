#!/bin/sh
# SPDX-License-Identifier: MIT
# Every public header compiles alone, in every C and C++ since 2011 that the compiler has, without a warning that
# programs switch on, whether the processor's vectors are wide or not.
# usage: headers.sh INCLUDE_FOLDER C_COMPILER
set -eu
include=$1
cc=$2
case $(basename "$cc") in
*clang*)
    cxx=$(printf %s "$cc" | sed 's/clang\([^/]*\)$/clang++\1/')
    gcc_alone=
    ;;
*)
    cxx=${CXX:-c++}
    gcc_alone=-Wuseless-cast
    ;;
esac
warnings="-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wundef -Wcast-align -Werror"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
trap 'exit 1' INT TERM

# compile LANGUAGE STANDARD FILE OPTION...
compile() {
    language=$1
    standard=$2
    file=$3
    shift 3
    if [ "$language" = c ]; then
        "$cc" -x c "-std=$standard" -fsyntax-only -I"$include" $warnings -Wstrict-prototypes "$@" "$file"
    else
        "$cxx" -x c++ "-std=$standard" -fsyntax-only -I"$include" $warnings -Wold-style-cast \
            -Wzero-as-null-pointer-constant -Wextra-semi $gcc_alone "$@" "$file"
    fi
}

failed=0
count=0
# check LANGUAGE STANDARD FILE OPTION...
check() {
    count=$((count + 1))
    compile "$@" || {
        echo "$(basename "$3" .c) does not compile alone: $*"
        failed=$((failed + 1))
    }
}

echo 'int nothing;' >"$folder/nothing"
options=-DRHW_NO_LANES
compile c c11 "$folder/nothing" -mavx512f 2>/dev/null && options="$options -mavx2 -mavx512f"
for header in "$include"/rhw/*.h; do
    name=$(basename "$header")
    printf '#include <rhw/%s>\n#include <rhw/%s>\nextern int after_them;\n' "$name" "$name" >"$folder/$name.c"
    for standard in c11 c17 gnu17 c2x; do
        check c $standard "$folder/$name.c"
    done
    for standard in c++11 c++14 c++17 c++20 c++23 c++2b; do
        compile c++ $standard "$folder/nothing" 2>/dev/null || continue # a compiler knows one name of the newest
        check c++ $standard "$folder/$name.c"
    done
    for option in $options; do
        check c c11 "$folder/$name.c" $option
        check c++ c++11 "$folder/$name.c" $option
    done
done
[ $count -gt 0 ] || { echo "no header in $include/rhw"; exit 1; }
echo "$((count - failed)) passed, $failed failed"
[ $failed -eq 0 ]
