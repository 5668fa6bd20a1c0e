# SPDX-License-Identifier: MIT
"""The examples draw the pictures that stand beside them, and the commands of the documents work."""

import importlib.machinery
import importlib.util
import json
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from conftest import ENVIRONMENT, SANITIZED, model_file
from rhw import _rhw

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = sorted((ROOT / "python/examples").glob("*.py"))

#: Hundreds of steps of torch. 05_triangle shows in a second that such examples run.
LONG = ("06_cube", "07_earth", "08_pose")


def check_curve(name, printed):
    """What docs/images/losses.svg shows of an example, if anything, is what that prints."""
    loader = importlib.machinery.SourceFileLoader("losses", str(ROOT / "script/losses"))
    losses = importlib.util.module_from_spec(importlib.util.spec_from_loader("losses", loader))
    loader.exec_module(losses)
    shown = re.search(rf'<polyline id="{name}" points="(.*?)"', (ROOT / "docs/images/losses.svg").read_text())
    assert bool(shown) == (name in losses.COLORS) == ("loss" in printed)
    if shown:
        there = np.array([point.split(",") for point in shown[1].split()], float)
        # A last bit that differs may be a few percent after hundreds of steps.
        assert there.shape == np.shape(losses.curve(printed)) and np.abs(there - losses.curve(printed)).max() < 12


@pytest.mark.parametrize("example", [pytest.param(path, id=path.stem, marks=[pytest.mark.long] * (path.stem in LONG))
                                     for path in EXAMPLES])
def test_example(example, tmp_path):
    model = [model_file("glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb")] if "MODEL" in example.read_text() else []
    if "rhw.torch" in example.read_text():
        if SANITIZED:
            pytest.skip("torch is not made for a sanitizer that is loaded before it")
        pytest.importorskip("torch", reason="torch is not here: script/bootstrap learn")
    if "Program(" in example.read_text() and not _rhw.compiles:
        pytest.skip("this build has no glslang: Debian's glslang-dev")
    out = tmp_path / "out.png"
    # Torch's threads wait for each other busily: with other tests beside them, longer than they work.
    alone = {**os.environ, "OMP_NUM_THREADS": "1"}
    printed = subprocess.run([sys.executable, "-B", example, *model, out], check=True, stdout=subprocess.PIPE, text=True,
                             env=alone).stdout
    check_curve(example.stem, printed)
    told = subprocess.run([os.environ["RHW_PROGRAM"], "compare", "--json", out, example.with_suffix(".png")],
                          capture_output=True, text=True, env=ENVIRONMENT).stdout
    # NumPy's sine differs from machine to machine in its last bit, and with it perhaps a pixel at an edge.
    assert max(channel["mean"] for channel in json.loads(told)["channels"]) < 1e-3


def test_examples_are_there():
    assert len(EXAMPLES) >= 9 and set(LONG) < {path.stem for path in EXAMPLES}


def test_recipes_of_the_documents(tmp_path, monkeypatch, box_obj):
    """Every block of Python in docs/python.md up to its recipes runs, one after the other, on a model called chair.glb."""
    monkeypatch.chdir(tmp_path)
    model = model_file("glTF2/BoxTextured-glTF-Binary/BoxTextured.glb")
    (tmp_path / "chair.glb").write_bytes(Path(model).read_bytes())
    text = (ROOT / "docs/python.md").read_text().split("## Recipes")[0]
    blocks = re.findall(r"```python\n(.*?)```", text, re.S)
    assert len(blocks) >= 6
    names = {}
    for block in blocks:
        if "Program(" not in block or _rhw.compiles:
            exec(compile(block, "docs/python.md", "exec"), names)
    assert (tmp_path / "chair.png").exists()
    assert (tmp_path / "julia.png").exists() == bool(_rhw.compiles)


def test_readme(tmp_path, monkeypatch, capsys):
    """What it shows of Python runs as it stands, in a checkout: here in what may be written to beside it."""
    (tmp_path / "tests").symlink_to(ROOT / "tests")
    monkeypatch.chdir(tmp_path)
    block, = re.findall(r"```python\n(.*?)```", (ROOT / "README.md").read_text(), re.S)
    names = {}
    exec(compile(block, "README.md", "exec"), names)
    assert capsys.readouterr().out.startswith("(480, 640) 0.") and set(names["pictures"]) == {"color", "depth", "object"}
    assert names["pictures"]["object"].any()
    for name in ("cube.png", "mesh.png"):
        assert (tmp_path / name).read_bytes().startswith(b"\x89PNG")


def test_recipes_of_learning():
    """Every block of docs/learning.md; the two of them draw the same picture."""
    text = (ROOT / "docs/learning.md").read_text()
    blocks = re.findall(r"```python\n(.*?)```", text, re.S)
    assert len(blocks) == 2
    arrays, tensors = {}, {}
    exec(compile(blocks[1], "docs/learning.md", "exec"), arrays)
    assert arrays["to_pos"].any()
    if SANITIZED:
        pytest.skip("torch is not made for a sanitizer that is loaded before it")
    pytest.importorskip("torch", reason="torch is not here: script/bootstrap learn")
    exec(compile(blocks[0], "docs/learning.md", "exec"), tensors)
    assert np.array_equal(tensors["image"].detach().numpy(), arrays["image"])
    assert np.allclose(tensors["pos"].grad.numpy(), arrays["to_pos"], rtol=1e-5, atol=1e-7)
