#!/bin/sh
# SPDX-License-Identifier: MIT
# A library shows no symbol without its prefix and keeps no state outside its contexts. The inside of librhw-shader has the
# prefix shader_, which its shared library does not show.
# usage: symbols.sh LIBRARY (librhw or librhw-shader, an archive or a shared library)
set -eu
library=$1
fail=0

case $library in
*.a) symbols=$(nm --extern-only --defined-only "$library") ;;
*) symbols=$(nm --dynamic --extern-only --defined-only "$library") ;;
esac
# Lines of an archive that are no symbols have fewer fields.
names=$(printf '%s\n' "$symbols" | awk 'NF >= 2 && $(NF - 1) ~ /^[A-Za-z]$/ { print $NF }')
[ -n "$names" ] || { echo "$library shows no symbols at all"; exit 1; }
headers=$(ls "$(dirname "$0")"/../../include/rhw/*.h | grep -v '/spirv\.h$')
inside=
case $(basename "$library") in
librhw-shader.*)
    headers=$(dirname "$0")/../../include/rhw/spirv.h
    inside='|^shader_'
    ;;
esac
case $library in *.so*) inside= ;; esac
# _init and _fini are the linker's.
unprefixed=$(printf '%s\n' "$names" | grep -v -E "^rhw_|^_(init|fini)\$$inside" || true)
if [ -n "$unprefixed" ]; then
    echo "symbols without the prefix of $library:"
    printf '  %s\n' $unprefixed
    fail=1
fi
# A shared library shows the public functions and nothing of its inside.
case $library in
*.so*)
    public=$(cat $headers | grep RHW_API | grep -o 'rhw_[a-z0-9_]*(' | tr -d '(' | sort -u)
    shown=$(printf '%s\n' "$names" | grep '^rhw_' | sort -u)
    if [ "$public" != "$shown" ]; then
        echo "$library does not show exactly what its headers declare"
        fail=1
    fi
    ;;
esac

# Writable memory that lives as long as the program: .data, .bss, thread-local and common. (.data.rel.ro is
# constant once it is relocated.) Sections that every object has, with nothing in them, do not count.
state=$(objdump --syms "$library" |
    awk '$0 ~ / O / || $0 ~ /\*COM\*/ { for (i = 1; i <= NF; i++)
             if ($i ~ /^(\.data|\.bss|\.tdata|\.tbss|\*COM\*)/ && $i !~ /^\.data\.rel\.ro/) print $i, $NF }' |
    grep -v -E ' (completed\.0|__dso_handle|__TMC_END__)$' || true)
if [ -n "$state" ]; then
    echo "writable global state:"
    printf '%s\n' "$state" | sed 's/^/  /'
    fail=1
fi
[ $fail -eq 0 ] && echo "1 passed, 0 failed"
exit $fail
