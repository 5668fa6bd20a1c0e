#!/bin/sh
# SPDX-License-Identifier: MIT
# The program asks its system in system/ alone: no other object calls what only POSIX has, and Windows' C library (mingw-w64)
# does not; and each file of system/ has both kinds, for POSIX and for Windows.
# The list has what programs of this kind ask for; what is not in it is not looked for.
# usage: program_platform.sh SYSTEM_FOLDER SYSTEM_LIBRARY OBJECTS...
set -eu

posix="_NSGetExecutablePath alarm dlopen execv execvp fchmod fcntl fmemopen fork fsync getrlimit getrusage kill link lstat"
posix="$posix madvise memfd_create mkdir mkdtemp mkstemp mmap munmap open open_memstream pipe pipe2 poll posix_spawn prctl"
posix="$posix pread pwrite readlink realpath rename scandir select setenv setitimer setrlimit sigaction sigprocmask strndup"
posix="$posix symlink sysconf unsetenv vfork wait waitpid"

folder=$1
library=$2
shift 2
for source in "$folder"/*_posix.c "$folder"/*_windows.c; do
    noun=${source%_*}
    [ -f "${noun}_posix.c" ] && [ -f "${noun}_windows.c" ] && [ -f "$noun.h" ] || {
        echo "$source stands alone"
        exit 1
    }
done
nm -A "$library" "$@" | awk -v posix="$posix" -v library="$library" '
    BEGIN {
        count = split(posix, name, " ")
        for (i = 1; i <= count; i++) is_posix[name[i]] = 1
    }
    NF >= 3 && $(NF - 1) == "U" {
        called = $NF
        sub(/@.*/, "", called)
        sub(/64$/, "", called)
        if (called ~ /^__.*_chk$/) { sub(/^__/, "", called); sub(/_chk$/, "", called) } # fortified
        file = $1
        is_of_system = index(file, library) == 1
        sub(/:$/, "", file)
        sub(/\.o$/, "", file)
        sub(/.*[\/:]/, "", file)
        if (!(file in objects)) files++
        objects[file] = 1
        if (called in is_posix && is_of_system) asked++
        else if (called in is_posix) { print file " calls " called; failed++ }
    }
    END {
        if (files < 100 || asked < 20) { print "these are not the objects of the program"; failed++ }
        print files + 0 " files, " failed + 0 " failed"
        exit failed > 0
    }'
