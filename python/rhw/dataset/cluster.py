# SPDX-License-Identifier: MIT
"""Draws on many machines, by Dask distributed.

The workers read the models, so that they see the same folders as we do; hence they also write the pictures, instead of sending
them through the scheduler and us. A worker that is lost costs the views that it was at: Dask gives its tasks to others.
"""

from __future__ import annotations

import asyncio
import contextlib
import importlib
import logging
from typing import Any, Generator, List, Sequence

from .errors import Failure
from .work import Done, Task, draw

_VIEWS_OF_A_TASK = 4
_MOST_TASKS = 10000  # each costs the scheduler about a millisecond
_CONNECT_SECONDS = 10


def group(views: Sequence[int], all_views: int) -> List[Sequence[int]]:
    """The views of a model in the portions of tasks; fewer tasks where there are very many views of all models."""
    portion = max(_VIEWS_OF_A_TASK, -(-all_views // _MOST_TASKS))
    return [views[i:i + portion] for i in range(0, len(views), portion)]


def draw_all(tasks: Sequence[Task], address: str) -> Generator[Done, None, None]:
    """Does the tasks in any order."""
    try:
        distributed: Any = importlib.import_module("distributed")
    except ImportError:
        raise Failure("--scheduler: Dask distributed is not installed (Debian: python3-distributed)") from None
    before = logging.root.manager.disable
    logging.disable()  # what is lost is told here, in one line
    try:
        yield from _draw_by(distributed, tasks, address)
    finally:
        logging.disable(before)


def _draw_by(distributed: Any, tasks: Sequence[Task], address: str) -> Generator[Done, None, None]:
    try:
        client = distributed.Client(address, timeout=_CONNECT_SECONDS)
    except (OSError, ValueError, TypeError) as error:
        raise Failure(f"{address}: no scheduler answers: {_line(error)}") from None
    try:
        futures = {client.submit(draw, task, pure=False): task for task in tasks}
        for future in distributed.as_completed(list(futures)):
            yield _result(future, futures.pop(future), address)
    finally:
        with contextlib.suppress(OSError, asyncio.TimeoutError):  # a lost one does not answer, which is told already
            client.close(timeout=1)


def _result(future: Any, task: Task, address: str) -> Done:
    """What a task came to; what its worker raised, or that it was lost, as its failure."""
    lost = Done(task, failed=f"{address}: the scheduler is lost")
    if future.status == "finished":
        try:
            found = future.result()
        except OSError:  # lost while it was handing the result over
            return lost
        assert isinstance(found, Done)
        return found
    if future.status in ("cancelled", "lost"):
        return lost
    error = future.exception()
    if isinstance(error, ImportError):
        return Done(task, failed=f"{address}: a worker cannot import this rhw: {_line(error)}")
    if type(error).__name__ == "KilledWorker":
        return Done(task, broken=f"{task.path}: several workers died of it")
    return Done(task, failed=f"{address}: a worker says: {_line(error)}")


def _line(error: BaseException) -> str:
    return " ".join(str(error).split()) or type(error).__name__
