# SPDX-License-Identifier: MIT
"""The wheel carries what it needs: it runs without the checkout, and asks the system for libc and libstdc++ alone."""

import os
import re
import subprocess
import sys
import zipfile

import pytest

pytestmark = pytest.mark.wheel

PACKAGE = os.path.join(os.path.dirname(__file__), "../../python")
SYSTEM = re.compile(r"(ld-linux[^/]*|libc|libm|libdl|librt|libpthread|libstdc\+\+|libgcc_s)\.so\.\d+")


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    pytest.importorskip("pip")
    folder = tmp_path_factory.mktemp("wheel")
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "-q"]
    subprocess.run(pip + ["wheel", "--no-build-isolation", "--no-deps", "--no-index", "-w", folder / "out", PACKAGE],
                   check=True)
    wheel, = (folder / "out").iterdir()
    subprocess.run(pip + ["install", "--no-deps", "--no-index", "--target", folder / "site", wheel], check=True)
    return wheel, folder / "site"


def test_name(installed):
    assert re.fullmatch(r"rhw-[\d.]+-cp39-abi3-manylinux_\d+_\d+_\w+\.whl", installed[0].name)


def test_contents(installed):
    names = zipfile.ZipFile(installed[0]).namelist()
    assert {"rhw/__init__.py", "rhw/py.typed", "rhw/_rhw.pyi", "rhw/_rhw.abi3.so"} <= set(names)
    assert not [name for name in names if name.endswith((".c", ".h", ".o"))]


def test_needs_only_what_it_carries(installed):
    carried = {name for name in os.listdir(installed[1] / "rhw/lib")}
    files = [installed[1] / "rhw/_rhw.abi3.so"] + [installed[1] / "rhw/lib" / name for name in carried if ".so" in name
                                                   and not name.endswith(".copyright")]
    for file in files:
        dynamic = subprocess.run(["readelf", "-d", file], check=True, capture_output=True, text=True).stdout
        needed = re.findall(r"NEEDED.*\[(.*)\]", dynamic)
        assert needed, file
        assert [name for name in needed if not SYSTEM.fullmatch(name) and name not in carried] == [], file


def test_keeps_to_the_limited_api(installed):
    """Of CPython's private names it asks for those alone that macros of the limited API stand for."""
    symbols = subprocess.run(["nm", "-D", "--undefined-only", installed[1] / "rhw/_rhw.abi3.so"], check=True,
                             capture_output=True, text=True).stdout
    private = set(re.findall(r"\b_Py\w+", symbols))
    assert private <= {"_Py_NoneStruct", "_Py_TrueStruct", "_Py_FalseStruct", "_Py_Dealloc", "_PyObject_New", "_Py_BuildValue_SizeT",
                       "_PyArg_ParseTuple_SizeT", "_PyArg_ParseTupleAndKeywords_SizeT"}
    assert "PyErr_SetString" in symbols and "PyObject_GetBuffer" not in symbols  # of 3.11


def test_runs_without_the_checkout(installed, tmp_path):
    program = """
import rhw, numpy as np
model = rhw.Model(np.eye(3), np.array([[0, 1, 2]]))
model.render(60).save("x.png")
loaded = {line.split()[-1] for line in open("/proc/self/maps") if ".so" in line}
print(rhw.__file__, *sorted(name for name in loaded if "assimp" in name or "spng" in name or "OpenEXR" in name))
"""
    environment = {key: value for key, value in os.environ.items() if not key.startswith(("PYTHON", "RHW"))}
    environment["PYTHONPATH"] = str(installed[1])
    said = subprocess.run([sys.executable, "-c", program], check=True, capture_output=True, text=True, cwd=tmp_path,
                          env=environment).stdout.split()
    assert len(said) == 4 and all(name.startswith(str(installed[1])) for name in said), said
    assert (tmp_path / "x.png").read_bytes().startswith(b"\x89PNG")
