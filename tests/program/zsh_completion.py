#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What zsh offers for the last word of each line, of a terminal of its own: a line of words, and of what went wrong.

usage: zsh_completion.py FOLDER LINE...    the folder has _rhw; each line must have something to offer
"""
import os
import pty
import select
import sys
import tempfile
import time

PATIENCE = 30  # seconds
LIST = b"\x14"  # Ctrl-T
CLEAR = b"\x15"  # Ctrl-U
BEGIN = """unsetopt prompt_sp prompt_cr; unset zle_bracketed_paste; PROMPT='> ' LISTMAX=10000; stty cols 200 rows 200
fpath=({folder} $fpath); autoload -Uz compinit; compinit -u -D; zstyle ':completion:*' verbose no
bindkey -e; bindkey "^T" list-choices; echo begins
"""


def read(terminal, end):
    """What comes until its end, without that."""
    said, until = b"", time.monotonic() + PATIENCE
    while not said.endswith(end):
        if not select.select([terminal], [], [], until - time.monotonic())[0]:
            sys.exit(f"zsh said {said!r}, which does not end in {end!r}")
        said += os.read(terminal, 65536)
    return said[:-len(end)]


def main():
    folder, *lines = sys.argv[1:]
    process, terminal = pty.fork()
    if process == 0:
        os.environ["TERM"] = "dumb"
        os.execvp("zsh", ["zsh", "-f", "-i"])
    with tempfile.NamedTemporaryFile("w") as file:
        file.write(BEGIN.format(folder=folder))
        file.flush()
        os.write(terminal, f"source {file.name}\n".encode())
        read(terminal, b"begins\r\n> ")
    for line in map(str.encode, lines):
        os.write(terminal, line)
        read(terminal, line)
        os.write(terminal, LIST)
        print(*sorted(read(terminal, b"> " + line).decode().split()))
        os.write(terminal, CLEAR)
    os.close(terminal)
    os.waitpid(process, 0)


if __name__ == "__main__":
    main()
