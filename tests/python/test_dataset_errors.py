# SPDX-License-Identifier: MIT
"""What is wrong with a model, a panorama or a place is one line, and leaves nothing half done."""

import errno
import json
import os
import shutil

import pytest

from dataset_runs import files, manifest, run, say
from rhw import _files
from rhw.dataset import plan, work
from rhw.dataset.cameras import Sphere
from rhw.dataset.errors import Failure
from rhw.dataset.plan import Plan, name_models
from test_environment import radiance, sky


def test_a_wrong_panorama(boxes, tmp_path, capsys):
    """Nothing is begun with a file that is none, and nothing goes on with another one than before."""
    light, out = tmp_path / "sky.hdr", tmp_path / "set"
    asked = (boxes, "--views", 3, "--size", 20, "--out", out, "--environment", light)
    assert say(capsys, *asked) == (1, f"rhw.dataset: {light}: No such file or directory\n")
    light.write_text("clouds")
    status, said = say(capsys, *asked)
    assert status == 1 and said.startswith(f"rhw.dataset: {light}: ") and said.count("\n") == 1
    assert os.listdir(tmp_path) == ["sky.hdr"]
    status, said = say(capsys, boxes, "--out", out, "--environment", "\udcff.hdr")
    assert (status, said) == (2, "rhw.dataset: '\\udcff.hdr': the names of panoramas must be UTF-8\n")
    assert os.listdir(tmp_path) == ["sky.hdr"]
    light.write_bytes(radiance(sky()))
    run(*asked, "--shard", "1/3")
    before = files(out)
    assert "environment.rotation is 0.0 there, not 5.0" in say(capsys, *asked, "--environment-rotation", 5)[1]
    light.write_bytes(radiance(sky()[::-1]))
    assert "environment.sha256 is " in say(capsys, *asked)[1]
    assert files(out) == before


def test_a_panorama_that_changes_on_the_way(boxes, tmp_path):
    """A worker that sees another file than was asked for draws nothing."""
    light, out = tmp_path / "sky.hdr", tmp_path / "set"
    light.write_bytes(radiance(sky()))
    run(boxes, "--views", 3, "--size", 20, "--out", out, "--environment", light, "--shard", "1/3")
    light.write_bytes(radiance(sky()[::-1]))
    done = work.draw(work.Task("another", str(out), 0, str(boxes), (1, 2), 1, lit_by=str(light)))
    assert done.failed == f"{light}: has changed since {out} was begun; take another folder" and done.drawn == 0


def test_a_folder_of_others(boxes, tmp_path, capsys):
    (tmp_path / "thesis.tex").write_text("years")
    assert say(capsys, boxes, "--out", tmp_path) == (1, f"rhw.dataset: {tmp_path}: holds other files; take a new or empty folder\n")
    assert "Not a directory" in say(capsys, boxes, "--out", tmp_path / "thesis.tex/x")[1]
    assert os.listdir(tmp_path) == ["thesis.tex"]


@pytest.mark.parametrize("changed, line", [
    (("--samples", 1), "render.samples is 4 there, not 1"),
    (("--outputs", "color,object"), 'outputs.object is null there, not "exr"'),
    (("--views", 4), "cameras.sphere.views is 3 there, not 4"),
    (("--seed", 4), "cameras.sphere.seed is 0 there, not 4"),
    (("--size", 21), "size[0] is 20 there, not 21"),
    (("other.obj",), "models are 1 there, not 2"),
])
def test_another_request_in_the_same_folder(boxes, tmp_path, capsys, changed, line):
    out = tmp_path / "set"
    asked = (boxes, "--views", 3, "--size", 20, "--out", out, "--shard", "1/3")
    run(*asked)
    before = files(out)
    status, said = say(capsys, *asked, *changed)
    assert (status, said) == (1, f"rhw.dataset: {out}: has another data set: {line}; take another folder\n")
    assert files(out) == before


def plan_of(views):
    return Plan((("boxes", "boxes.obj"),), Sphere(views), (20, 20), {"color": "png"}, {}, {})


