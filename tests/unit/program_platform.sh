#!/bin/sh
# SPDX-License-Identifier: MIT
# Which files of the program call what only POSIX has, and Windows' C library (mingw-w64) does not: those of a list, which
# docs/architecture.md has too. Whoever ports the program begins there.
# usage: program_platform.sh DOCUMENT OBJECTS...
set -eu

posix="alarm chmod dlopen execvp fchmod fmemopen fork fsync getrlimit getrusage kill link lstat madvise memfd_create mmap"
posix="$posix munmap open_memstream pipe pipe2 poll prctl pread realpath scandir select setitimer setrlimit sigaction"
posix="$posix sigprocmask strndup symlink sysconf vfork wait waitpid"

document=$1
shift
nm -A "$@" | awk -v posix="$posix" -v document="$document" '
    BEGIN {
        count = split(posix, name, " ")
        for (i = 1; i <= count; i++) is_posix[name[i]] = 1
        while ((getline line < document) > 0)
            if (line ~ /^\| `[a-z_]+\.c`/) {
                split(line, part, "`")
                is_listed[part[2]] = 1
            }
    }
    NF >= 3 && $(NF - 1) == "U" {
        called = $NF
        sub(/@.*/, "", called)
        sub(/64$/, "", called)
        if (called ~ /^__.*_chk$/) { sub(/^__/, "", called); sub(/_chk$/, "", called) } # fortified
        file = $1
        sub(/:$/, "", file)
        sub(/\.o$/, "", file)
        sub(/.*[\/:]/, "", file)
        objects[file] = 1
        if (called in is_posix) {
            uses[file] = 1
            if (!(file in is_listed)) { print file " calls " called; failed++ }
        }
    }
    END {
        for (file in is_listed) if (!(file in uses)) { print document " lists " file ", which calls nothing of it"; failed++ }
        for (file in objects) files++
        if (files < 100) { print "these are not the objects of the program"; failed++ }
        print files + 0 " files, " failed + 0 " failed"
        exit failed > 0
    }'
