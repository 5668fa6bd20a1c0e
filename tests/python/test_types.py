# SPDX-License-Identifier: MIT
"""What mypy says of the package, its examples, and a program that uses it."""
import glob
import os
import subprocess
import sys

import pytest

pytest.importorskip("mypy", reason="python3-mypy is not installed")
pytest.importorskip("torch")

PROGRAM = """
import numpy as np
from numpy.typing import NDArray
from typing import Any
import rhw
import rhw.torch as dr
import torch

model = rhw.load("chair.glb")
picture = model.render(256, samples=16, background="transparent")
picture.save("chair.png")
color: NDArray[Any] = picture["color"]
context = dr.RasterizeContext()
rast, slopes = dr.rasterize(context, torch.zeros(1, 3, 4), torch.zeros(1, 3, dtype=torch.int32), [64, 64])
smooth: torch.Tensor = dr.antialias(rast, rast, torch.zeros(1, 3, 4), torch.zeros(1, 3, dtype=torch.int32))
program = rhw.pipeline.Program(vertex="void main() {}", constants={3: 0.5})
target = {"color": rhw.pipeline.Texture(64)}
with rhw.pipeline.Pass(target) as draw:
    draw(rhw.pipeline.Pipeline(target, program=program), {"position": np.zeros((3, 3))}, None, {"time": 1, (0, 1): target["color"]})
pixels, _ = rhw.diff.rasterize(np.zeros((1, 3, 4)), np.zeros((1, 3)), [64, 64])
"""


SOURCES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "python")


def check(folder, *what):
    package = os.path.dirname(os.path.dirname(__import__("rhw").__file__))
    order = [sys.executable, "-m", "mypy", "--cache-dir", str(folder / "cache")]
    done = subprocess.run([*order, *what], cwd=package, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def test_types(tmp_path):
    check(tmp_path, "--strict", "-p", "rhw")
    program = tmp_path / "program.py"
    program.write_text(PROGRAM)
    check(tmp_path, "--strict", str(program))


def test_examples(tmp_path):
    sources = [*glob.glob(os.path.join(SOURCES, "examples", "*.py")), os.path.join(SOURCES, "setup.py")]
    check(tmp_path, "--ignore-missing-imports", *sources)
