# SPDX-License-Identifier: MIT
"""What mypy says of the package, and of a program that uses it. Bare np.ndarray is what NumPy before 2.2 calls incomplete."""
import os
import subprocess
import sys

import pytest

pytest.importorskip("mypy", reason="python3-mypy is not installed")
pytest.importorskip("torch")

PROGRAM = """
import numpy as np
import rhw
import rhw.torch as dr
import torch

model = rhw.load("chair.glb")
picture = model.render(256, samples=16, background="transparent")
picture.save("chair.png")
color: np.ndarray = picture["color"]
context = dr.RasterizeContext()
rast, slopes = dr.rasterize(context, torch.zeros(1, 3, 4), torch.zeros(1, 3, dtype=torch.int32), [64, 64])
smooth: torch.Tensor = dr.antialias(rast, rast, torch.zeros(1, 3, 4), torch.zeros(1, 3, dtype=torch.int32))
pixels, _ = rhw.diff.rasterize(np.zeros((1, 3, 4)), np.zeros((1, 3)), [64, 64])
"""


def check(folder, *what):
    package = os.path.dirname(os.path.dirname(__import__("rhw").__file__))
    order = [sys.executable, "-m", "mypy", "--strict", "--disable-error-code", "type-arg", "--cache-dir", str(folder / "cache")]
    done = subprocess.run([*order, *what], cwd=package, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def test_types(tmp_path):
    check(tmp_path, "-p", "rhw")
    program = tmp_path / "program.py"
    program.write_text(PROGRAM)
    check(tmp_path, str(program))
