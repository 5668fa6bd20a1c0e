#!/bin/sh
# SPDX-License-Identifier: MIT
# Every header of the libraries and of scene/ includes what it uses: it compiles alone, as C17, without a warning, and can
# be included twice. Headers of kernels are written for a source that is compiled once per instruction set; here they
# are compiled for the baseline, and the functions they define go unused.
# Headers of vulkan/ have rooms of their own, and need those of Vulkan.
# usage: private_headers.sh PROJECT_FOLDER C_COMPILER
set -eu
root=$1
compiler=$2
failed=0
count=0
folders="src shader scene"
if echo '#include <vulkan/vk_icd.h>' | "$compiler" -x c -fsyntax-only - 2>/dev/null; then
    folders="$folders vulkan"
fi
for header in $(cd "$root" && find $folders -name '*.h' | sort); do
    count=$((count + 1))
    case $header in
    vulkan/*) rooms="-iquote $root/vulkan" ;;
    *) rooms="-iquote $root/src -iquote $root/shader -iquote $root/scene" ;;
    esac
    if ! printf '#include "%s"\n#include "%s"\nextern int not_empty;\n' "$header" "$header" |
        "$compiler" -x c -std=gnu17 -fsyntax-only -I"$root" -I"$root/include" \
            $rooms -DRHW_ISA_SUFFIX=baseline \
            -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wundef \
            -Wno-unused-function -Wno-psabi -Werror -; then
        echo "$header does not compile alone with $compiler"
        failed=$((failed + 1))
    fi
done
[ $count -gt 0 ] || { echo "no header in $root/src"; exit 1; }
echo "$((count - failed)) passed, $failed failed"
[ $failed -eq 0 ]
