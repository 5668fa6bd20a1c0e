#!/bin/sh
# SPDX-License-Identifier: MIT
# The man page and the shell completion know exactly the options that the program knows; links in documents lead to files.
. "$(dirname "$0")/harness.sh"
man=$root/docs/rhw.1
completion=$root/tools/rhw/completion/rhw.bash

for verb in render thumbs compare info bench; do
    succeed $verb --help
    options=$(grep -oE '^  (-.,|   ) --[a-z-]+' "$folder/log/out" | grep -oE -- '--[a-z-]+')
    check "$verb has options" test -n "$options"
    for option in $options; do
        escaped=$(echo "$option" | sed 's/-/\\\\-/g')
        check "man page: $verb $option" grep -Eq -- "^\.B[RI]* (.* )?$escaped([^a-z\\]|\$)" "$man"
    done
    completed=$(bash -c ". '$completion'; COMP_WORDS=(rhw $verb --); COMP_CWORD=2; _rhw; printf '%s\n' \"\${COMPREPLY[@]}\"" |
        sed 's/=$//' | sort | tr '\n' ' ')
    check "completion of $verb" test "$completed" = "$(echo "$options" | sort | tr '\n' ' ')"
done
verbs=$(bash -c ". '$completion'; COMP_WORDS=(rhw ''); COMP_CWORD=1; _rhw; printf '%s ' \"\${COMPREPLY[@]}\"")
check "completion of verbs" test "$verbs" = "render thumbs compare info bench --help --version "
outputs=$(bash -c ". '$completion'; COMP_WORDS=(rhw render --output depth,n); COMP_CWORD=3; _rhw; printf '%s ' \"\${COMPREPLY[@]}\"")
check "completion within a list" test "$outputs" = "depth,normal "
succeed --version
version=$(sed 's/rhw //' "$folder/log/out")
check "man page: version" grep -q "\"rhw $version\"" "$man"
if command -v groff >/dev/null 2>&1; then
    groff -man -Tutf8 -ww "$man" >/dev/null 2>"$folder/log/err"
    check "man page without warnings: $(cat "$folder/log/err")" test ! -s "$folder/log/err"
fi

# A link to a place in a file is a link to the file here.
cd "$root" || exit 1
for document in *.md docs/*.md examples/*.md; do
    for link in $(grep -oE '\]\([^)# ]+' "$document" | cut -c 3- | grep -v '^[a-z]*:' | sort -u); do
        check "link in $document" test -e "$(dirname "$document")/$link"
    done
done
check "links were found" test $checks -gt 150

finish
