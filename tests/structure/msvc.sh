#!/bin/sh
# SPDX-License-Identifier: MIT
# The public headers as Microsoft's compiler reads them, and clang-cl: clang plays both parts, the first with its own
# name and gcc's taken away. What the first sees has nothing that only gcc and clang know; the second has lanes.
# usage: msvc.sh INCLUDE_FOLDER
set -eu
include=$1
command -v clang >/dev/null 2>&1 || { echo "no clang here"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
trap 'exit 1' INT TERM
# Of the C library the headers ask for this alone; the rest is the compiler's.
printf '#include <stddef.h>\n#ifdef __cplusplus\nextern "C"\n#endif\nvoid *memcpy(void *to, const void *from, size_t size);\n' \
    >"$folder/string.h"
as_clang_cl="--target=x86_64-pc-windows-msvc -fms-extensions -fms-compatibility -fms-compatibility-version=19.30
    -ffreestanding -nostdlibinc -I$folder -I$include -Wall -Wextra -Werror -Wno-builtin-macro-redefined"
as_msvc="$as_clang_cl -U__clang__ -U__GNUC__ -U__GNUC_MINOR__ -U__GNUC_PATCHLEVEL__"
failed=0
count=0
fail() {
    echo "$*"
    failed=$((failed + 1))
}
for header in "$include"/rhw/*.h; do
    name=$(basename "$header")
    printf '#include <rhw/%s>\nextern int after_it;\n' "$name" >"$folder/$name.c"
    for language in c++14 c++20 c11 c17; do
        count=$((count + 2))
        for part in clang_cl msvc; do
            eval "options=\$as_$part"
            clang -x ${language%%[0-9]*} -std=$language $options -fsyntax-only "$folder/$name.c" ||
                fail "$name is no $language for $part"
        done
    done
    # Lines of our headers alone: clang's own know what they use.
    count=$((count + 1))
    clang -x c -std=c17 $as_msvc -E "$folder/$name.c" |
        awk -v ours="$include/" '/^# [0-9]+ "/ { keep = index($3, ours) > 0; next } keep' >"$folder/seen"
    if grep -nE '__attribute__|__builtin_|__extension__|__typeof|__asm|_Pragma|#pragma|vector_size|\(\{' "$folder/seen"; then
        fail "$name shows Microsoft's compiler what it does not know"
    fi
done

# sees PART SYMBOL STATUS: whether a program of that compiler finds a symbol of shader.h.
sees() {
    count=$((count + 1))
    eval "options=\$as_$1"
    printf '#include <rhw/rhw.h>\n#include <rhw/shader.h>\nint size = (int)sizeof(%s);\n' "$2" >"$folder/program.c"
    status=0
    clang -std=c17 $options -fsyntax-only "$folder/program.c" 2>/dev/null || status=1
    [ $status = "$3" ] || fail "$1 and $2: status $status instead of $3"
}
sees clang_cl rhw_float 0
sees clang_cl 'struct rhw_fragment' 0
sees clang_cl 'struct rhw_fragment1' 0
sees msvc rhw_float 1
sees msvc 'struct rhw_fragment' 1
sees msvc 'struct rhw_fragment1' 0
sees msvc 'rhw_sin1(1)' 0

# What a program of the DLL calls is imported, what the DLL is built of exported.
printf '#include <rhw/rhw.h>\n' >"$folder/program.c"
for part in 'RHW_SHARED dllimport' 'RHW_BUILD_SHARED dllexport'; do
    count=$((count + 1))
    clang -std=c17 $as_msvc -D${part% *} -E "$folder/program.c" | grep -q "__declspec(${part#* }) .*rhw_version" ||
        fail "no ${part#* } with ${part% *}"
done
echo "$((count - failed)) passed, $failed failed"
[ $failed -eq 0 ]
