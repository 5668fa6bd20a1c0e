# SPDX-License-Identifier: MIT
"""Makes small changes of meaning in a copy of the sources, and tells which of them no fast test notices.

Every change is a mutant behind a switch that a program reads at its start, so that one build serves all of them. A mutant is
one of these: a comparison with another one, + and − exchanged, a constant that is one more, half of a condition dropped, a
check that never holds, a statement dropped. Each is tried with the tests that come past it, the fastest first.
"""
import argparse
import csv
import os
import random
import re
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import c_places
import python_places
import suite

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
ROOMS = ["src", "scene", "tools", "python/rhw", "python/src", "system"]
ENDINGS = (".c", ".h", ".cc", ".py")
LABELS_WITHOUT = {"long", "exact", "times"}


def files_of(paths):
    """The sources below the paths, as git knows them, relative to the root."""
    told = subprocess.run(["git", "-C", ROOT, "ls-files", "--", *paths], check=True, capture_output=True, text=True)
    return [name for name in told.stdout.splitlines() if name.endswith(ENDINGS)]


def copy_sources(source):
    """Copies the files that git knows, where they differ, so that a second build is short."""
    told = subprocess.run(["git", "-C", ROOT, "ls-files"], check=True, capture_output=True, text=True)
    for name in told.stdout.splitlines():
        old, new = ROOT / name, source / name
        if old.is_file() and not (new.is_file() and new.read_bytes() == old.read_bytes()):
            new.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(old, new)  # with a time of now, so that it is built again


def configure(source, build):
    flags = f"-include {HERE / 'mutant.h'}"
    subprocess.run(["cmake", "-G", "Ninja", "-S", source, "-B", build, "-DCMAKE_BUILD_TYPE=Release", "-DRHW_TESTS=ON", "-DRHW_PYTHON=ON",
                    "-DRHW_WERROR=OFF", "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON", "-DPython3_EXECUTABLE=/usr/bin/python3",
                    f"-DCMAKE_C_FLAGS={flags}", f"-DCMAKE_CXX_FLAGS={flags}"], check=True, stdout=subprocess.DEVNULL)


def all_places(sources, name):
    return python_places.places(sources.root, name) if name.endswith(".py") else c_places.places(sources, name)


def pick(sources, names, count, seed):
    """`count` places: a file by its size, a kind of change, and a place of that kind, none within another."""
    choose = random.Random(seed)
    sizes = [(sources.root / name).stat().st_size for name in names]
    found, chosen = {}, {}
    for _ in range(20 * count):
        if sum(map(len, chosen.values())) == count:
            break
        name = choose.choices(names, sizes)[0]
        if name not in found:
            found[name] = all_places(sources, name)
        kinds = sorted({place.kind for place in found[name]})
        if kinds:
            kind = choose.choice(kinds)
            place = choose.choice([place for place in found[name] if place.kind == kind])
            others = chosen.setdefault(name, [])
            if all(place.end <= other.start or place.start >= other.end for other in others):
                others.append(place)
    return [place for places in chosen.values() for place in places]


def write(source, places):
    """Writes the mutants into the copy of the sources, and numbers them from 1 on."""
    by_file = {}
    for number, place in enumerate(places, 1):
        place.number = number
        by_file.setdefault(place.file, []).append(place)
    for name, mutants in by_file.items():
        text = (ROOT / name).read_bytes()
        for place in sorted(mutants, key=lambda place: -place.start):
            mutated = place.mutated.replace("{on}", f"mutant({place.number})")
            text = text[: place.start] + mutated.encode() + text[place.end:]
        if name.endswith(".py"):
            text = python_places.imports(text.decode(), HERE).encode()
        (source / name).write_bytes(text)
    return by_file


def build_all(source, build, places):
    """Builds, and drops mutants that do not compile. Returns those that do."""
    while True:
        by_file = write(source, places)
        done = subprocess.run(["cmake", "--build", build, "--", "-k", "0"], capture_output=True, text=True)
        if done.returncode == 0:
            return places
        wrong = set()
        for name, line in re.findall(r"^(\S+?):(\d+):\d+: (?:fatal )?error:", done.stdout, re.M):
            name = os.path.relpath(Path(build, name).resolve(), source)
            wrong |= {(place.file, place.start) for place in by_file.get(name, []) if place.line <= int(line) <= place.line + 12}
        kept = [place for place in places if (place.file, place.start) not in wrong]
        if len(kept) == len(places):
            sys.exit(f"script/mutate: the copy does not build:\n{done.stdout[-3000:]}")
        for name in by_file:
            shutil.copy(ROOT / name, source / name)
        places = kept


