# SPDX-License-Identifier: MIT
"""Bad input is an exception of one line that names the thing and the rule, and long work ends when it is asked to."""

import errno
import os
import signal
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import rhw
from conftest import SANITIZED
from rhw import _files, _threads
from rhw.pipeline import Buffer, Pass, Pipeline, Texture

V = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], np.float32)
F = np.array([[0, 1, 2], [0, 2, 3]])
model = rhw.Model(V, F)


@pytest.mark.parametrize("call, kind, line", [
    (lambda: rhw.load("/nowhere/x.glb"), FileNotFoundError, "no such file: '/nowhere/x.glb'"),
    (lambda: rhw.load(__file__), rhw.Error, "test_errors.py: is not a model"),
    (lambda: rhw.load(os.path.dirname(__file__)), rhw.Error, "is a folder"),
    (lambda: rhw.load("x\0y"), (ValueError, FileNotFoundError), ""),
    (lambda: rhw.Model("chair.glb"), TypeError, "vertices: must be an array, not the path 'chair.glb'; rhw.load reads files"),
    (lambda: rhw.Model(V, F, uv=V[:, :2], texture="wood.png"), TypeError, "texture: must be an array of uint8, not the path 'wood.png'"),
    (lambda: rhw.Model(V, F, color=(255, 0, 0)), ValueError, "color: must lie between 0 and 1, linear light, not 255"),
    (lambda: rhw.Model(V, F).render(8)["depth"], KeyError, r"'depth' was not drawn; render\(outputs=…\) says what is: here color"),
    (lambda: rhw.Model(V, F + 3), ValueError, "faces: must lie between 0 and 3, the last of 4 vertices, not 6"),
    (lambda: rhw.Model(V, F - 1), ValueError, "faces: .* not -1"),
    (lambda: rhw.Model(V, F * 0.5), TypeError, "faces: must be of integers, not float64"),
    (lambda: rhw.Model(V[:, :2], F), ValueError, r"vertices: must have the shape \(N, 3\), not \(4, 2\)"),
    (lambda: rhw.Model(V * np.nan, F), ValueError, "vertices: every number must be finite"),
    (lambda: rhw.Model(V * 1e300, F), ValueError, "vertices: every number must be finite"),
    (lambda: rhw.Model(V.astype(complex), F), TypeError, "vertices: must be of numbers, not complex128"),
    (lambda: rhw.Model(np.zeros((0, 3)), F), ValueError, "vertices: there are none"),
    (lambda: rhw.Model(V, np.zeros((0, 3), int)), ValueError, "faces: there are none"),
    (lambda: rhw.Model(V), ValueError, "faces: .* not 4 vertices"),
    (lambda: rhw.Model([[1], [2, 3]], F), (TypeError, ValueError), "vertices: "),
    (lambda: rhw.Model(V, F, normals=V[:2]), ValueError, r"normals: must have the shape \(4, 3\)"),
    (lambda: rhw.Model(V, F, colors=V[:, :2]), ValueError, "colors: must have the shape"),
    (lambda: rhw.Model(V, F, colors=V * 255), ValueError, "colors: must lie between 0 and 1, or be uint8, not 255"),
    (lambda: rhw.Model(V, F, face_colors=V[:2] - 1), ValueError, "face_colors: must lie between 0 and 1, or be uint8, not -1"),
    (lambda: rhw.Model(V, F, texture=np.zeros((2, 2, 3), np.uint8)), ValueError, "texture: needs uv"),
    (lambda: rhw.Model(V, F, uv=V[:, :2], texture=np.zeros((2, 2))), TypeError, "texture: must be of uint8"),
    (lambda: rhw.Model(V, F, uv=V[:, :2], texture=np.zeros((0, 2), np.uint8)), ValueError, "texture: must have"),
    (lambda: rhw.Model(V, F, roughness=2), ValueError, "roughness: must lie between 0 and 1"),
    (lambda: rhw.Model(V, F, color=(1, 2)), ValueError, "color: must have 3 or 4 numbers"),
    (lambda: rhw.Model(V, F, up="w"), ValueError, "up: 'w' is not one of"),
    (lambda: model.render(0), ValueError, "size: width and height must lie between 1 and 16384"),
    (lambda: model.render("big"), TypeError, "size: "),
    (lambda: model.render(64.5), TypeError, "size: must be"),
    (lambda: model.render(64, (30, 20)), TypeError, "camera: must be an rhw.Camera"),
    (lambda: model.render(9, samples=3), ValueError, "samples: must be 1, 2, 4, 8 or 16, not 3"),
    (lambda: model.render(9, samples=True), ValueError, "samples: must be 1, 2, 4, 8 or 16, not True"),
    (lambda: model.render(True), TypeError, "size: must be"),
    (lambda: model.render(9, supersample=5), ValueError, "supersample: must be 1, 4, 9 or 16, not 5"),
    (lambda: model.render(9, outputs=()), ValueError, "outputs: there must be one"),
    (lambda: model.render(9, outputs="colour"), ValueError, "outputs: 'colour' is not one of"),
    (lambda: model.render(9, tone="x"), ValueError, "tone: "),
    (lambda: model.render(9, exposure=99), ValueError, "exposure: must lie between -20 and 20"),
    (lambda: model.render(9, background=(1, 2, 256)), ValueError, "background: must be"),
    (lambda: model.render(9, context=7), (TypeError, AttributeError), ""),
    (lambda: model.render(9, rhw.Camera.of_model(0)), ValueError, "camera: the model has 0 cameras"),
    (lambda: model.render(9, rhw.Camera.look_at((0, 0, 0), (0, 0, 0))), ValueError, "eye and target must be different"),
    (lambda: rhw.Camera.look_at((0, 0, 1), (0, 0, 0), fovy=180), ValueError, "fovy: must lie between 0.01 and 179"),
    (lambda: rhw.Camera.from_matrix(np.eye(3)), ValueError, r"pose: must have the shape \(4, 4\)"),
    (lambda: rhw.Camera.from_matrix(2 * np.eye(4)), ValueError, "pose: must turn and move"),
    (lambda: rhw.Camera.from_matrix(np.diag([-1, 1, 1, 1])), ValueError, "pose: must turn and move, not scale, shear or mirror"),
    (lambda: rhw.Camera.from_matrix(np.eye(4)[[0, 1, 2, 0]]), ValueError, r"pose: its last row must be 0, 0, 0, 1, not \[1.0, 0"),
    (lambda: rhw.Camera.from_matrix(np.eye(4), near=5, far=2), ValueError, "near: must be less than far, 2, not 5"),
    (lambda: rhw.Camera.from_matrix(np.eye(4), near=5, far=5), ValueError, "near: must be less than far, 5, not 5"),
    (lambda: model.render(9, rhw.Camera.from_matrix(np.eye(4), near=1e9)), ValueError, "near: must be less than far"),
    (lambda: rhw.Camera.fit(fov=3), TypeError, r"^Camera.fit\(\) got an unexpected keyword argument 'fov'"),
    (lambda: rhw.Camera.fit().at("chair.glb", 9), TypeError, "model: must be an rhw.Model, not 'chair.glb'"),
    (lambda: rhw.Camera.intrinsics(0, 1, 2, 3), ValueError, "fx: must lie between"),
    (lambda: rhw.Context(threads=-1), ValueError, "threads: must lie between 0 and 64, not -1"),
    (lambda: rhw.Context(isa="sse9"), ValueError, "isa: this computer or this build has no sse9"),
    (lambda: model.render(9).save("x.gif"), ValueError, "x.gif: must end in .png or .exr"),
    (lambda: model.render(9).save("no/folder.png"), FileNotFoundError, r"No such file or directory: 'no/folder.png'$"),
    (lambda: model.render(9).png("depth"), ValueError, "outputs: 'depth'.* was not drawn"),
    (lambda: model.render(9).exr(), ValueError, "outputs: an EXR has"),
    (lambda: rhw.write_png("x.png", np.zeros((2, 2, 2), np.uint8)), ValueError, r"image: must have .*, not \(2, 2, 2\)"),
    (lambda: rhw.write_png("x.png", np.zeros((1, 20000), np.uint8)), ValueError, r"1 to 16384 rows and columns, not \(1, 20000\)"),
    (lambda: rhw.write_png("x.png", np.zeros((2, 2))), TypeError, "image: must be of uint8 or uint16"),
])
def test_one_line(call, kind, line, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(kind, match=line) as caught:
        call()
    assert "\n" not in str(caught.value)
    assert os.listdir(tmp_path) == []


@pytest.mark.parametrize("is_named", (False, True))
@pytest.mark.parametrize("is_linked", (False, True))
def test_a_file_takes_its_place_whole(tmp_path, monkeypatch, is_named, is_linked):
    """Also where the system has no files without a name, and where the folder takes no links."""
    if is_named:
        monkeypatch.setattr(_files, "_open_unnamed", lambda folder: None)
    if not is_linked:
        def refuse(*places, **options):
            raise PermissionError(errno.EPERM, os.strerror(errno.EPERM))

        monkeypatch.setattr(os, "link", refuse)
    place = tmp_path / "file"
    for text in (b"first", b"second"):
        with _files.replacing(place) as file:
            file.write(text)
            assert not place.exists() or place.read_bytes() == b"first"
        assert place.read_bytes() == text
    with pytest.raises(FileExistsError), _files.replacing(place, new=True) as file:
        file.write(b"third")
    with pytest.raises(KeyError), _files.replacing(place) as file:
        raise KeyError
    assert place.read_bytes() == b"second" and list(tmp_path.iterdir()) == [place]


@pytest.mark.parametrize("step", ["open", "_name"])
def test_ctrl_c_just_when_a_file_has_a_name(tmp_path, monkeypatch, step):
    """The older file stays, and no other is there."""
    def interrupted(*arguments):
        if _files.TEMPORARY in str(arguments):
            made.append(work(*arguments))
            raise KeyboardInterrupt
        return work(*arguments)

    made, work = [], getattr(_files, step, open)
    (tmp_path / "file").write_bytes(b"older")
    monkeypatch.setattr(_files, step, interrupted, raising=False)
    unnamed = _files._open_unnamed(os.fspath(tmp_path))
    if unnamed is not None:
        unnamed.close()
    elif step == "_name":
        pytest.skip("this system has no files without a name")
    if step == "open":
        monkeypatch.setattr(_files, "_open_unnamed", lambda folder: None)
    with pytest.raises(KeyboardInterrupt):
        _files.write(tmp_path / "file", b"newer")
    assert len(made) == 1 and list(tmp_path.iterdir()) == [tmp_path / "file"]
    assert (tmp_path / "file").read_bytes() == b"older"
    if step == "open":
        made[0].close()


def test_a_file_is_replaced_and_a_pipe_is_written(tmp_path):
    """What has another name too keeps its bytes under that."""
    place, other, pipe = tmp_path / "file", tmp_path / "other", tmp_path / "pipe"
    place.write_bytes(b"older")
    os.link(place, other)
    _files.write(place, b"newer")
    assert (place.read_bytes(), other.read_bytes()) == (b"newer", b"older")
    os.mkfifo(pipe)
    end = os.open(pipe, os.O_RDWR)
    _files.write(pipe, b"through")
    assert os.read(end, 100) == b"through"
    os.close(end)


def test_a_killed_process_leaves_no_file(tmp_path):
    unnamed = _files._open_unnamed(os.fspath(tmp_path))
    if unnamed is None:
        pytest.skip("this system has no files without a name")
    unnamed.close()
    child = os.fork()
    if child == 0:
        try:
            with _files.replacing(tmp_path / "file") as file:
                file.write(b"half")
                file.flush()
                os.kill(os.getpid(), signal.SIGKILL)
        finally:
            os._exit(1)
    assert os.WTERMSIG(os.waitpid(child, 0)[1]) == signal.SIGKILL
    assert list(tmp_path.iterdir()) == []


def test_a_full_place_keeps_the_older_file(tmp_path):
    (tmp_path / "x.png").write_bytes(b"older")
    os.chmod(tmp_path, 0o500)
    try:
        if os.access(tmp_path, os.W_OK):
            pytest.skip("root may write anywhere")
        with pytest.raises(OSError):
            rhw.write_png(tmp_path / "x.png", np.zeros((2, 2), np.uint8))
    finally:
        os.chmod(tmp_path, 0o700)
    assert (tmp_path / "x.png").read_bytes() == b"older"


def interrupted(work, after):
    """Seconds of processor time from the signal until KeyboardInterrupt is there: other programs take none of it."""
    sent = []

    def send():
        sent.append(time.process_time())
        os.kill(os.getpid(), signal.SIGINT)

    timer = threading.Timer(after, send)
    timer.start()
    try:
        with pytest.raises(KeyboardInterrupt):
            work()
        return time.process_time() - sent[0]
    finally:
        timer.cancel()


@pytest.mark.skipif(SANITIZED, reason="takes a minute with a sanitizer")
def test_ctrl_c_ends_a_draw():
    """Before half of it: by the time of the same draw with a 16th of the pixels."""
    keywords = dict(outputs="linear", samples=1, supersample=16, context=rhw.Context(threads=2))
    begun = time.process_time()
    model.render(1024, **keywords)
    part = time.process_time() - begun
    assert interrupted(lambda: model.render(4096, **keywords), part / 2) < 8 * part + 0.2
    assert model.render(20)["color"].any()  # the context is as good as ever


def test_ctrl_c_ends_the_reading_of_an_environment(tmp_path):
    """Even of a pipe that nobody writes to; once it has ended, the reader that was left behind ends too."""
    tasks = Path("/proc/self/task")
    if not tasks.is_dir():
        pytest.skip("the system does not list the threads of a process")
    pipe = tmp_path / "sky.hdr"
    os.mkfifo(pipe)
    before = len(os.listdir(tasks))
    interrupted(lambda: rhw.Environment(pipe), 0.1)
    assert len(os.listdir(tasks)) > before  # the reader waits at the pipe
    os.close(os.open(pipe, os.O_WRONLY | os.O_NONBLOCK))
    end = time.monotonic() + 60
    while len(os.listdir(tasks)) > before and time.monotonic() < end:
        time.sleep(0.01)
    assert len(os.listdir(tasks)) <= before
    with pytest.raises(rhw.Error, match="is empty"):
        (tmp_path / "none.hdr").touch()
        rhw.Environment(tmp_path / "none.hdr")


def half_a_second(kind):
    """Work of about that much processor time that looks for signals on its way."""
    random = np.random.default_rng(1)
    if kind == "pass":
        targets = {"color": Texture(1024, "rgba8_srgb")}
        pipeline = Pipeline(targets, colors="float32", depth=None, blend=True)
        corners, colors = Buffer(random.uniform(-1, 1, (3000, 3)), np.float32), random.random((3000, 4))
        faces = random.integers(0, 3000, (2000, 3))

        def work():
            with Pass(targets) as draw:
                draw(pipeline, corners, faces, colors=colors)
    elif kind == "png":
        image = random.integers(0, 256, (1024, 2048, 4), np.uint8)

        def work():
            rhw.write_png(os.devnull, image)
    else:
        pictures = model.render(600, outputs=("linear", "normal"))
        pictures["normal"] = random.random((600, 600, 4), np.float32)

        def work():
            pictures.exr()
    return work


@pytest.mark.skipif(SANITIZED, reason="takes longer with a sanitizer")
@pytest.mark.parametrize("kind", ["pass", "png", "exr"])
def test_ctrl_c_ends_passes_and_encoders(kind):
    """Before half of it, and the next call does all of it."""
    work = half_a_second(kind)
    begun = time.process_time()
    work()
    whole = time.process_time() - begun
    assert interrupted(work, whole / 10) < whole / 2
    work()


@pytest.mark.skipif(SANITIZED, reason="an import takes longer with a sanitizer")
def test_ctrl_c_ends_an_import(tmp_path):
    """The process that reads is ended, and has not read half of it: by the time that it takes for a 15th."""
    resource = pytest.importorskip("resource")
    line = b"v 1 2 3\nv 4 5 6\nv 7 8 1\nf -1 -2 -3\n"
    (tmp_path / "small.obj").write_bytes(line * 100000)
    (tmp_path / "large.obj").write_bytes(line * 1500000)  # a second or more

    def of_children(work):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        work()
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime

    part = of_children(lambda: rhw.load(tmp_path / "small.obj"))
    assert of_children(lambda: interrupted(lambda: rhw.load(tmp_path / "large.obj"), 2 * part)) < 7 * part


@pytest.mark.skipif(SANITIZED, reason="sanitizers cannot fork beside threads that allocate")
def test_other_threads_run_meanwhile():
    steps = 0

    def draw():
        rhw.Model(V, F).render(1000, samples=8)

    thread = threading.Thread(target=draw)
    thread.start()
    while thread.is_alive():
        steps += 1
        time.sleep(0.001)
    assert steps > 20


def test_contexts_of_a_thread():
    """It has one for each number of threads that draw, and they are its own."""
    assert rhw.Context(isa=None).isa == rhw.Context().isa
    two, others = _threads.context(2), []
    assert two.threads == 2 and two is _threads.context(2) and two is not _threads.context()
    thread = threading.Thread(target=lambda: others.append(_threads.context(2)))
    thread.start()
    thread.join()
    assert others[0] is not two


def test_after_a_fork():
    parents = _threads.context(2)
    model.render(20, context=parents)
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        status = 1
        try:
            picture = model.render(20).png()
            os.write(writing, picture)
            with pytest.raises(RuntimeError, match="does not live on in a forked process"):
                model.render(20, context=parents)
            assert model.render(20, context=_threads.context(2)).png() == picture
            status = 0
        finally:
            os._exit(status)
    os.close(writing)
    with os.fdopen(reading, "rb") as pipe:
        assert pipe.read() == model.render(20).png()
    assert os.waitpid(child, 0)[1] == 0


def test_ctrl_c_while_rasterizing_with_gradients():
    """Within an image, however long that takes."""
    random = np.random.default_rng(0)
    pos, tri = random.normal(size=(1, 3000, 4)), random.integers(0, 3000, (60000, 3))
    assert interrupted(lambda: rhw.diff.rasterize(pos, tri, (1024, 1024)), 0.2) < 2
