# SPDX-License-Identifier: MIT
"""What the tests of rhw.dataset share: how it is run, what a folder holds, and PNGs as numbers."""

import hashlib
import json
import os
import struct
import subprocess
import sys
import time
import zlib
from pathlib import Path

import numpy as np
import pytest

from conftest import SANITIZED
from rhw.dataset.main import main

COMMAND = [sys.executable, "-B", "-m", "rhw.dataset"]


def command(*arguments):
    # A sanitizer does not bear that a model is read, by a fork, while another thread draws.
    alone = ["--threads", "1"] if SANITIZED and "-j" not in arguments and "--verify" not in arguments else []
    return [*COMMAND, *map(str, arguments), *alone]


def run(*arguments, status=0):
    """Runs it as a program; what it said on stderr."""
    done = subprocess.run(command(*arguments), capture_output=True, text=True)
    assert done.returncode == status, done.stderr
    return done.stderr


def say(capsys, *arguments):
    """Runs it here: the exit status and what was said."""
    with pytest.raises(SystemExit) as ended:
        main([str(each) for each in arguments])
    return ended.value.code, capsys.readouterr().err


def start(*arguments):
    return subprocess.Popen(command(*arguments), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def manifest(folder):
    return json.loads((Path(folder) / "manifest.json").read_text())


def files(folder):
    """Names and hashes of everything there is."""
    return {str(path.relative_to(folder)): hashlib.sha256(path.read_bytes()).hexdigest()
            for path in sorted(Path(folder).rglob("*")) if path.is_file()}


def finished(folder):
    """Those but for what killed processes had begun to write, which is kept for an hour."""
    return {name: sha for name, sha in files(folder).items() if not Path(name).name.startswith(".rhw-")}


def marks(folder):
    """What changes when a file is written again."""
    return {str(path.relative_to(folder)): (path.stat().st_ino, path.stat().st_mtime_ns)
            for path in Path(folder).rglob("*") if path.is_file()}


def records(folder):
    """Those of the views that are finished."""
    return list(Path(folder).glob(".rhw/*/[0-9]*.json"))


def wait_for(condition, what, seconds=60):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, f"{what} did not happen"
        time.sleep(0.002)


def held(folder, asked, first):
    """Begins a data set whose pictures from one on are not there until `let_go`: who comes to one waits, however long."""
    run(*asked, "--out", folder, "--shard", "1/40")
    for view in range(first, 40):
        os.mkfifo(folder / f"boxes/{view:04}.png")


def let_go(folder):
    for path in (folder / "boxes").iterdir():
        if path.is_fifo():
            end = os.open(path, os.O_RDWR)
            path.unlink()
            os.close(end)


def read_png(path):
    """A PNG's numbers, by its specification: (rows, columns, channels)."""
    data, place, packed = Path(path).read_bytes(), 8, b""
    while place < len(data):
        size, kind = struct.unpack_from(">I4s", data, place)
        body = data[place + 8:place + 8 + size]
        if kind == b"IHDR":
            width, height, bits, color = struct.unpack_from(">IIBB", body)
        packed += body if kind == b"IDAT" else b""
        place += 12 + size
    channels = {0: 1, 2: 3, 4: 2, 6: 4}[color]
    step, row_bytes = channels * bits // 8, width * channels * bits // 8
    lines = np.frombuffer(zlib.decompress(packed), np.uint8).reshape(height, 1 + row_bytes)
    rows, above = [], [0] * row_bytes
    for line in lines.tolist():
        above = _unfiltered(line[0], line[1:], above, step)
        rows.append(above)
    kind = np.dtype(">u2" if bits == 16 else np.uint8)
    return np.array(rows, np.uint8).view(kind).reshape(height, width, channels)


def _unfiltered(kind, line, above, step):
    for i in range(len(line)):
        left, corner = (line[i - step], above[i - step]) if i >= step else (0, 0)
        guess = left + above[i] - corner
        nearest = min((abs(guess - left), 0, left), (abs(guess - above[i]), 1, above[i]), (abs(guess - corner), 2, corner))
        line[i] = line[i] + (0, left, above[i], (left + above[i]) // 2, nearest[2])[kind] & 255
    return line
