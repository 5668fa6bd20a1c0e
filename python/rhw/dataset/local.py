# SPDX-License-Identifier: MIT
"""Draws on this machine: some views at once, each in a context of its own.

Small pictures have too few tiles for many cores, and files are encoded by one; so threads draw a view each. At most eight,
since each holds the model in memory: beyond, cores are shared out among them.
"""

from __future__ import annotations

import os
import queue
import threading
from typing import Generator, List, Sequence, Tuple, Union

from .work import Done, Task, draw

_MOST_VIEWS = 8


def cores() -> int:
    """Those that the process may use."""
    return min(len(os.sched_getaffinity(0)), 64)


def share(threads: int) -> Tuple[int, int]:
    """How many views are drawn at once, and by how many threads each."""
    views = min(threads, _MOST_VIEWS)
    return views, (threads + views // 2) // views


def draw_all(tasks: Sequence[Task], at_once: int) -> Generator[Done, None, None]:
    """Does the tasks in about their order. Where it is closed or one raises, it waits for those under way."""
    waiting: "queue.SimpleQueue[Task]" = queue.SimpleQueue()
    done: "queue.SimpleQueue[Union[Done, BaseException]]" = queue.SimpleQueue()
    for task in tasks:
        waiting.put(task)
    stopped = threading.Event()

    def work() -> None:
        try:
            while not stopped.is_set():
                done.put(draw(waiting.get_nowait()))
        except queue.Empty:
            pass
        except BaseException as error:
            done.put(error)

    workers: List[threading.Thread] = [threading.Thread(target=work, daemon=True) for _ in range(at_once)]
    for worker in workers:
        worker.start()
    try:
        for _ in tasks:
            found = done.get()
            if isinstance(found, BaseException):
                raise found
            yield found
    except KeyboardInterrupt:  # ends the process, which waits for nobody
        raise
    except BaseException:
        stopped.set()
        for worker in workers:
            worker.join()
        raise
