#!/bin/sh
# SPDX-License-Identifier: MIT
# The man page and the shells' completions know exactly the options that the program knows; links in documents lead to
# files.
. "$(dirname "$0")/harness.sh"
man=$root/docs/rhw.1
completion=$root/tools/rhw/completion/rhw.bash

bash_says() { # WORD...: how bash completes the last one
    bash -c '. "$0"; COMP_WORDS=(rhw "$@"); COMP_CWORD=$#; _rhw; printf "%s\n" "${COMPREPLY[@]}"' "$completion" "$@" |
        sed 's/=$//' | sort | tr '\n' ' '
}

for verb in render thumbs compare explain view info shader bench; do
    succeed $verb --help
    options=$(grep -oE '^  (-.,|   ) --[a-z-]+' "$folder/log/out" | grep -oE -- '--[a-z-]+')
    check "$verb has options" test -n "$options"
    for option in $options; do
        escaped=$(echo "$option" | sed 's/-/\\\\-/g')
        check "man page: $verb $option" grep -Eq -- "^\.B[RI]* (.* )?$escaped([^a-z\\]|\$)" "$man"
    done
    completed=$(bash_says $verb --)
    case $verb in
    explain | view) # they have options of rhw render too
        for option in $options --size --samples --camera --orbit --environment --time --max-texture; do
            check "completion of $verb: $option" test "${completed#*"$option "}" != "$completed"
        done
        at=--at=0,0
        [ $verb = explain ] || at=
        for option in $completed; do
            run $verb none.obj $at "$option="
            check "$verb knows $option" sh -c "! grep -Eq -e '$option: (no such|cannot)' '$folder/log/err'"
        done
        ;;
    *) check "completion of $verb" test "$completed" = "$(echo "$options" | sort | tr '\n' ' ')" ;;
    esac
done
verbs="render thumbs compare explain view info shader bench"
check "completion of verbs" test "$(bash_says '')" = "$(printf '%s\n' $verbs help --help --version | sort | tr '\n' ' ')"
check "completion of help" test "$(bash_says help '')" = "$(printf '%s\n' $verbs | sort | tr '\n' ' ')"
check "completion of a beginning" test "$(bash_says he)$(bash_says explain --si)$(bash_says view --full)" = "help --size --fullscreen "
check "completion of a value" test "$(bash_says explain --samples 1)" = "1 16 "
check "completion behind =" test "$(bash_says explain --samples = 1)$(bash_says view --fit =)$(bash_says render --bits =)" = "1 16 all 16 8 "
check "completion within a list" test "$(bash_says render --output depth,n)" = "depth,normal "
mkdir made
check "completions are made" "$root/script/completions" "$rhw" made
for file in rhw.bash _rhw rhw.fish; do
    check "script/completions was run after the last change: $file" cmp "made/$file" "$root/tools/rhw/completion/$file"
done
rm -r made
if command -v zsh >/dev/null 2>&1; then
    : >model.glb
    PATH=$(dirname "$rhw"):$PATH "$root/tests/program/zsh_completion.py" "$root/tools/rhw/completion" 'rhw ' 'rhw help ' \
        'rhw info --' 'rhw explain --siz' 'rhw explain --wireframe=' 'rhw view --samples ' 'rhw view mod' 'rhw view --full' \
        'rhw render --stats=mod' 'rhw render --output=depth,n' 'rhw render --output depth,n' 'rhw bench --scene fill_c' >said 2>&1
    cat >want <<'SAID'
--help --version bench compare explain help info render shader thumbs view
bench compare explain info render shader thumbs view
--help --json
--size
over plain
1 16 2 4 8
model.glb
--fullscreen
model.glb
normal
normal
fill_color
SAID
    check "zsh completes: $(diff said want)" cmp said want
    rm model.glb said want
else
    echo "no zsh here: how it completes is not tested" >&2
