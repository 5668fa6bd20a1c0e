#!/bin/sh
# SPDX-License-Identifier: MIT
# A library shows no symbol without its prefix and keeps no state outside its contexts. The inside of librhw-shader has the
# prefix shader_ in its sources, which its shared library does not show, and its archive has under another name.
# usage: symbols.sh LIBRARY... (librhw and librhw-shader, archives or shared libraries)
set -eu
include=$(dirname "$0")/../../include/rhw
fail=0

check_names() { # LIBRARY
    headers=$(ls "$include"/*.h | grep -v '/spirv\.h$')
    prefix='^rhw_'
    case $(basename "$1") in
    librhw-shader.so*) headers=$include/spirv.h ;;
    esac
    case $1 in
    *.a) symbols=$(nm --extern-only --defined-only "$1") ;;
    *) symbols=$(nm --dynamic --extern-only --defined-only "$1") ;;
    esac
    # Lines of an archive that are no symbols have fewer fields.
    names=$(printf '%s\n' "$symbols" | awk 'NF >= 2 && $(NF - 1) ~ /^[A-Za-z]$/ { print $NF }')
    [ -n "$names" ] || { echo "$1 shows no symbols at all"; exit 1; }
    # _init and _fini are the linker's.
    unprefixed=$(printf '%s\n' "$names" | grep -v -E "$prefix|^_(init|fini)\$" || true)
    if [ -n "$unprefixed" ]; then
        echo "$1 has symbols without its prefix:"
        printf '  %s\n' $unprefixed
        fail=1
    fi
    # A shared library shows the public functions and nothing of its inside.
    case $1 in
    *.so*)
        public=$(cat $headers | grep RHW_API | grep -o 'rhw_[a-z0-9_]*(' | tr -d '(' | sort -u)
        shown=$(printf '%s\n' "$names" | grep '^rhw_' | sort -u)
        if [ "$public" != "$shown" ]; then
            echo "$1 does not show exactly what its headers declare"
            fail=1
        fi
        ;;
    esac
}

# Writable memory that lives as long as the program: .data, .bss, thread-local and common. (.data.rel.ro is
# constant once it is relocated.) Sections that every object has, with nothing in them, do not count.
check_state() { # LIBRARY
    state=$(objdump --syms "$1" |
        awk '$0 ~ / O / || $0 ~ /\*COM\*/ { for (i = 1; i <= NF; i++)
                 if ($i ~ /^(\.data|\.bss|\.tdata|\.tbss|\*COM\*)/ && $i !~ /^\.data\.rel\.ro/) print $i, $NF }' |
        grep -v -E ' (completed\.0|__dso_handle|__TMC_END__)$' || true)
    if [ -n "$state" ]; then
        echo "$1 has writable global state:"
        printf '%s\n' "$state" | sed 's/^/  /'
        fail=1
    fi
}

for library; do
    check_names "$library"
    check_state "$library"
done
[ $fail -eq 0 ] && echo "$# passed, 0 failed"
exit $fail
