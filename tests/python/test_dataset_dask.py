# SPDX-License-Identifier: MIT
"""rhw.dataset with a real scheduler and workers of Dask distributed, of which one is killed, or all are lost."""

import json
import logging
import signal
import subprocess
import sys
from types import SimpleNamespace

import pytest

from conftest import SANITIZED
from dataset_runs import files, finished, held, let_go, records, run, start, wait_for
from rhw.dataset import cluster as cluster_module
from rhw.dataset.main import main
from rhw.dataset.work import Task

pytest.importorskip("distributed", reason="Dask distributed is not here: script/bootstrap dataset")
pytestmark = pytest.mark.skipif(SANITIZED, reason="workers of Dask read models, by a fork, while other threads run")

SLOW = ("--views", 40, "--size", 160, "--samples", 16, "--outputs", "color,distance,object:png,triangle:npz")


class Cluster:
    def __init__(self, folder):
        self._folder, self.processes = folder, []
        about = folder / "scheduler.json"
        self.scheduler = self._start("dask_scheduler", "--port", "0", "--host", "127.0.0.1", "--scheduler-file", about)
        wait_for(lambda: about.exists() and about.read_text().endswith("}"), "the scheduler")
        self.address = json.loads(about.read_text())["address"]
        self.workers = [self._start("dask_worker", self.address, "--no-nanny", "--nthreads", "1", "--host", "127.0.0.1",
                                    "--local-directory", folder) for _ in range(2)]
        wait_for(lambda: self.told("Registered to") == 2, "the workers")

    def _start(self, program, *arguments):
        log = open(self._folder / f"{len(self.processes)}.log", "w")
        command = [sys.executable, "-B", "-m", f"distributed.cli.{program}", "--no-dashboard", *map(str, arguments)]
        self.processes.append(subprocess.Popen(command, stdout=log, stderr=log, cwd=self._folder))
        log.close()
        return self.processes[-1]

    def told(self, what):
        return sum(what in log.read_text() for log in self._folder.glob("*.log"))

    def end(self):
        for process in self.processes:
            process.kill()
            process.wait()


@pytest.fixture
def cluster(tmp_path):
    (tmp_path / "cluster").mkdir()
    made = Cluster(tmp_path / "cluster")
    yield made
    made.end()


@pytest.fixture(scope="module")
def whole(tmp_path_factory, boxes):
    folder = tmp_path_factory.mktemp("whole") / "set"
    run(boxes, *SLOW, "--out", folder)
    return files(folder)


def test_a_worker_is_killed(whole, boxes, tmp_path, cluster):
    held(tmp_path / "set", (boxes, *SLOW), 20)
    process = start(boxes, *SLOW, "--out", tmp_path / "set", "--scheduler", cluster.address)
    wait_for(lambda: len(records(tmp_path / "set")) >= 6, "the sixth view")
    cluster.workers[0].send_signal(signal.SIGKILL)
    there = len(records(tmp_path / "set"))
    let_go(tmp_path / "set")
    said = process.communicate(timeout=60)
    assert process.returncode == 0 and there < 40, said
    assert said[1] == ""
    assert finished(tmp_path / "set") == whole
    run("--verify", tmp_path / "set")


def test_the_scheduler_is_lost(whole, boxes, tmp_path, cluster):
    held(tmp_path / "set", (boxes, *SLOW), 20)
    process = start(boxes, *SLOW, "--out", tmp_path / "set", "--scheduler", cluster.address)
    wait_for(lambda: len(records(tmp_path / "set")) >= 6, "the sixth view")
    cluster.scheduler.kill()
    said = process.communicate(timeout=60)[1]
    assert process.returncode == 1
    assert said == f"rhw.dataset: {cluster.address}: the scheduler is lost; the same command goes on from here\n"
    assert "manifest.json" not in files(tmp_path / "set")
    for worker in cluster.workers:  # which end what they are at
        worker.kill()
        worker.wait()
    let_go(tmp_path / "set")
    run(boxes, *SLOW, "--out", tmp_path / "set")
    assert finished(tmp_path / "set") == whole