@pytest.mark.parametrize("links", [True, False])
def test_two_requests_at_once(tmp_path, monkeypatch, links):
    """Both see an empty folder; one has it, the other is refused, or goes on where it asks for the same."""
    def refuse(*_):
        raise PermissionError(errno.EPERM, "no links here")

    if not links:
        monkeypatch.setattr(os, "link", refuse)
        monkeypatch.setattr(_files, "_open_unnamed", lambda folder: None)
    look = plan._refuse_strangers

    def look_and_wait(folder, path):
        look(folder, path)
        monkeypatch.setattr(plan, "_refuse_strangers", look)
        assert plan.begin(folder, plan_of(3)).views == 3  # the other one's turn

    for name, views in (("equal", 3), ("different", 4)):
        monkeypatch.setattr(plan, "_refuse_strangers", look_and_wait)
        if name == "different":
            with pytest.raises(Failure, match="has another data set: cameras.sphere.views is 3 there, not 4"):
                plan.begin(str(tmp_path / name), plan_of(views))
        else:
            assert plan.begin(str(tmp_path / name), plan_of(views)).views == 3
        assert os.listdir(tmp_path / name / ".rhw") == ["plan.json"]


def test_models_that_cannot_be_drawn(boxes, tmp_path):
    """Others are drawn; without what is broken the manifest is written only when that is asked for."""
    shutil.copy(boxes, tmp_path / "good.obj")
    (tmp_path / "bad.obj").write_bytes(b"\0\1\2")
    asked = (tmp_path / "bad.obj", tmp_path / "good.obj", tmp_path / "gone.obj", "--views", 3, "--size", 20, "--out",
             tmp_path / "set")
    said = run(*asked, status=1).splitlines()
    assert len(said) == 4 and all(line.startswith("rhw.dataset: ") for line in said), said
    assert sum("bad.obj: " in line for line in said) == 1
    assert f"rhw.dataset: {tmp_path}/gone.obj: No such file or directory" in said
    assert "2 of 3 models cannot be drawn" in said[-1] and not (tmp_path / "set/manifest.json").exists()
    run(*asked, "--skip-failed")
    assert [model["name"] for model in manifest(tmp_path / "set")["models"]] == ["good"]
    assert "no model can be drawn" in run(tmp_path / "bad.obj", "--skip-failed", "--out", tmp_path / "none", status=1)


def test_models_with_faults(boxes, tmp_path):
    """A material library that is not there is told once; with --strict nothing is drawn."""
    shutil.copy(boxes, tmp_path / "plain.obj")
    asked = (tmp_path / "plain.obj", "--views", 3, "--size", 20)
    said = run(*asked, "--out", tmp_path / "set")
    assert said.count("\n") == 1 and said.startswith(f"rhw.dataset: {tmp_path}/plain.obj: ")
    model, = manifest(tmp_path / "set")["models"]
    assert said.endswith(model["warnings"][0] + "\n")
    assert run(*asked, "--out", tmp_path / "again", "-q") == ""
    assert "1 of 1 model cannot be drawn" in run(*asked, "--out", tmp_path / "strict", "--strict", status=1)


def test_a_model_that_has_changed(boxes, tmp_path):
    """Its own file, and one that it names."""
    for name in ("boxes.obj", "boxes.mtl"):
        shutil.copy(boxes.parent / name, tmp_path)
    asked = (tmp_path / "boxes.obj", "--views", 3, "--size", 20, "--out", tmp_path / "set")
    run(*asked, "--shard", "1/3")
    older = (tmp_path / "boxes.mtl").read_text()
    (tmp_path / "boxes.mtl").write_text(older.replace("0.8", "0.1"))
    assert "has changed since" in run(*asked, status=1)
    (tmp_path / "boxes.mtl").write_text(older)
    run(*asked)
    (tmp_path / "set/manifest.json").unlink()
    (tmp_path / "boxes.obj").write_text((tmp_path / "boxes.obj").read_text() + "# more\n")
    assert "boxes.obj: has changed since" in run(*asked, status=1)
    assert not (tmp_path / "set/manifest.json").exists()


def test_ids_that_a_png_cannot_hold(tmp_path):
    (tmp_path / "many.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\n" + "f 1 2 3\n" * 65536)
    asked = (tmp_path / "many.obj", "--views", 1, "--size", 20, "--outputs")
    said = run(*asked, "triangle:png", "--out", tmp_path / "png", status=1)
    assert "has 65536 triangles, and a PNG counts to 65535; take triangle:exr" in said
    run(*asked, "triangle:npz", "--out", tmp_path / "npz")


