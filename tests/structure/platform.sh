#!/bin/sh
# SPDX-License-Identifier: MIT
# What only POSIX has is called in the files *_posix.c alone: the rest of the libraries calls ISO C, which Windows has too.
# usage: platform.sh LIBRHW LIBRHW_SHADER (archives)
set -eu

# Functions of C11, and what compilers call by themselves.
c11="abort calloc free malloc memchr memcmp memcpy memmove memset strchr strcmp strcspn strlen strncmp strpbrk strrchr strspn strstr"
c11="$c11 fclose fgets fopen fprintf fputc fputs fwrite getenv snprintf longjmp qsort sscanf stderr strtol vsnprintf sqrt sqrtf"
glibc="_setjmp" # what its setjmp is
compiler="_GLOBAL_OFFSET_TABLE_ bcmp __assert_fail __popcountdi2 __stack_chk_fail"

nm "$@" | awk -v known="$c11 $glibc $compiler" '
    BEGIN { count = split(known, name, " "); for (i = 1; i <= count; i++) is_known[name[i]] = 1 }
    /^[^ ]+\.o:$/ { object = $1; objects++; is_posix = object ~ /_posix\.c\.o:$/; posix += is_posix }
    NF == 2 && ($1 == "U" || $1 == "w") && !is_posix {
        called = $2
        sub(/^__isoc[0-9]*_/, "", called) # glibc has scanf twice
        if (called ~ /^__.*_chk$/) { sub(/^__/, "", called); sub(/_chk$/, "", called) } # and, fortified, more
        if (called !~ /^(rhw|shader)_/ && !(called in is_known)) { print object " " $2 " is not C11"; failed++ }
    }
    END {
        if (objects < 50 || posix < 3) { print "these are not the objects of librhw"; failed++ }
        print objects - posix " objects, " failed + 0 " failed"
        exit failed > 0
    }'