def read_saved(path, sources):
    """The survivors of a file that --save wrote, where their lines stand today."""
    places = []
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            if row["noticed by"]:
                continue
            alike = [place for place in all_places(sources, row["file"]) if (place.kind, place.told) == (row["kind"], row["change"])]
            if not alike:
                print(f"{row['file']}:{row['line']}: {row['kind']}: {row['change']}: is not there any more")
                continue
            places.append(min(alike, key=lambda place: abs(place.line - int(row["line"]))))
    return places


def parse():
    parser = argparse.ArgumentParser(prog="script/mutate", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("paths", nargs="*", metavar="PATH", help="files or folders, FILE:LINE for all places of a line; without one: " + " ".join(ROOMS))
    parser.add_argument("--count", type=int, default=60, help="how many mutants (default %(default)s)")
    parser.add_argument("--seed", type=int, default=1, help="which ones (default %(default)s)")
    parser.add_argument("--tests", metavar="REGEX", default="", help="take tests alone in whose name this is found")
    parser.add_argument("--test-seconds", type=float, default=30, help="tests that take longer are left out (default %(default)s)")
    parser.add_argument("--seconds", type=float, default=240, help="time that the tests of a mutant get (default %(default)s)")
    parser.add_argument("--list", action="store_true", help="tell the places alone")
    parser.add_argument("--save", metavar="FILE", help="write a row for each mutant as CSV")
    parser.add_argument("--again", metavar="FILE", help="take what survived in FILE, which --save wrote")
    return parser.parse_args()


def choose_places(options, sources):
    if options.again:
        return read_saved(options.again, sources)
    lines = [path.rsplit(":", 1) for path in options.paths if re.search(r":\d+$", path)]
    if lines:
        return [place for name, line in lines for place in all_places(sources, name) if place.line == int(line)]
    names = files_of(options.paths or ROOMS)
    if not names:
        sys.exit("script/mutate: there is no source of C or Python")
    return pick(sources, names, options.count, options.seed)


def without_overlap(places):
    """The places, in rounds in each of which none lies within another."""
    rounds = []
    for place in places:
        for one in rounds:
            if all(place.file != other.file or place.end <= other.start or place.start >= other.end for other in one):
                one.append(place)
                break
        else:
            rounds.append([place])
    return rounds


def tell_tests(tests, slow, failed, most):
    """Tells how many tests there are, and which are left out and why. Without any it ends the script."""
    load = f"{os.getloadavg()[0]:.0f} programs run on {os.cpu_count()} cores"
    lines = [f"{len(slow)} take longer than {most:g} s ({load}; --test-seconds allows more): {' '.join(slow)}"] if slow else []
    lines += [f"{len(failed)} fail without a mutant: {' '.join(failed)}"] if failed else []
    if not tests:
        sys.exit("\n".join(["script/mutate: no test can be used", *(lines or ["none has such a name"])]))
    print(f"{len(tests)} tests that pass in time", *lines, sep="\n", flush=True)


def run_round(options, source, build, places, folder):
    """The rows of a round: a place, the test that noticed it or None, how many tests ran, how many reach it and how many of them
    the machine was too busy for."""
    copy_sources(source)  # without the mutants of the round before
    places = build_all(source, build, places)
    print(f"{len(places)} mutants", flush=True)
    told = suite.look(suite.tests_of(build, options.tests, LABELS_WITHOUT), options.test_seconds, folder / "reached")
    tests = told[0]
    tell_tests(*told, options.test_seconds)

    def try_one(place):
        noticed, ran, busy = suite.notice(tests, place.number, options.seconds)
        reaching = sum(place.number in test.reached for test in tests)
        if not noticed:
            print(f"{place} ({ran} of {reaching} tests{f', {busy} of them timed out without it too' if busy else ''})", flush=True)
        return place, noticed, ran, reaching, busy

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        return list(pool.map(try_one, places))


def save(path, rows):
    with open(path, "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["file", "line", "kind", "change", "noticed by", "tests run", "tests that reach it", "timed out without it too"])
        for place, noticed, ran, reaching, busy in rows:
            writer.writerow([place.file, place.line, place.kind, place.told, noticed or "", ran, reaching, busy])


def main():
    options = parse()
    folder = ROOT / "build" / "mutation"
    source, build = folder / "source", folder / "build"
    source.mkdir(parents=True, exist_ok=True)
    copy_sources(source)
    configure(source, build)
    places = choose_places(options, c_places.Sources(source, build))
    if options.list:
        print(*places, sep="\n")
        return
    rows = [row for one in without_overlap(places) for row in run_round(options, source, build, one, folder)]
    if options.save:
        save(options.save, rows)
    noticed = sum(row[1] is not None for row in rows)
    print(f"{noticed} of {len(rows)} noticed, {sum(row[3] == 0 for row in rows)} that no test reaches")
    busy = sum(row[1] is None and row[4] > 0 for row in rows)
    if busy:
        print(f"{busy} for which the machine was too busy to tell: try them by --again {options.save or 'FILE, which --save FILE writes'}")


if __name__ == "__main__":
    main()