@pytest.mark.parametrize("name, line", [("manifest.json", "manifest.json: is not JSON"), (".rhw/plan.json", "plan.json: is not of")])
def test_a_damaged_folder(boxes, tmp_path, capsys, name, line):
    out = tmp_path / "set"
    run(boxes, "--views", 1, "--size", 20, "--out", out)
    (out / name).write_text("{}" if "plan" in name else "{")
    arguments = ("--verify", out) if name == "manifest.json" else (boxes, "--out", out)
    status, said = say(capsys, *arguments)
    assert status == 1 and line in said and said.count("\n") == 1
    for damaged in ("{}", '{"format": "rhw.dataset 1"}', '{"format": "rhw.dataset 1", "models": [7]}'):
        (out / "manifest.json").write_text(damaged)
        assert say(capsys, "--verify", out)[1].count("\n") == 1


@pytest.mark.parametrize("change", [
    lambda about, model, view: model.update(views=[]), lambda about, model, view: view.update(files={}),
    lambda about, model, view: about.update(size=[10**400, 1]), lambda about, model, view: view.update(cx=10**400)])
def test_a_damaged_manifest(boxes, tmp_path, capsys, change):
    out = tmp_path / "set"
    run(boxes, "--views", 1, "--size", 20, "--out", out)
    about = manifest(out)
    change(about, about["models"][0], about["models"][0]["views"][0])
    (out / "manifest.json").write_text(json.dumps(about))
    assert say(capsys, "--verify", out) == (1, f"rhw.dataset: {out}/manifest.json: is damaged\n")


def test_a_damaged_plan(boxes, tmp_path, capsys):
    asked = (boxes, "--views", 1, "--size", 20, "--out", tmp_path / "set")
    run(*asked)
    (tmp_path / "set/.rhw/plan.json").write_text('{"format": "rhw.dataset 1"}')
    status, said = say(capsys, *asked)
    assert status == 1 and said.startswith(f"rhw.dataset: {tmp_path}/set/.rhw/plan.json: is damaged") and said.count("\n") == 1


@pytest.mark.parametrize("text", ["", "{}", '{"fx": 1.0, "files": {}}', "[1]", "\0"])
def test_a_damaged_record(boxes, tmp_path, capsys, text):
    """Its view is drawn again, so that it is there again."""
    asked = (boxes, "--views", 1, "--size", 20, "--out", tmp_path / "set")
    run(*asked)
    path = tmp_path / "set/.rhw/boxes/0000.json"
    before = path.read_bytes()
    path.write_text(text)
    assert say(capsys, *asked) == (0, f"rhw.dataset: {path}: is not what was drawn, and is drawn again\n")
    assert path.read_bytes() == before


def test_names_of_models(tmp_path, capsys):
    """No names of the folder's own files, and none that JSON cannot have."""
    asked = ["plan.json.obj", "a/manifest.json.obj", "manifest.json.new.obj", "plan.obj"]
    assert [name for name, _ in name_models(asked)] == ["manifest.json.new_", "manifest.json_", "plan", "plan.json_"]
    status, said = say(capsys, "m\udcff.obj", "--out", tmp_path / "o")
    assert status == 2 and said == "rhw.dataset: 'm\\udcff.obj': the names of models must be UTF-8\n"


def test_a_place_that_cannot_be_written(boxes, tmp_path, capsys):
    """The line names the file; what was begun of it is gone."""
    out = tmp_path / "set"
    run(boxes, "--views", 3, "--size", 20, "--out", out, "--shard", "1/3")
    (out / "boxes/0002.png").mkdir()
    status, said = say(capsys, boxes, "--views", 3, "--size", 20, "--out", out)
    assert status == 1
    assert said == f"rhw.dataset: {out}/boxes/0002.png: Is a directory; the same command goes on from here\n"
    (out / "boxes/0002.png").rmdir()
    run(boxes, "--views", 3, "--size", 20, "--out", out)
    assert not [name for name in files(out) if "/.rhw-" in name]
