#!/bin/sh
# SPDX-License-Identifier: MIT
# Every public header compiles alone, as C17 and as C++17, without a warning.
# usage: headers.sh INCLUDE_FOLDER C_COMPILER
set -eu
include=$1
case $(basename "$2") in
*clang*) cxx=$(printf %s "$2" | sed 's/clang\([^/]*\)$/clang++\1/') ;;
*) cxx=${CXX:-c++} ;;
esac
failed=0
count=0
for header in "$include"/rhw/*.h; do
    for language in c c++; do
        compiler=$2
        [ $language = c ] || compiler=$cxx
        count=$((count + 1))
        if ! printf '#include <rhw/%s>\n#include <rhw/%s>\nextern int after_them;\n' "$(basename "$header")" "$(basename "$header")" |
            "$compiler" -x $language -std=${language}17 -fsyntax-only -I"$include" \
                -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wundef -Werror -; then
            echo "$header does not compile alone as ${language}17 with $compiler"
            failed=$((failed + 1))
        fi
    done
done
[ $count -gt 0 ] || { echo "no header in $include/rhw"; exit 1; }
echo "$((count - failed)) passed, $failed failed"
[ $failed -eq 0 ]
