#!/bin/sh
# SPDX-License-Identifier: MIT
# The npm package knows the options of rhw render, and its types and exports agree with its code. No WebAssembly and no
# node is needed for that; script/web-test runs the package.
. "$(dirname "$0")/harness.sh"
words=$root/web/npm/words.js
types=$root/web/npm/index.d.ts

# Options that are none there: of files, pictures in a row and what is measured; a process of its own; a panorama's file; and
# fragment-shader, which is no word: SPIR-V comes as bytes.
left_out="out literal output bits format quality print-camera views animate turntable isa paths stats quiet max-memory max-time
    confine environment environment-rotation fragment-shader fragment-shader-template help"

succeed render --help
options=$(grep -oE '^  (-.,|   ) --[a-z-]+' "$folder/log/out" | grep -oE -- '[a-z][a-z-]+$')
check "render has options" test -n "$options"
for option in $options; do
    known=0
    grep -Eq "'$option'|[\`-]--?$option[=\`]" "$words" "$root/web/npm/index.js" && known=1
    wanted=1
    case " $(echo $left_out) " in *" $option "*) wanted=0 ;; esac
    check "the package has --$option" test $known = $wanted
done
for option in $left_out; do
    check "--$option is an option" sh -c "echo '$options' | grep -qx -- '$option'"
done

# The names of the tables `reading` and `drawing`, and those that are no words.
names=$(sed -n '/^const reading/,/^};/p; /^const drawing/,/^};/p' "$words" | sed -n 's/^    \([a-zA-Z]*\)[:,].*/\1/p')
names="$names $(sed -n "s/^const others = //p" "$words" | grep -oE "'[a-zA-Z]+'" | tr -d "'")"
check "there are names" test "$(echo $names | wc -w)" -ge 30
for name in $names; do
    check "the types have $name" grep -Eq "^ +$name\?: |[{&] $name\?: |\{ $name\?:" "$types"
done
typed=$(sed -n '/^export interface LoadOptions/,/^}/p; /^export interface RenderOptions/,/^}/p' "$types" |
    sed -n 's/^    \([a-zA-Z]*\)?: .*/\1/p')
for name in $typed; do
    check "the code has $name" sh -c "echo ' $(echo $names) ' | grep -q ' $name '"
done

# The types of the outputs, of which the package gives all but `display`.
rows=$(awk -F'"' '/\.name = /{ name = $2 }
    /\.format = /{ sub(/.*RHW_FORMAT_/, ""); sub(/,.*/, ""); print name ":" \
        ($0 ~ /_UINT/ ? "Numbers32" : $0 ~ /FLOAT/ ? "Floats32" : "Color8") }' \
    "$root/scene/draw/output_table.c" | grep -v '^display:' | sort)
typed=$(sed -n '/^export interface Outputs/,/^}/s/^    \([a-z]*\): \([A-Za-z0-9]*\)\( | Floats64\)\{0,1\};/\1:\2/p' "$types" | sort)
check "the types have the outputs of the table" test -n "$rows" -a "$rows" = "$typed"

exported=$(sed -n 's/^export \(async function\|class\|{\) \([A-Za-z]*\).*/\2/p' "$root/web/npm/index.js" | sort)
declared=$(sed -n 's/^export \(function\|class\) \([A-Za-z]*\).*/\2/p' "$types" | sort -u)
check "exports: $(echo $exported), not $(echo $declared)" test "$exported" = "$declared"

succeed --version
version=$(sed 's/rhw //' "$folder/log/out")
check "the package has version $version" grep -q "\"version\": \"$version\"" "$root/web/npm/package.json"
finish
