# SPDX-License-Identifier: MIT
"""The fast tests of a build, and which mutants each of them comes past."""
import json
import os
import resource
import subprocess
import threading
import time
from dataclasses import dataclass, field

MOST = 65536  # as MUTANTS_MOST in mutant.h
MEMORY = 12 << 30  # bytes that a process may map: a mutant may ask for all there is
LEAST = 10  # seconds that a test of a mutant gets, however short it is without one
# What cannot be told from the exit status of one command.
NOT_ALONE = {"DEPENDS", "FIXTURES_REQUIRED", "PASS_REGULAR_EXPRESSION", "WILL_FAIL"}


@dataclass
class Test:
    name: str
    command: list
    folder: str
    environment: dict
    skips: int  # exit status of a test that does not run here; None: it has none
    seconds: float = 0
    reached: set = field(default_factory=set)
    lock: threading.Lock = field(default_factory=threading.Lock)

    def run(self, most, **environment):
        """The exit status; None after `most` seconds. A test never runs twice at a time, as it may write files."""
        values = {**os.environ, **self.environment, **environment}
        limit = lambda: (resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY)), resource.setrlimit(resource.RLIMIT_CORE, (0, 0)))
        with self.lock, subprocess.Popen(self.command, cwd=self.folder, env=values, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                         stderr=subprocess.DEVNULL, preexec_fn=limit, start_new_session=True) as process:
            try:
                return process.wait(most)
            except subprocess.TimeoutExpired:
                return None
            finally:
                try:
                    os.killpg(process.pid, 9)
                except ProcessLookupError:
                    pass


def tests_of(build, pattern, labels_without):
    """The tests of ctest in a build with the pattern in their names, without those of the labels or of several commands."""
    told = subprocess.run(["ctest", "--test-dir", build, "-R", pattern, "--show-only=json-v1"], check=True, capture_output=True, text=True)
    tests = []
    for entry in json.loads(told.stdout)["tests"]:
        of = {one["name"]: one["value"] for one in entry["properties"]}
        if NOT_ALONE & set(of) or labels_without & set(of.get("LABELS", [])) or "command" not in entry:
            continue
        environment = dict(line.split("=", 1) for line in of.get("ENVIRONMENT", []))
        tests.append(Test(entry["name"], entry["command"], of["WORKING_DIRECTORY"], environment, of.get("SKIP_RETURN_CODE")))
    return tests


def look(tests, most, reached_file):
    """Runs each test as it is. Returns those that pass within `most` seconds, the fastest first, with what they reach, and the
    names of those that take longer, and of those that fail."""
    good, slow, failed = [], [], []
    for test in tests:
        reached_file.write_bytes(bytes(MOST))
        start = time.monotonic()
        status = test.run(most, RHW_MUTANTS_REACHED=str(reached_file))
        test.seconds = time.monotonic() - start
        if status == 0:
            test.reached = {number for number, byte in enumerate(reached_file.read_bytes()) if byte}
            good.append(test)
        elif status is None:
            slow.append(test.name)
        elif status != test.skips:
            failed.append(test.name)
    return sorted(good, key=lambda test: test.seconds), slow, failed


def notice(tests, number, most):
    """The first test that fails with mutant `number`, how many tests of those that reach it ran in `most` seconds, and how many
    of these took too long with the mutant and without it, so that they tell nothing."""
    start, ran, busy = time.monotonic(), 0, 0
    for test in tests:
        if number not in test.reached:
            continue
        if ran and time.monotonic() - start + test.seconds > most:
            break
        ran += 1
        limit = LEAST + 10 * test.seconds
        status = test.run(limit, RHW_MUTANT=str(number))
        if status is None and test.run(limit) is None:
            busy += 1
        elif status != 0:
            return test.name, ran, busy
    return None, ran, busy
