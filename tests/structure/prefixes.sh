#!/bin/sh
# SPDX-License-Identifier: MIT
# The prefix rhw_ or RHW_ is the library's alone: no file beside it defines or declares a function, variable, type,
# enumerator or macro of such a name, not even of one that the library has too.
# usage: prefixes.sh PROJECT_FOLDER
set -eu
cd "$1"
# RHW_ISA_NAME is the exception: sources compiled once per instruction set name their symbols by it everywhere.
find scene glsl vulkan system tools bench examples tests python -name '*.[ch]' | sort | xargs awk '
    function report(name) {
        if (name != "RHW_ISA_NAME") { print FILENAME ":" FNR ": " name; failed++ }
    }
    # Reports the first name with the prefix in text.
    function report_first(text) {
        match(text, /(rhw|RHW)_[A-Za-z0-9_]*/)
        report(substr(text, RSTART, RLENGTH))
    }
    # An enumerator stands first in the body or after a comma; what follows an equals sign is only used.
    function report_enumerators(text,    part, count, i) {
        sub(/\/\/.*/, "", text)
        sub(/}.*/, "", text)
        count = split(text, part, ",")
        for (i = 1; i <= count; i++) {
            if (part[i] ~ /^[ \t]*(rhw|RHW)_/) { report_first(part[i]) }
        }
    }
    FNR == 1 { files++; in_enum = 0 }
    /^#[ \t]*define[ \t]+(rhw|RHW)_/ { report_first($0) }
    /(^|[ \t])(struct|union|enum)[ \t]+(rhw|RHW)_[A-Za-z0-9_]*[ \t]*[{]/ { report_first($0) }
    in_enum { report_enumerators($0) }
    /(^|[ \t])enum([ \t]+[A-Za-z0-9_]+)?[ \t]*[{]/ {
        in_enum = 1
        body = $0
        sub(/.*enum([ \t]+[A-Za-z0-9_]+)?[ \t]*[{]/, "", body)
        report_enumerators(body)
    }
    in_enum && /}/ { in_enum = 0 }
    # Functions, variables of a file and types by typedef start a line; `struct rhw_pass;` alone announces a type.
    /^[A-Za-z_][A-Za-z0-9_ *]*[ *](rhw|RHW)_[A-Za-z0-9_]*([(]|\[|;|,| =)/ && !/^(struct|union|enum) [A-Za-z0-9_]*;/ {
        text = $0
        sub(/([(]|\[|;|,| =).*/, "", text)
        sub(/.*[ *]/, "", text)
        report(text)
    }
    /^typedef.*[(][*](rhw|RHW)_/ {
        text = $0
        sub(/.*[(][*]/, "", text)
        report_first(text)
    }
    END {
        if (failed) { print "these names have the prefix of the library and are not part of it" }
        print (files > 0 && !failed) ? "1 passed, 0 failed" : "0 passed, 1 failed"
        exit !(files > 0 && !failed)
    }'
