# SPDX-License-Identifier: MIT
"""What the tests share: models small enough to write down, and the program to compare with."""

import os
import signal
import subprocess

import numpy as np
import pytest

import rhw

MODELS = "/usr/share/assimp/models"


# A shell's background jobs ignore Ctrl-C, and what they start does too.
signal.signal(signal.SIGINT, signal.default_int_handler)

#: For programs that tests start: a sanitizer that was loaded before Python is not theirs.
ENVIRONMENT = {key: value for key, value in os.environ.items() if key != "LD_PRELOAD"}
SANITIZED = "LD_PRELOAD" in os.environ


@pytest.fixture
def program(tmp_path):
    """Runs `rhw render MODEL -o NAME ...` and gives the bytes of the file."""
    def run(model, name, *options):
        out = tmp_path / ("program." + name)
        subprocess.run([os.environ["RHW_PROGRAM"], "render", str(model), "-o", str(out), "--quiet", *options],
                       check=True, env=ENVIRONMENT)
        return out.read_bytes()
    return run


def model_file(name):
    path = f"{MODELS}/{name}"
    if not os.path.exists(path):
        pytest.skip(f"{path} is not here: Debian's assimp-testmodels")
    return path


@pytest.fixture
def square():
    """Two triangles in the plane z = 0, from 0, 0 to 1, 1."""
    vertices = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], np.float32)
    return vertices, np.array([[0, 1, 2], [0, 2, 3]])


def write_boxes(folder):
    """A file with two boxes of different colours, one of them turned."""
    corners = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
    sides = [(1, 3, 4, 2), (5, 6, 8, 7), (1, 2, 6, 5), (3, 7, 8, 4), (1, 5, 7, 3), (2, 4, 8, 6)]
    lines = ["mtllib boxes.mtl"]
    for box, shift in enumerate((0.0, 1.7)):
        lines += [f"o box{box}", f"usemtl m{box}"]
        lines += [f"v {x + shift} {y + 0.2 * shift * x} {z}" for x, y, z in corners]
        lines += ["f " + " ".join(str(8 * box + i) for i in side) for side in sides]
    (folder / "boxes.mtl").write_text("newmtl m0\nKd 0.8 0.2 0.1\nnewmtl m1\nKd 0.1 0.3 0.9\n")
    (folder / "boxes.obj").write_text("\n".join(lines) + "\n")
    return folder / "boxes.obj"


@pytest.fixture
def box_obj(tmp_path):
    return write_boxes(tmp_path)


@pytest.fixture(scope="session")
def boxes(tmp_path_factory):
    """The same, for all tests: to be read."""
    return write_boxes(tmp_path_factory.mktemp("boxes"))


@pytest.fixture(params=[1, 3])
def context(request):
    return rhw.Context(threads=request.param)