fi
if command -v fish >/dev/null 2>&1; then
    export HOME="$folder/work"
    fish_says() { # WORDS: how fish completes them, a line each
        fish --no-config -c "source $root/tools/rhw/completion/rhw.fish; complete -C '$1'" 2>&1 | cut -f 1 | tr '\n' ' '
    }
    check "fish: verbs" test "$(fish_says 'rhw ')" = "bench compare explain help info render shader thumbs view "
    check "fish: options" test "$(fish_says 'rhw info --')" = "--help --json "
    check "fish: options of render" test "$(fish_says 'rhw explain --siz')" = "--size "
    check "fish: a verb's name elsewhere" test "$(fish_says 'rhw info view --')" = "--help --json "
    : >model.glb
    check "fish: values" test "$(fish_says 'rhw view --samples ')$(fish_says 'rhw explain --fit=')" = "1 2 4 8 16 --fit=all "
    check "fish: files" test "$(fish_says 'rhw explain mod')$(fish_says 'rhw render --stats=mod')" = "model.glb --stats=model.glb "
    rm model.glb
    check "fish: verbs of help" test "$(fish_says 'rhw help ')" = "bench compare explain info render shader thumbs view "
    check "fish: within a list" test "$(fish_says 'rhw render --output depth,n')" = "depth,normal "
else
    echo "no fish here: how it completes is not tested" >&2
fi
succeed --version
version=$(sed 's/rhw //' "$folder/log/out")
for man in "$root/docs/rhw.1" "$root/docs/rhw.3"; do
    check "$man: version" grep -q "\"rhw $version\"" "$man"
    if command -v groff >/dev/null 2>&1; then
        groff -man -Tutf8 -ww "$man" >/dev/null 2>"$folder/log/err"
        check "$man without warnings: $(cat "$folder/log/err")" test ! -s "$folder/log/err"
    fi
done
for word in $(grep -oE '\brhw_[a-z_0-9]+' "$root/docs/rhw.3" | sort -u); do
    check "rhw(3): $word is in a header" grep -qw -- "$word" "$root"/include/rhw/*.h "$root/src/rhw-shaders.cmake"
done
for header in $(grep -oE 'rhw/[a-z_]+\.h' "$root/docs/rhw.3" | sort -u); do
    check "rhw(3): $header is there" test -e "$root/include/$header"
done

# The README says in words what docs/exactness.md has measured: the row of `smooth` of all families. A cell is the median,
# the 99th percentile and the worst.
tr '\n' ' ' <"$root/README.md" | tr -s ' ' >words
awk -F ' *[|] *' '
    $2 == "all families" { found = 1 }
    found && $2 == "smooth" {
        sub(/ M$/, " million", $4)
        split($5, rhw, ", ")
        split($6, llvmpipe, ", ")
        split($7, softpipe, ", ")
        print "In " $4 " values with perspective"
        print "rhw is never off by more than " rhw[3] " units"
        print "half are within " rhw[1] " units and 99 of 100 within " rhw[2] "."
        print "half of llvmpipe" "\047" "s values are within " llvmpipe[1] " units"
        print "one of 100 is off by about " llvmpipe[2] " or more"
        print "of softpipe" "\047" "s, " softpipe[1] " and " softpipe[2] " "
        exit
    }' "$root/docs/exactness.md" >sentences
check "sentences of the exactness table" test "$(wc -l <sentences)" = 6
while read -r sentence; do
    check "README.md has what docs/exactness.md measured: $sentence" grep -qF -- "$sentence" words
done <sentences

# A link to a place in a file is a link to the file here.
cd "$root" || exit 1
for document in *.md docs/*.md examples/*.md; do
    for link in $({ grep -oE '\]\([^)# ]+' "$document" | cut -c 3-; grep -oE '(src|href)="[^"#]+' "$document" | sed 's/.*"//'; } |
        grep -v '^[a-z]*:' | sort -u); do
        check "link in $document" test -e "$(dirname "$document")/$link"
    done
done

# A link to a place in a page is one to a heading, as GitHub names them.
places() { # PAGE
    sed -n 's/^##* //p' "$1" | tr '[:upper:]' '[:lower:]' | sed 's/[^a-z0-9 _-]//g; s/ /-/g'
}
for document in *.md docs/*.md examples/*.md; do
    for link in $(grep -oE '\]\([^) :]*#[^) ]+' "$document" | cut -c 3- | grep -v '\.[ch]#' | sort -u); do
        page=${link%%#*}
        check "place of a link in $document: $link" sh -c 'grep -qxF -- "$1"' sh "${link#*#}" <<TEXT
$(places "${page:+$(dirname "$document")/}${page:-$document}")
TEXT
    done
done
check "links were found" test $checks -gt 150

finish
