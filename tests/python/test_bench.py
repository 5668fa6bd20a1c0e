# SPDX-License-Identifier: MIT
"""The scripts that time the package beside others: they run, and what they compare agrees."""

import os
import pathlib
import subprocess
import sys

import pytest

from conftest import SANITIZED

BENCH = pathlib.Path(__file__).resolve().parents[2] / "bench"
BUNNY = "/usr/share/glmark2/models/bunny.obj"

pytestmark = [pytest.mark.long, pytest.mark.skipif(SANITIZED, reason="peers are no subject of sanitizers")]


def told(script, *arguments, **environment):
    done = subprocess.run([sys.executable, "-B", str(BENCH / script), *arguments], check=True,
                          stdout=subprocess.PIPE, universal_newlines=True, env={**os.environ, **environment})
    return done.stdout.splitlines()


def without(folder, module):
    """A path on which a module cannot be imported."""
    (folder / f"{module}.py").write_text(f"raise ImportError('{module} is not wanted here')\n")
    return os.pathsep.join([str(folder), os.environ.get("PYTHONPATH", "")])


def test_pixel_by_pixel_draws_the_same():
    lines = told("diff_peers.py", "--size", "64", "--threads", "2")
    assert lines[0] == "16 x 64 x 64, 49928 triangles, 2 threads: rasterize and interpolate"
    rows = [line for line in lines if line.startswith("pixel by pixel")]
    assert len(rows) == 2 and "%" in rows[0] or "there is no C++ compiler" in rows[0]


def test_what_is_missing_is_told(tmp_path):
    lines = told("diff_peers.py", "--size", "64", CXX="no-such-compiler", PYTHONPATH=without(tmp_path, "torch"))
    assert lines[-3:] == ["pixel by pixel in C++: there is no C++ compiler; CXX names one",
                          "pixel by pixel in torch: Python has no torch", "PyTorch3D: Python has no pytorch3d"]


@pytest.mark.skipif(not os.path.exists(BUNNY), reason=f"{BUNNY} is not here: Debian's glmark2-data")
def test_views_of_the_bunny(tmp_path):
    lines = told("python_speed.py", "--rounds", "2", PYTHONPATH=without(tmp_path, "pyrender"))
    assert lines[0] == "pyrender is left out: pyrender is not wanted here"
    assert "69666 triangles, 640 x 480" in lines[1] and len(lines) == 8
