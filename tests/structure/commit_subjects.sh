#!/bin/sh
# SPDX-License-Identifier: MIT
# The subject of a commit has at most 72 characters, more than one word and no period at its end. Commits up to the one
# named below are older than this check and stay as they are; merges have the subjects that git gives them.
# usage: commit_subjects.sh PROJECT_FOLDER
# The exit status is 77 where there is no history to look at.
set -eu
cd "$1"
newest_unchecked=1fd057e5163e9f9c3b999b1121ea766a987e5569

skip() { # REASON
    echo "commit subjects are not checked: $1"
    exit 77
}

command -v git >/dev/null 2>&1 || skip "there is no git here"
shallow=$(git rev-parse --is-shallow-repository 2>/dev/null) || skip "this is no git repository"
[ "$shallow" = false ] || skip "the history is shallow"
git cat-file -e "$newest_unchecked^{commit}" 2>/dev/null || skip "the history does not have $newest_unchecked"

# A character of UTF-8 is counted by its first byte: bytes 128 to 191 follow one.
commits=$(git log --no-merges --encoding=UTF-8 --format='%h %s' "$newest_unchecked..HEAD")
printf '%s\n' "$commits" | LC_ALL=C awk '
    NF > 0 {
        count++
        subject = $0
        sub(/^[^ ]* /, "", subject)
        characters = subject
        gsub(/[\200-\277]/, "", characters)
        reason = ""
        if (length(characters) > 72) { reason = "has " length(characters) " characters, more than 72" }
        else if (subject ~ /[.]$/) { reason = "ends with a period" }
        else if (subject !~ / /) { reason = "says nothing in one word" }
        if (reason) {
            print "the subject of commit " $1 " " reason ": " subject
            failed++
        }
    }
    END {
        print count - failed " passed, " failed + 0 " failed"
        exit failed > 0
    }'
