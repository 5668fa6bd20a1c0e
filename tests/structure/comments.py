#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Finds comments of include/, src/, shader/, vulkan/, glsl/ and scene/ that lean on their neighbour, and lines that are
too wide, these also in system/, tools/ and python/src.

A comment is read where it stands, without the one above it, so none begins with a word that points there: "Does so …",
"The same …", "Those …", "Likewise …", "And …". Lines have at most 120 columns; clang-format holds code to 110.
usage: comments.py ROOT [FOLDER...]; a folder that is named is read for both. --count tells the number of complaints for
each folder instead of each complaint.
"""
import re
import sys
from collections import Counter
from pathlib import Path

WIDTH = 120
SOURCES = ("include", "src", "shader", "vulkan", "glsl", "scene")
WIDTH_ALONE = ("system", "tools", "python/src")

# Words with which a comment leans on its neighbour, or on the line that it stands behind.
LEANING = re.compile(
    r"""(?: (?:Does|Do|Is|Has|Are)\ so\b
          | The\ same\b | the\ same\b
          | Likewise\b | Ditto\b | As\ (?:above|before|there)\b
          | Those\b | These\ (?:of|that|which|for)\b | Such\b
          | (?:And|But|Or|So|Also|Then|Else|Hence|Thus)\b(?!-)
          | (?:Of|Which|Whose|That)\b
          )""",
    re.VERBOSE | re.IGNORECASE,
)
# Words that look like them, and stand alone: "Which file does what", "So many triangles fill a tile".
STANDING = re.compile(
    r"""(?: Which\ | Of\ (?:equal|several|two|\d|a|an|the|every|each|all)\b.*[,:]
          | So\ (?:far|many|few|much)\b
          | Those\ who\b
          )""",
    re.VERBOSE,
)


def comment_at(line):
    """The column where a comment of `line` begins, outside of strings; -1 if there is none."""
    quote = ""
    i = 0
    while i < len(line):
        c = line[i]
        if quote:
            if c == "\\":
                i += 1
            elif c == quote:
                quote = ""
        elif c in "\"'":
            quote = c
        elif line.startswith("//", i):
            return i
        i += 1
    return -1


def complaints(path, width_alone):
    """Yields the number of a line of a file, and what is wrong with it."""
    above = -1  # the column of a comment that the line above has alone or behind its code
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        if len(line) > WIDTH:
            yield number, f"{len(line)} columns; at most {WIDTH}"
        at = comment_at(line)
        goes_on = at >= 0 and at == above and not line[:at].strip()
        if at >= 0 and not goes_on and not width_alone:
            text = line[at:].lstrip("/<! ")
            if LEANING.match(text) and not STANDING.match(text):
                yield number, f'the comment leans on its neighbour: "{text[:60]}"'
        above = -1 if "SPDX-License-Identifier" in line else at


def main(arguments):
    counts = "--count" in arguments
    root, *folders = [a for a in arguments if a != "--count"] or ["."]
    root = Path(root)
    found = Counter()
    for folder in folders or SOURCES + WIDTH_ALONE:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix not in (".c", ".h"):
                continue
            for number, what in complaints(path, width_alone=not folders and folder in WIDTH_ALONE):
                found[str(path.parent.relative_to(root))] += 1
                if not counts:
                    print(f"{path.relative_to(root)}:{number}: {what}")
    if counts:
        for folder, n in sorted(found.items()):
            print(f"{n:4} {folder}")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
