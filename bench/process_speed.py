#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Milliseconds from a file to a picture of 1280 by 720 with 4 samples: rhw and F3D as whole processes, by turns.

usage: bench/process_speed.py [--rounds N] [--threads N] PROGRAM... -- MODEL...

A PROGRAM is a path of rhw, or f3d. The wall time is the median and the processor time the least of the rounds. A program
that is not there has a line that says so.
"""

import argparse
import os
import pathlib
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
import time


def command(program, model, picture, threads):
    if pathlib.Path(program).name.startswith("f3d"):
        return [program, model, f"--output={picture}", "--resolution=1280,720", "--anti-aliasing"]
    return [program, "render", model, "-o", picture, "--size=1280x720", "--samples=4", f"--threads={threads}", "--quiet"]


def run(arguments):
    """Wall and processor time in seconds, or None where it failed."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    status = subprocess.run(arguments, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode
    wall, after = time.perf_counter() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    used = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return (wall, used) if status == 0 else None


parser = argparse.ArgumentParser(usage=__doc__.split("usage: ")[1].split("\n")[0])
parser.add_argument("--rounds", type=int, default=9)
parser.add_argument("--threads", type=int, default=os.cpu_count())
split = sys.argv.index("--") if "--" in sys.argv else len(sys.argv)
options, programs = parser.parse_known_args(sys.argv[1:split])
models = sys.argv[split + 1:]
if not programs or not models:
    parser.error("needs programs and models")

found = [program for program in programs if shutil.which(program)]
for program in programs:
    if program not in found:
        print(f"{program}: is not installed, left out")
with tempfile.TemporaryDirectory() as folder:
    picture = str(pathlib.Path(folder, "picture.png"))
    for model in models:
        times = {program: [] for program in found}
        for _ in range(options.rounds):
            for program in found:
                times[program].append(run(command(program, model, picture, options.threads)))
        for program in found:
            if None in times[program]:
                print(f"{pathlib.Path(model).name}: {program} failed")
                continue
            wall = statistics.median(wall for wall, _ in times[program]) * 1e3
            used = min(used for _, used in times[program]) * 1e3
            print(f"{pathlib.Path(model).name}: {program} {wall:.0f} ms, of processors {used:.0f} ms")
