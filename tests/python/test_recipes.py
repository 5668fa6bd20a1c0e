# SPDX-License-Identifier: MIT
"""The ten recipes of docs/python.md and the commands of docs/dataset.md do what they say."""

import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import rhw
from conftest import SANITIZED, model_file
from dataset_runs import manifest, read_png
from test_model import Trimesh, sphere

DOCS = Path(__file__).resolve().parents[2] / "docs"
TITLES = re.findall(r"^### (\d+)\. (.*)$", (DOCS / "python.md").read_text(), re.M)


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """Where chair.glb is."""
    monkeypatch.chdir(tmp_path)
    model = model_file("glTF2/BoxTextured-glTF-Binary/BoxTextured.glb")
    (tmp_path / "chair.glb").write_bytes(Path(model).read_bytes())
    return tmp_path


def cook(number):
    """Runs a recipe by itself; its names."""
    section = re.search(rf"^### {number}\. .*?(?=^##|\Z)", (DOCS / "python.md").read_text(), re.M | re.S)[0]
    block, = re.findall(r"```python\n(.*?)```", section, re.S)
    names = {}
    exec(compile(block, f"recipe {number}", "exec"), names)
    return names


@pytest.fixture
def torch():
    if SANITIZED:
        pytest.skip("torch is not made for a sanitizer that is loaded before it")
    found = pytest.importorskip("torch", reason="torch is not here: script/bootstrap learn")
    found.set_num_threads(1)  # others wait for each other busily
    return found


def test_there_are_ten():
    assert [int(number) for number, _ in TITLES] == list(range(1, 11))


def test_a_thumbnail(folder):
    cook(1)
    texels = read_png(folder / "thumbnail.png")
    assert texels.shape == (256, 256, 4) and texels[0, 0, 3] == 0 and texels[128, 128, 3] == 255


def test_a_depth_map(folder):
    names = cook(2)
    written = read_png(folder / "depth.png")[:, :, 0]
    assert written.dtype.itemsize == 2 and np.array_equal(written > 0, names["seen"])
    assert np.abs(written[names["seen"]] / 1000 - names["distance"][names["seen"]]).max() < 1e-3


def test_masks(folder):
    names = cook(3)
    mask = read_png(folder / "mask.png")[:, :, 0]
    (left, top, right, bottom), = names["boxes"].values()
    rows, columns = np.nonzero(mask)
    assert (columns.min(), rows.min(), columns.max(), rows.max()) == (left, top, right - 1, bottom - 1) and right - left > 200


def test_many_views(folder):
    names = cook(4)
    assert len(names["poses"]) == 12 and all((folder / "views" / name).exists() for name in names["poses"])


def test_a_shape_from_silhouettes(torch):
    names = cook(5)
    assert torch.allclose(names["scale"], torch.tensor([0.6, 0.3, 0.45]), atol=0.02)
    assert torch.allclose(names["place"], torch.tensor([0.2, -0.1, 0.1]), atol=0.02)


def test_a_texture_from_pictures(folder, torch):
    losses = cook(6)["losses"]
    assert losses[-1] < 0.005 * losses[0]


def test_where_the_camera_was(folder, torch):
    names = cook(7)
    for found, truth in zip((names["turn"], names["place"]), names["truth"]):
        assert torch.allclose(found, truth, atol=0.02)


def test_a_test_of_a_picture(folder):
    """It passes, and fails for another model; then the picture is there."""
    (folder / "test_chair.py").write_text(re.search(r"```python\n(# test_chair.*?)```", (DOCS / "python.md").read_text(), re.S)[1])
    environment = {key: value for key, value in os.environ.items() if not key.startswith("PYTEST")}

    def status():
        return subprocess.run([sys.executable, "-B", "-m", "pytest", "-q", "-p", "no:cacheprovider", "test_chair.py"], env=environment,
                              stdout=subprocess.DEVNULL).returncode

    assert status() == 0
    (folder / "chair.glb").write_bytes(Path(model_file("glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb")).read_bytes())
    (folder / "chair_now.png").unlink()
    assert status() == 1 and (folder / "chair_now.png").exists()


def test_in_a_notebook(folder):
    names = cook(9)
    assert names["normals"].startswith(b"\x89PNG") and names["normals"] != names["pictures"]._repr_png_()
    assert names["model"]._repr_png_().startswith(b"\x89PNG")


