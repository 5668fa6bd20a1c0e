# SPDX-License-Identifier: MIT
"""Runs of rhw.dataset that are killed, shared out and begun again make the data set of one run."""

import os
import pty
import shutil
import signal
import subprocess
import threading
import time

import pytest

from dataset_runs import command, files, held, let_go, manifest, marks, records, run, start, wait_for
from rhw.dataset import local

#: Slow enough to be ended in the middle.
SLOW = ("--views", 40, "--size", 160, "--samples", 16, "--outputs", "color,distance,object:png,triangle:npz")


@pytest.fixture(scope="module")
def whole(tmp_path_factory, boxes):
    """What one run makes."""
    folder = tmp_path_factory.mktemp("whole") / "set"
    run(boxes, *SLOW, "--out", folder)
    return files(folder)


@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGINT, signal.SIGTERM])
def test_ended_and_begun_again(whole, boxes, tmp_path, number):
    held(tmp_path / "set", (boxes, *SLOW), 20)
    process = start(boxes, *SLOW, "--out", tmp_path / "set")
    wait_for(lambda: len(records(tmp_path / "set")) >= 6, "the sixth view")
    process.send_signal(number)
    said = process.communicate(timeout=60)[1]
    let_go(tmp_path / "set")
    assert process.returncode == -number
    assert said == ("rhw.dataset: ended; the same command goes on from here\n" if number == signal.SIGINT else "")
    there, before = files(tmp_path / "set"), marks(tmp_path / "set")
    assert 6 <= len(records(tmp_path / "set")) < 40 and "manifest.json" not in there
    # What has a name is whole: the bytes of the run that was not ended.
    named = {name: sha for name, sha in there.items() if "/.rhw-" not in name}
    assert named.items() <= whole.items()
    assert "is not finished" in run("--verify", tmp_path / "set", status=1)

    for path in (tmp_path / "set").rglob(".rhw-*"):
        os.utime(path, (time.time() - 7200,) * 2)
    run(boxes, *SLOW, "--out", tmp_path / "set")
    assert files(tmp_path / "set") == whole  # nothing half is left
    after = marks(tmp_path / "set")
    assert {name: after[name] for name in named} == {name: before[name] for name in named}

    run(boxes, *SLOW, "--out", tmp_path / "set")
    assert marks(tmp_path / "set") == after


def test_what_is_missing_is_drawn(whole, boxes, tmp_path):
    """Pictures without their record are compared, not written; what somebody removed is there again."""
    run(boxes, *SLOW, "--out", tmp_path / "set")
    before = marks(tmp_path / "set")
    for name in (".rhw/boxes/0003.json", "boxes/0005.npz", "manifest.json"):
        (tmp_path / "set" / name).unlink()
    run(boxes, *SLOW, "--out", tmp_path / "set")
    assert files(tmp_path / "set") == whole
    after = marks(tmp_path / "set")
    assert {name for name in whole if after[name] != before[name]} <= {".rhw/boxes/0003.json", "boxes/0005.npz", "manifest.json"}


def test_what_has_changed_is_drawn_again(boxes, tmp_path):
    """Pictures and records, of a data set that is finished and of one that is not."""
    folder, asked = tmp_path / "set", (boxes, "--views", 6, "--size", 32)
    run(*asked, "--out", folder)
    before = files(folder)
    pictures, (*_, record, other) = sorted((folder / "boxes").glob("*.png")), sorted(records(folder))
    pictures[0].write_bytes(pictures[0].read_bytes()[:-9] + b"X" * 9)
    pictures[1].write_bytes(b"")
    record.write_text("{")
    other.write_text(other.read_text().replace('"sha256": {', '"sha256": {}, "other": {'))
    (folder / "boxes" / "transforms.json").write_text("{}")
    (folder / "manifest.json").write_text("{}")
    said = run(*asked, "--out", folder)
    assert sorted(said.splitlines()) == sorted(
        f"rhw.dataset: {path}: is not what was drawn, and is drawn again" for path in (*pictures[:2], record, other))
    assert files(folder) == before

    pictures[2].write_bytes(b"no picture")
    (folder / "manifest.json").unlink()
    assert run(*asked, "--out", folder, "--quiet") == "" and files(folder) == before
    seen = marks(folder)
    assert run(*asked, "--out", folder) == "" and marks(folder) == seen


