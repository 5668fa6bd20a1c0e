#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What a page says that commands print is what they print: each ```sh block with a ```text block right behind it. A
```glsl block is the file that the line before it links to. The last numbers of a page that has `pixel X, Y is R, G, B` are
those of the picture that its last command writes.

usage: quoted_output.py PROGRAM SOURCE_ROOT PAGE [--update]; --update writes what is printed into the page
"""
import re
import struct
import subprocess
import sys
import tempfile
import zlib
from pathlib import Path

QUOTE = re.compile(r"```sh\n(.*?)```\n\n```text\n(.*?)```\n", re.S)
TEXT = re.compile(r"\[[^]]*\]\(([^)]*\.(?:vert|frag|comp))\)[^\n]*\n\n```glsl\n(.*?)```\n", re.S)
PIXEL = re.compile(r"pixel (\d+), (\d+) is (\d+), (\d+), (\d+)")


def run(command, program, root, folder):
    """What a command prints in the root of the sources, without spaces at the ends of lines; -o writes into `folder`."""
    command = re.sub(r"\bbuild/rhw\b", program, command)
    command = re.sub(r" -o (\S+)", lambda match: f" -o {folder}/{match.group(1)}", command)
    printed = subprocess.run(command, shell=True, cwd=root, check=True, stdout=subprocess.PIPE, encoding="utf-8").stdout
    return re.sub(r"[ \t]+$", "", printed, flags=re.M)


def paeth(a, b, c):
    nearest = min((abs(b - c), 0, a), (abs(a - c), 1, b), (abs(a + b - 2 * c), 2, c))
    return nearest[2]


def read_pixel(path, x, y):
    """Red, green and blue of a PNG with 8 bits a channel that is not interlaced."""
    data, at, packed = path.read_bytes(), 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, bits, color = struct.unpack(">I4xBB", body[:10])
        packed += body if kind == b"IDAT" else b""
        at += length + 12
    assert bits == 8 and color in (2, 6)
    size = {2: 3, 6: 4}[color]
    lines, above = zlib.decompress(packed), bytearray(width * size)
    for row in range(y + 1):
        line = bytearray(lines[row * (width * size + 1):(row + 1) * (width * size + 1)])
        kind, line = line[0], line[1:]
        for i, value in enumerate(line):
            left, corner = (line[i - size], above[i - size]) if i >= size else (0, 0)
            predicted = (0, left, above[i], (left + above[i]) // 2, paeth(left, above[i], corner))[kind]
            line[i] = (value + predicted) & 255
        above = line
    return tuple(above[x * size:x * size + 3])


def knows_glsl(program, root):
    asked = subprocess.run([program, "shader", "examples/disc.frag"], cwd=root, capture_output=True, encoding="utf-8")
    return "built without glslang" not in asked.stderr


def main(program, root, page, update=False):
    page = Path(page)
    if not knows_glsl(program, root):
        print("the program was built without glslang", file=sys.stderr)
        return 77
    text = page.read_text(encoding="utf-8")
    wrong = []
    with tempfile.TemporaryDirectory() as folder:
        def compare(match):
            printed = run(match.group(1), program, root, folder)
            if printed != match.group(2):
                wrong.append(f"{match.group(1).strip()} prints\n{printed}")
            return f"```sh\n{match.group(1)}```\n\n```text\n{printed}```\n"
        new = QUOTE.sub(compare, text)
        quotes = len(QUOTE.findall(text))
        for path, quoted in TEXT.findall(text):
            quotes += 1
            if (page.parent / path).read_text(encoding="utf-8") != quoted:
                wrong.append(f"{path} has other lines")
        for x, y, *told in PIXEL.findall(text):
            quotes += 1
            run(re.findall(r"```sh\n(.*?)```", text, re.S)[-1], program, root, folder)
            drawn = read_pixel(next(Path(folder).glob("*.png")), int(x), int(y))
            if drawn != tuple(map(int, told)):
                wrong.append(f"pixel {x}, {y} is {drawn}")
    if update:
        page.write_text(new, encoding="utf-8")
    for line in wrong:
        print(f"{page}: {line}", file=sys.stderr)
    print(f"{quotes - len(wrong)} passed, {len(wrong)} failed")
    return 1 if wrong or quotes == 0 else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:4], update="--update" in sys.argv))
