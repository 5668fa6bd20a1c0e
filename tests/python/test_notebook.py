# SPDX-License-Identifier: MIT
"""The cells of the notebook run, and give the texts and pictures that are stored with them."""

import ast
import base64
import contextlib
import io
import json
import os
import subprocess
from pathlib import Path

import pytest

from conftest import ENVIRONMENT

NOTEBOOK = Path(__file__).resolve().parents[2] / "python/examples/tour.ipynb"


def execute(source, names):
    """Runs a cell as Jupyter does: what it prints, and what its last line is."""
    tree = ast.parse(source)
    last = ast.Expression(tree.body.pop().value) if isinstance(tree.body[-1], ast.Expr) else None
    said = io.StringIO()
    with contextlib.redirect_stdout(said):
        exec(compile(tree, NOTEBOOK.name, "exec"), names)
        value = None if last is None else eval(compile(last, NOTEBOOK.name, "eval"), names)
    return said.getvalue(), value


def stored(cell):
    """The same, from the file: a text, and a picture's bytes with its other form."""
    said, shown = "", None
    for output in cell["outputs"]:
        if output["output_type"] == "stream":
            said += "".join(output["text"])
        else:
            shown = base64.b64decode(output["data"]["image/png"]), "".join(output["data"]["text/plain"])
    return said, shown


@pytest.mark.long
def test_cells_give_what_is_stored(tmp_path):
    cells = [cell for cell in json.loads(NOTEBOOK.read_text())["cells"] if cell["cell_type"] == "code"]
    names, pictures = {}, 0
    for number, cell in enumerate(cells):
        said, value = execute("".join(cell["source"]), names)
        wanted, shown = stored(cell)
        assert said == wanted and (value is None) == (shown is None), number
        if shown is None:
            continue
        assert repr(value) == shown[1]
        pictures += 1
        for name, data in (("now.png", value._repr_png_()), ("then.png", shown[0])):
            (tmp_path / name).write_bytes(data)
        told = subprocess.run([os.environ["RHW_PROGRAM"], "compare", "--json", tmp_path / "now.png", tmp_path / "then.png"],
                              capture_output=True, text=True, env=ENVIRONMENT).stdout
        # NumPy's sine differs from machine to machine in its last bit, and with it perhaps a pixel at an edge.
        assert max(channel["mean"] for channel in json.loads(told)["channels"]) < 1e-3, number
    assert pictures >= 6


def test_it_says_nothing_of_the_machine():
    text = NOTEBOOK.read_text()
    assert not [word for word in ("/home", "/work", "/tmp", "stderr", "Error") if word in text]
    with pytest.raises(KeyError):
        json.loads(text)["cells"][1]["metadata"]["execution"]
