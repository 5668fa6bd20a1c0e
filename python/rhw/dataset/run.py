# SPDX-License-Identifier: MIT
"""From a plan to a data set: what is not finished, or has changed since, is drawn, and when everything is there the manifest
is written.
"""

from __future__ import annotations

import concurrent.futures
import contextlib
import os
import secrets
from dataclasses import dataclass
from typing import Dict, Generator, Iterator, List, Optional, Tuple

from . import cluster, local, manifest, plan as plans, store
from .errors import Failure
from .plan import Plan
from .progress import Progress
from .work import Done, Task


@dataclass(frozen=True)
class How:
    """How it is done; nothing that is written depends on it, but for `strict` and `skip_failed`.

    threads: that draw, or with a scheduler those of each picture. shard: (number, count), from 1 on.
    """

    threads: int
    shard: Optional[Tuple[int, int]] = None
    scheduler: Optional[str] = None
    strict: bool = False
    skip_failed: bool = False
    quiet: bool = False


def make(folder: str, asked: Plan, how: How) -> int:
    """Makes a data set or goes on with it; the exit status."""
    folder = os.path.abspath(folder)
    plan = plans.begin(folder, asked)
    part = plans.shard(plan, *how.shard) if how.shard else list(plan.all_views())
    pending, changed = _pending(folder, plan, part, how.threads)
    paths = [os.path.abspath(path) for _, path in asked.models]
    lit_by = os.path.abspath(asked.light.path) if asked.light else None
    tasks = _tasks(folder, pending, paths, lit_by, how)
    progress = Progress(sum(len(task.views) for task in tasks), how.quiet)
    for path in changed:
        progress.warn(f"{path}: is not what was drawn, and is drawn again")
    drawn, broken = _draw(tasks, progress, how)
    progress.clear()
    if broken and not how.skip_failed:
        raise Failure(f"{folder}: {len(broken)} of {_count(len(plan.models), 'model')} cannot be drawn: mend what is said "
                      "above and start again, or leave them out by --skip-failed")
    written = "" if how.shard else manifest.write(folder, plan, paths, broken)
    if not how.quiet:
        what = f"shard {how.shard[0]}/{how.shard[1]}: " if how.shard else ""
        views, models = _count(len(part), "view"), _count(len({model for model, _ in part}), "model")
        print(f"{folder}: {what}{views} of {models}, {drawn} drawn now{written}", flush=True)
    return 0


def _count(number: int, what: str) -> str:
    return f"{number} {what}" if number == 1 else f"{number} {what}s"


def _pending(folder: str, plan: Plan, part: List[Tuple[int, int]], threads: int) -> Tuple[Dict[int, List[int]], List[str]]:
    """By the numbers of models, the views of that part which are not finished or have changed; and the files that have."""
    pending: Dict[int, List[int]] = {}
    changed: List[str] = []
    listed, there = -1, set()  # type: int, set[str]
    finished: List[bool] = []
    for model, view in part:
        if model != listed:
            listed, there = model, store.listing(folder, plan.models[model][0])
        files, record = plan.names(view)
        finished.append(there.issuperset([record, *files]))
    for (model, view), is_finished, faults in zip(part, finished, _faults(folder, plan, part, finished, threads)):
        changed += faults
        if faults or not is_finished:
            pending.setdefault(model, []).append(view)
    return pending, changed


def _faults(folder: str, plan: Plan, part: List[Tuple[int, int]], finished: List[bool], threads: int) -> Iterator[List[str]]:
    """Of each view the files that have changed. Hashes are most of the work, for which threads need no lock."""
    pool = concurrent.futures.ThreadPoolExecutor(threads)

    def look(of_view: Tuple[int, int], is_finished: bool) -> List[str]:
        model, view = of_view
        return store.changed(folder, plan.models[model][0], plan.names(view)) if is_finished else []

    portion = 1024  # views that are given out at a time, of millions
    try:
        for start in range(0, len(part), portion):
            some = slice(start, start + portion)
            yield from pool.map(look, part[some], finished[some])
    finally:
        pool.shutdown(cancel_futures=True)


def _tasks(folder: str, pending: Dict[int, List[int]], paths: List[str], lit_by: Optional[str], how: How) -> List[Task]:
    run, count = secrets.token_hex(8), sum(map(len, pending.values()))
    threads = how.threads if how.scheduler else local.share(how.threads)[1]
    tasks = []
    for model, views in pending.items():
        portions = cluster.group(views, count) if how.scheduler else [[view] for view in views]
        tasks += [Task(run, folder, model, paths[model], tuple(portion), threads, how.strict, lit_by) for portion in portions]
    return tasks


def _draw(tasks: List[Task], progress: Progress, how: How) -> Tuple[int, Dict[int, str]]:
    """How many views were drawn, and the models that cannot be."""
    drawn, told, broken = 0, set(), {}  # type: int, set[int], Dict[int, str]
    progress.show()
    with contextlib.closing(_done(tasks, how)) as results:
        for done in results:
            if done.failed:
                progress.clear()
                raise Failure(f"{done.failed}; the same command goes on from here")
            drawn += done.drawn
            number = done.task.model
            if done.broken and number not in broken:
                broken[number] = done.broken
                progress.fail(done.broken)
            for warning in done.warnings if number not in told else ():
                progress.warn(f"{done.task.path}: {warning}")
            told.add(number)
            progress.add(len(done.task.views))
    return drawn, broken


def _done(tasks: List[Task], how: How) -> Generator[Done, None, None]:
    if tasks and how.scheduler:
        yield from cluster.draw_all(tasks, how.scheduler)
    else:
        yield from local.draw_all(tasks, local.share(how.threads)[0])
