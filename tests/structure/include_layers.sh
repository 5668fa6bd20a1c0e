#!/bin/sh
# SPDX-License-Identifier: MIT
# How files of src/ include each other: (a) no large circle of source-and-header pairs outside kernels, (b) no long
# chain of includes within kernels, (c) the folders of kernels point down, from tile to fragment to raster.
# usage: include_layers.sh SRC_FOLDER [LONGEST_CHAIN]
set -eu
cd "$1"
largest_circle=3          # pairs
longest_chain=${2:-17}    # files, the source at the top included
failed=0

# Lines "file included", both as paths from here, for the files that are named; what is not here is left out.
includes() {
    awk '
    function resolve(from, name,    path, n, part, i, out, depth) {
        path = from
        sub(/[^\/]*$/, "", path)
        n = split(path name, part, "/")
        depth = 0
        for (i = 1; i <= n; i++) {
            if (part[i] == "..") { depth--; continue }
            if (part[i] != "." && part[i] != "") out[++depth] = part[i]
        }
        path = out[1]
        for (i = 2; i <= depth; i++) path = path "/" out[i]
        return path
    }
    /^#include "/ {
        split($0, quoted, "\"")
        print FILENAME, resolve(FILENAME, quoted[2])
    }' "$@"
}

# (a) Of pairs that reach each other, the most that hang together.
circle=$(includes *.c *.h | awk '
    function pair(file) { sub(/\.[ch]$/, "", file); return file }
    $2 !~ /\// && pair($1) != pair($2) {
        reach[pair($1), pair($2)] = 1
        name[pair($1)] = name[pair($2)] = 1
    }
    END {
        for (k in name) for (i in name) if ((i, k) in reach) for (j in name) if ((k, j) in reach) reach[i, j] = 1
        most = 0
        for (i in name) {
            count = 0
            members = ""
            for (j in name) if (((i, j) in reach) && ((j, i) in reach)) { count++; members = members " " j }
            if (count > most) { most = count; found = members }
        }
        print most found
    }')
if [ "${circle%% *}" -gt $largest_circle ]; then
    echo "a circle of more than $largest_circle source-and-header pairs: $circle"
    failed=1
fi

# (b) The longest chain that begins at a source. A header that includes itself by way of others ends it with a message.
chain=$(includes $(find kernels -name '*.[ch]') | awk '
    function walk(file,    i, length_below, best, n, below) {
        if (file in length_of) return length_of[file]
        if (file in open) { print "1000 " file " includes itself"; circular = 1; exit 1 }
        open[file] = 1
        best = 0
        n = split(list[file], below, " ")
        for (i = 1; i <= n; i++) {
            length_below = walk(below[i])
            if (length_below > best) { best = length_below; next_of[file] = below[i] }
        }
        delete open[file]
        return length_of[file] = best + 1
    }
    $2 ~ /^kernels\// { list[$1] = list[$1] " " $2 }
    END {
        if (circular) exit 0
        most = 0
        for (file in list) if (walk(file) > most) { most = length_of[file]; top = file }
        text = top
        for (file = top; file in next_of; file = next_of[file]) text = text " " next_of[file]
        print most, text
    }') || true
if [ "${chain%% *}" -gt "$longest_chain" ]; then
    echo "a chain of more than $longest_chain includes: $chain"
    failed=1
fi

# (c) What a folder must not reach, by any way.
upward=$(includes $(find kernels -name '*.[ch]') | awk '
    function folder(file) { return split(file, part, "/") == 3 ? part[2] : "" }
    function walk(from, file,    i, n, below) {
        if ((from, file) in seen) return
        seen[from, file] = 1
        if (index(forbidden[folder(from)], " " folder(file) " ") && folder(file) != "")
            print from, "reaches", file
        n = split(list[file], below, " ")
        for (i = 1; i <= n; i++) walk(from, below[i])
    }
    BEGIN {
        forbidden["raster"] = " tile fragment geometry sample "
        forbidden["fragment"] = " tile geometry "
        forbidden["geometry"] = " tile fragment "
        forbidden["sample"] = " tile fragment geometry raster "
    }
    $2 ~ /^kernels\// { list[$1] = list[$1] " " $2 }
    END { for (file in list) if (folder(file) in forbidden) walk(file, file) }')
if [ -n "$upward" ]; then
    echo "layers of kernels point down, but:"
    echo "$upward"
    failed=1
fi

echo "largest circle: ${circle%% *} of at most $largest_circle pairs; longest chain: ${chain%% *} of at most $longest_chain files"
exit $failed
