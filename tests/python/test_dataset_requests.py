# SPDX-License-Identifier: MIT
"""What is asked of rhw.dataset: what is wrong with it is one line, and what is drawn lies where the manifest says.

All of it runs in this process, which takes no time: script/test has it, the other tests of data sets are for a release.
"""

import io
import json
import os
import re
import sys

import pytest

from dataset_runs import files, manifest, say
from rhw.dataset.progress import Progress

POSE = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 5], [0, 0, 0, 1]]


@pytest.mark.parametrize("arguments, line", [
    ("", "no MODEL was given"),
    ("m.obj", "--out: must say which folder"),
    ("m.obj --out", "--out: expected one argument"),
    ("m.obj --out o --nonsense", "unrecognized arguments: --nonsense"),
    ("m.obj --out o --view 3", "unrecognized arguments: --view"),
    ("m.obj m.obj --out o", "m.obj: is given twice"),
    ("m.obj ./m.obj --out o", r"./m.obj: would have the name 'm.obj', as m.obj has"),
    ("@nowhere.txt --out o", "No such file or directory: 'nowhere.txt'"),
    ("m.obj --out o --views 0", "--views: must be a whole number from 1 to 10000000, not '0'"),
    ("m.obj --out o --views 2.5", "--views: must be a whole number"),
    ("m.obj --out o --size 0x3", "--size: must be WIDTHxHEIGHT or one number, of 1 to 16384, not '0x3'"),
    ("m.obj --out o --size 20000", "--size: must be"),
    ("m.obj --out o --outputs color,foo", "--outputs: 'foo' is not one of color, linear"),
    ("m.obj --out o --outputs color,color:npz", "--outputs: 'color' is there twice"),
    ("m.obj --out o --outputs distance:png", "--outputs: 'distance' is written as exr or npz, not as 'png'"),
    ("m.obj --out o --outputs color:", "--outputs: 'color' is written as png or npz, not as ''"),
    ("m.obj --out o --elevation 40,-40", "--elevation: must have the lower number first, not 40,-40"),
    ("m.obj --out o --elevation -40,100", "--elevation: must lie between -90 and 90, not 100"),
    ("m.obj --out o --elevation 1,2,3", "--elevation: must be 2 numbers with commas between, not '1,2,3'"),
    ("m.obj --out o --fovy nan", "--fovy: must lie between 0.01 and 179, not nan"),
    ("m.obj --out o --fovy wide", "--fovy: must be a number, not 'wide'"),
    ("m.obj --out o --radius 0", "--radius: must lie between 0.001 and"),
    ("m.obj --out o --radius 1 --distance 2", "--radius: says nothing beside --distance"),
    ("m.obj --out o --center 1,2", "--center: must be 3 numbers"),
    ("m.obj --out o --up w", "--up: invalid choice: 'w'"),
    ("m.obj --out o --samples 3", "--samples: invalid choice: 3"),
    ("m.obj --out o --background pink", "--background: must be rrggbb in hexadecimal"),
    ("m.obj --out o --background environment", "--background: 'environment' needs --environment"),
    ("m.obj --out o --environment-rotation -3", "--environment-rotation: needs --environment"),
    ("m.obj --out o --environment x.hdr --environment-rotation nan", "--environment-rotation: must lie between"),
    ("m.obj --out o --shadows maybe", "--shadows: must be on or off, not 'maybe'"),
    ("m.obj --out o --threads 0", "-j/--threads: must be a whole number from 1 to 64, not '0'"),
    ("m.obj --out o --shard 0/3", "--shard: must be NUMBER/COUNT, from 1/COUNT to COUNT/COUNT, not '0/3'"),
    ("m.obj --out o --shard 4/3", "--shard: must be"),
    ("m.obj --out o --shard 1/2 --scheduler tcp://x:1", "--shard: says nothing beside --scheduler"),
    ("m.obj --out o --cameras c.json --views 3", "--views: says nothing beside --cameras"),
    ("m.obj --verify o", "--verify OUT: needs no models"),
])
def test_a_wrong_command_line(arguments, line, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    status, said = say(capsys, *arguments.split())
    assert status == 2 and re.fullmatch(r"rhw\.dataset: .*\n", said) and line in said
    assert os.listdir(tmp_path) == []


@pytest.mark.parametrize("about, line", [
    ("{", "c.json: is not JSON"),
    ("[]", "c.json: must be a JSON object"),
    ({}, "c.json: frames: must be a list of cameras"),
    ({"frames": []}, "c.json: frames: must be a list of cameras"),
    ({"frames": [7]}, "c.json: frames[0]: must be an object with transform_matrix"),
    ({"fl_x": 9, "frames": [{}]}, "c.json: frames[0]: transform_matrix: must be 4 rows of 4 numbers"),
    ({"fl_x": 9, "frames": [{"transform_matrix": POSE}, {"transform_matrix": [[1, 2], 3, 4]}]}, "frames[1]: transform_matrix: must be"),
    ({"fl_x": 9, "frames": [{"transform_matrix": [[2, 0, 0, 0], *POSE[1:]]}]}, "transform_matrix: must turn and move"),
    ({"fl_x": 9, "frames": [{"transform_matrix": [[-1, 0, 0, 0], *POSE[1:]]}]}, "transform_matrix: must turn and move"),
    ({"fl_x": 9, "frames": [{"transform_matrix": [["1", 0, 0, 0], *POSE[1:]]}]}, "must be a number from -1e+30 to 1e+30, not '1'"),
    ({"frames": [{"transform_matrix": POSE}]}, "frames[0]: fl_x or camera_angle_x: must say what the lens is"),
    ({"fl_x": 9, "k1": 0.1, "frames": [{"transform_matrix": POSE}]}, "frames[0]: k1: distortion of a lens is not drawn"),
    ({"fl_x": 9, "w": 10, "h": 20, "frames": [{"transform_matrix": POSE}]}, "w, h: are 10, 20, which is no scaled 64, 48"),
    ({"fl_x": 9, "w": 0, "h": 0, "frames": [{"transform_matrix": POSE}]}, "w: must be a number from 1 to 16384, not 0"),
    ("[" * 100000, "c.json: is damaged"),
    ({"fl_x": float("nan"), "frames": [{"transform_matrix": POSE}]}, "fl_x: must be a number"),
    ({"camera_angle_x": 4, "frames": [{"transform_matrix": POSE}]}, "camera_angle_x: must be a number from 0.0001 to 3.1, not 4"),
])
def test_a_wrong_file_of_cameras(about, line, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "c.json").write_text(about if isinstance(about, str) else json.dumps(about))
    status, said = say(capsys, "m.obj", "--cameras", "c.json", "--size", "64x48", "--out", "o")
    assert status == 1 and re.fullmatch(r"rhw\.dataset: .*\n", said) and line in said
    assert os.listdir(tmp_path) == ["c.json"]


@pytest.fixture
def asked(boxes, tmp_path):
    return (boxes, "--views", 2, "--size", 16, "-j", 1, "--out", tmp_path / "set")


def test_where_things_lie(asked, tmp_path, capsys):
    """Also what each file holds of an output, with one channel and with several, and the cameras as NeRF has them."""
    out = tmp_path / "set"
    assert say(capsys, *asked, "--views", 1, "--outputs", "color,distance,uv,triangle:png,object:npz,normal:npz") == (0, "")
    assert set(files(out)) == {"manifest.json", ".rhw/plan.json", ".rhw/boxes/model.json", ".rhw/boxes/0000.json", "boxes/0000.exr",
                               "boxes/0000.npz", "boxes/0000.png", "boxes/0000.triangle.png", "boxes/transforms.json"}
    about = manifest(out)
    assert {output: told["holds"] for output, told in about["outputs"].items()} == {
        "color": "8 bits", "distance": "distance.Z: float", "uv": "uv.U V: float", "triangle": "16 bits",
        "object": "object: uint32 (rows, columns)", "normal": "normal: float32 (rows, columns, 4)"}
    cameras = json.loads((out / "boxes/transforms.json").read_text())
    view, = about["models"][0]["views"]
    assert [cameras[key] for key in ("w", "h", "fl_x", "cx", "cy")] == [16, 16, view["fx"], view["cx"] + 0.5, view["cy"] + 0.5]
    assert cameras["frames"] == [{"file_path": "0000.png", "transform_matrix": view["camera_to_world"]}]


def test_what_is_there_already(asked, tmp_path, capsys):
    """A run that was not finished goes on; what is damaged is told and drawn again, and nothing else is."""
    out = tmp_path / "set"
    assert say(capsys, "--verify", out) == (1, f"rhw.dataset: {out}: is no data set: it has no manifest.json\n")
    assert say(capsys, *asked, "--shard", "1/2") == (0, "")
    assert say(capsys, "--verify", out) == (1, f"rhw.dataset: {out}: is not finished: its command goes on\n")
    assert say(capsys, *asked) == (0, "") and say(capsys, "--verify", out) == (0, "")
    before, damaged = files(out), out / "boxes/0001.png"
    damaged.write_bytes(b"no picture")
    assert say(capsys, "--verify", out) == (1, f"rhw.dataset: {damaged}: has changed\n"
                                               f"rhw.dataset: {out}: 1 of 3 files are not those of the manifest\n")
    assert say(capsys, *asked) == (0, f"rhw.dataset: {damaged}: is not what was drawn, and is drawn again\n")
    assert files(out) == before
    damaged.unlink()
    damaged.symlink_to("0000.png")
    assert say(capsys, *asked) == (0, f"rhw.dataset: {damaged}: is not what was drawn, and is drawn again\n")
    assert files(out) == before and not damaged.is_symlink()
    damaged.unlink()
    damaged.symlink_to(tmp_path)
    assert say(capsys, *asked) == (0, f"rhw.dataset: {damaged}: is not what was drawn, and is drawn again\n")
    assert files(out) == before and not damaged.is_symlink()
    cameras = out / "boxes/transforms.json"
    cameras.rename(tmp_path / "cameras.json")
    cameras.symlink_to(tmp_path / "cameras.json")
    (out / "manifest.json").unlink()
    assert say(capsys, *asked) == (0, "") and files(out) == before and cameras.is_symlink()
    (tmp_path / "cameras.json").write_bytes(b"{}")
    assert say(capsys, "--verify", out) == (1, f"rhw.dataset: {cameras}: has changed\n"
                                               f"rhw.dataset: {out}: 1 of 3 files are not those of the manifest\n")
    assert say(capsys, *asked) == (0, "") and files(out) == before


def test_a_line_on_a_terminal(monkeypatch):
    """It is written over itself, and gone where another line comes."""
    terminal = io.StringIO()
    monkeypatch.setattr(terminal, "isatty", lambda: True)
    monkeypatch.setattr(sys, "stderr", terminal)
    progress = Progress(12, quiet=False)
    progress.add(3)
    progress.fail("a model cannot be drawn")
    progress.clear()
    assert terminal.getvalue() == ("\r3 of 12 views\r             \rrhw.dataset: a model cannot be drawn\n"
                                   "\r3 of 12 views\r             \r")