def test_a_lost_scheduler_does_not_answer(monkeypatch):
    """Nor to a client that closes: what is told is that it was lost."""
    class Future:
        status = "cancelled"

    class Client:
        def __init__(self, *_, **__):
            pass

        def submit(self, *_, **__):
            return Future()

        def close(self, timeout):
            raise TimeoutError(f"timed out after {timeout} s.")

    distributed = SimpleNamespace(Client=Client, as_completed=iter)
    monkeypatch.setattr(cluster_module.importlib, "import_module", lambda _: distributed)
    task = Task("run", "/set", 0, "/boxes.obj", (0,), 1)
    assert [done.failed for done in cluster_module.draw_all([task], "tcp://x:1")] == ["tcp://x:1: the scheduler is lost"]


def test_ended_and_begun_again(whole, boxes, tmp_path, cluster):
    """Ctrl-C ends it, whatever workers are at; another run goes on with the same ones."""
    held(tmp_path / "set", (boxes, *SLOW), 20)
    process = start(boxes, *SLOW, "--out", tmp_path / "set", "--scheduler", cluster.address)
    wait_for(lambda: len(records(tmp_path / "set")) >= 6, "the sixth view")
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=60)
    let_go(tmp_path / "set")
    assert process.returncode == -signal.SIGINT
    run(boxes, *SLOW, "--out", tmp_path / "set", "--scheduler", cluster.address)
    assert finished(tmp_path / "set") == whole


def test_workers_keep_nothing_of_another_data_set(boxes, tmp_path, cluster):
    """The same folder begun anew, with another model of the same name."""
    model, out = tmp_path / "boxes.obj", tmp_path / "set"
    model.write_text(boxes.read_text())
    for change in ("", "v 9 9 9\nf 1 2 17\n"):
        model.write_text(model.read_text() + change)
        asked = (model, "--views", 2, "--size", 20, "-q")
        run(*asked, "--out", out, "--scheduler", cluster.address)
        run(*asked, "--out", tmp_path / f"local{len(change)}")
        assert files(out) == files(tmp_path / f"local{len(change)}")
        out.rename(tmp_path / f"older{len(change)}")


def test_bad_models_and_places(boxes, tmp_path, cluster):
    (tmp_path / "bad.obj").write_bytes(b"\0\1\2")
    said = run(tmp_path / "bad.obj", boxes, "--views", 9, "--size", 20, "--out", tmp_path / "set", "--scheduler",
               cluster.address, status=1).splitlines()
    assert len(said) == 2 and "bad.obj: " in said[0] and "1 of 2 models cannot be drawn" in said[1]
    assert len(records(tmp_path / "set")) == 9


@pytest.mark.filterwarnings("ignore::DeprecationWarning")  # of Dask, about asyncio
@pytest.mark.parametrize("address", ["tcp://127.0.0.1:1", "nonsense"])
def test_no_scheduler(boxes, tmp_path, monkeypatch, capsys, address):
    monkeypatch.setattr(cluster_module, "_CONNECT_SECONDS", 0.5)
    with pytest.raises(SystemExit) as ended:
        main([str(boxes), "--out", str(tmp_path / "set"), "--scheduler", address])
    assert logging.root.manager.disable == logging.NOTSET
    said = capsys.readouterr().err
    assert ended.value.code == 1
    assert said.startswith(f"rhw.dataset: {address}: no scheduler answers: ") and said.count("\n") == 1


def test_workers_of_another_place(boxes, tmp_path, cluster):
    """Workers that do not see the folder say so; here, since it is gone when they look, after it was begun."""
    for worker in cluster.workers:
        worker.send_signal(signal.SIGSTOP)
    process = start(boxes, "--views", 4, "--size", 20, "--out", tmp_path / "set", "--scheduler", cluster.address)
    wait_for(lambda: cluster.told("Receive client connection"), "the client")
    (tmp_path / "set/.rhw/plan.json").unlink()
    for worker in cluster.workers:
        worker.send_signal(signal.SIGCONT)
    said = process.communicate(timeout=60)[1]
    assert process.returncode == 1
    assert said == (f"rhw.dataset: {tmp_path}/set: is not seen from here: all that draw must share the folder; "
                    "the same command goes on from here\n")