def test_a_mesh_of_trimesh(monkeypatch):
    """Where Python has no trimesh, what looks like it stands in for it."""
    try:
        import trimesh  # noqa: F401
    except ImportError:
        class Creation:
            icosphere = staticmethod(lambda subdivisions: Trimesh(*sphere(4 * subdivisions, 4 * subdivisions)[:2]))

        module = type(sys)("trimesh")
        module.creation = Creation
        monkeypatch.setitem(sys.modules, "trimesh", module)
    names = cook(10)
    faces = len(names["mesh"].faces)
    assert 0.3 * faces < len(names["seen"]) < 0.6 * faces and names["seen"].max() < faces
    assert np.allclose(names["model"].materials[0].base_color, (0.1, 0.3, 0.8, 1))


# docs/dataset.md ------------------------------------------------------------------------------------


def commands(folder, text, **environment):
    """Runs lines of the page in a shell, whose python is this one."""
    tools = folder / "bin"
    tools.mkdir(exist_ok=True)
    (tools / "python").write_text(f'#!/bin/sh\nexec "{sys.executable}" -B "$@"\n')
    (tools / "python").chmod(0o755)
    subprocess.run(["sh", "-eu", "-c", text], check=True, cwd=folder, stdout=subprocess.DEVNULL,
                   env={**os.environ, "PATH": f"{tools}:{os.environ['PATH']}", **environment})


def small(text):
    """The same with fewer and smaller pictures."""
    return text.replace("--views 48", "--views 4").replace("--size 512", "--size 24").replace("--threads 8", "--threads 1")


@pytest.fixture
def page(folder):
    (folder / "lamp.glb").write_bytes((folder / "chair.glb").read_bytes())
    text = (DOCS / "dataset.md").read_text()
    return {language: re.findall(rf"```{language}\n(.*?)```", text, re.S) for language in ("sh", "bash", "text", "python")}


def test_the_page_of_data_sets(folder, page):
    commands(folder, small(page["sh"][0]) + "python -m rhw.dataset --verify furniture")
    for name in re.findall(r"^furniture/(\S*[^/\s])(?= )", page["text"][0], re.M):
        assert (folder / "furniture" / name).exists(), name
    names = {}
    exec(compile(page["python"][0], "docs/dataset.md", "exec"), names)
    assert Path(names["picture"]).exists() and names["intrinsics"][0, 2] == 11.5
    assert np.allclose(names["extrinsic"] @ names["pose"] @ np.diag([1, -1, -1, 1]), np.eye(4))
    assert all(name in names["model"] for name in ("objects", "nodes")) and "conventions" in names["manifest"]


@pytest.mark.skipif(SANITIZED, reason="eight processes, which the tests of shards have had")
def test_an_array_of_slurm(folder, page):
    """With a stand-in for sbatch, which does at once what it is asked for."""
    (folder / "bin").mkdir()
    sbatch = folder / "bin/sbatch"
    sbatch.write_text('#!/bin/sh -eu\nfor last; do :; done\ncase $* in *--wrap*) sh -eu -c "$last"; exit ;; esac\n'
                      'ids=$(sed -n "s/^#SBATCH --array=1-\\([0-9]*\\) .*/\\1/p" "$last")\n'
                      'for id in $(seq "$ids"); do SLURM_ARRAY_TASK_ID=$id sh "$last" >&2; done\necho 7\n')
    sbatch.chmod(0o755)
    (folder / "models.txt").write_text("chair.glb\nlamp.glb\n")
    text = small(page["bash"][0]).replace("1-64", "1-3").replace("/64", "/3")
    commands(folder, text)
    assert [len(model["views"]) for model in manifest(folder / "furniture")["models"]] == [4, 4]
    assert {path.name for path in (folder / "furniture/.rhw/chair").iterdir()} >= {"0000.json", "0003.json"}


def test_every_output_is_on_the_page():
    from rhw.dataset.plan import FORMATS

    rows = re.findall(r"^\| (`.*?) \| ([a-z, ]+) \|", (DOCS / "dataset.md").read_text(), re.M)
    told = {name: tuple(forms.split(", ")) for names, forms in rows for name in re.findall(r"`(\w+)`", names)}
    assert told == FORMATS
    assert set(FORMATS) == set(rhw.pictures.OUTPUTS)