@pytest.mark.parametrize("threads", [1, 2, 5])
def test_any_number_of_threads(whole, boxes, tmp_path, threads):
    run(boxes, *SLOW, "--out", tmp_path / "set", "-j", threads)
    assert files(tmp_path / "set") == whole


def test_shards(whole, boxes, tmp_path):
    """Parts in any order, two at the same time, and a run that finds everything there."""
    parts = [start(boxes, *SLOW, "--out", tmp_path / "set", "--shard", f"{part}/3") for part in (3, 1)]
    for part in parts:
        said = part.communicate(timeout=60)
        assert part.returncode == 0, said
    assert len(records(tmp_path / "set")) == 27 and not (tmp_path / "set/manifest.json").exists()
    run(boxes, *SLOW, "--out", tmp_path / "set", "--shard", "2/3")
    before = marks(tmp_path / "set")
    run(boxes, *SLOW, "--out", tmp_path / "set")
    assert files(tmp_path / "set") == whole
    after = marks(tmp_path / "set")
    assert {name: after[name] for name in before} == before


def test_from_elsewhere(whole, boxes, tmp_path, monkeypatch):
    """A model may be called otherwise when a run goes on; the manifest keeps what it was called first."""
    run(boxes, *SLOW, "--out", tmp_path / "set", "--shard", "1/2")
    monkeypatch.chdir(boxes.parent)
    run("boxes.obj", *SLOW, "--out", os.path.relpath(tmp_path / "set"))
    assert files(tmp_path / "set") == whole
    assert manifest(tmp_path / "set")["models"][0]["path"] == str(boxes)


def test_equal_commands_at_once(boxes, tmp_path):
    """Each finishes a folder that is finished; what a living process is at stays, what was left long ago goes."""
    asked = (boxes, "--views", 3, "--size", 20, "--out", tmp_path / "set")
    run(*asked)
    before = marks(tmp_path / "set")
    young, old = (tmp_path / "set/boxes" / f".rhw-{age}" for age in ("young", "old"))
    young.write_text("half")
    old.write_text("half")
    os.utime(old, (time.time() - 7200,) * 2)
    for process in [start(*asked) for _ in range(3)]:
        said = process.communicate(timeout=300)
        assert process.returncode == 0, said
    assert young.exists() and not old.exists()
    young.unlink()
    assert marks(tmp_path / "set") == before


def test_a_worker_raises(monkeypatch):
    """The others are waited for, and begin nothing more."""
    drawn, begun = [], threading.Event()

    def draw(task):
        if task == 0:
            begun.wait()
            raise MemoryError
        begun.set()
        time.sleep(0.2)
        drawn.append(task)

    monkeypatch.setattr(local, "draw", draw)
    with pytest.raises(MemoryError):
        list(local.draw_all(range(100), 2))
    there = len(drawn)
    assert 1 <= there < 99
    time.sleep(0.3)
    assert len(drawn) == there


def test_verify(boxes, tmp_path):
    out = tmp_path / "set"
    run(boxes, "--views", 3, "--size", 20, "--outputs", "color,object", "--out", out)
    assert run("--verify", out) == ""
    data = bytearray((out / "boxes/0001.exr").read_bytes())
    data[len(data) // 2] ^= 1
    (out / "boxes/0001.exr").write_bytes(data)
    (out / "boxes/0002.png").unlink()
    assert run("--verify", out, status=1).splitlines() == [
        f"rhw.dataset: {out}/boxes/0001.exr: has changed", f"rhw.dataset: {out}/boxes/0002.png: is missing",
        f"rhw.dataset: {out}: 2 of 7 files are not those of the manifest"]
    shutil.copy(boxes, tmp_path / "else.obj")
    assert "is no data set" in run("--verify", tmp_path, status=1)


def test_a_terminal_is_told_how_far_it_is(boxes, tmp_path):
    ours, theirs = pty.openpty()
    process = subprocess.Popen(command(boxes, "--views", 5, "--size", 20, "--out", tmp_path / "set"), stderr=theirs,
                               stdout=subprocess.PIPE, text=True)
    said = process.communicate()[0]
    os.close(theirs)
    shown = os.read(ours, 10000).decode()
    os.close(ours)
    assert shown.startswith("\r0 of 5 views\r") and "\r5 of 5 views" in shown and "\n" not in shown
    assert said == f"{tmp_path}/set: 5 views of 1 model, 5 drawn now: {tmp_path}/set/manifest.json\n"
