#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The commands of the documents, run as their readers run them: those in the ```sh blocks of every page, in one shell
per page, and the EXAMPLES of rhw(1) and rhw(3). Each must end with status 0, or with the one that its comment names,
and leave the files behind that it names. docs/gallery.md has a test of its own, program_gallery.

usage: test_commands.py BUILD_FOLDER SOURCE_ROOT [quick|slow]

slow is the pages of SLOW, quick all others; without either it is all pages.

A page's shell starts in something like a checkout after script/build: what may be written to is a copy, the rest are
links, build and build-test/release are the build under test, and HOME is empty.
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

PAGES = ["*.md", "docs/*.md", "*/README.md"]

# Pages whose commands take seconds: they compile, make an environment of Python, or draw what other tests draw.
SLOW = {"CONTRIBUTING.md", "docs/embedding.md", "docs/python.md"}

# Commands that are not run here, as regular expressions of a whole command, and why.
BUILDS = "builds what is under test here"
MINUTES = "takes minutes, and is about times or chance"
ELSEWHERE = "needs compilers for other machines"
ONE_FILE = "half a minute; program_amalgamation does it"
SANITIZED = "builds the library anew; program_embedding does it in script/test thread"
NOT_RUN = {
    r"(script/bootstrap vulkan && )?script/build( --target rhw_vulkan)?": BUILDS,
    r"script/demo": BUILDS,
    r"(CTEST_ARGS='.*' )?script/test(-long)?( \w+)?": "runs this test",
    r"script/bench": MINUTES,
    r"script/isas": MINUTES,
    r"script/peer COMMAND": "fetches packages; program_bench runs it without a network",
    r"script/bench-vulkan.*": MINUTES,
    r"(script/peer )?script/vulkan-clients.*": "installs packages of the npm registry",
    r"script/growth": MINUTES,
    r"script/instructions( .*)?": MINUTES,
    r"script/fuzz \d+": MINUTES,
    r"script/coverage": MINUTES,
    r"script/mutate .*": MINUTES,
    r"script/determinism( .*)?": ELSEWHERE,
    r"script/windows( .*)?": ELSEWHERE,
    r"script/web": ELSEWHERE,
    r"script/web-test": ELSEWHERE,
    r"script/format": "writes into the sources; script/test has --check",
    r"script/completions build/rhw": "writes into the sources; program_documents compares",
    r"script/gallery": "writes into the sources; program_gallery compares",
    r"script/window": "writes into the sources; program_view looks at a window",
    r"script/losses": "writes into the sources; python_long compares",
    r"script/notebook": "writes into the sources; python_long compares",
    r".*/golden tests/golden/scenes\.txt --update": "half a minute; the test golden draws the same scenes",
    r"build/rhw view .*": "opens a window; program_view looks at one",
    r"script/package": "program_package does it",
    r"env/bin/pip install --no-build-isolation \./python( *#.*)?": "compiles the library; python_wheel installs one",
    r"python -m rhw\.dataset .*": "python_dataset runs them from the page",
    r"dask-(scheduler|worker) .*": "ends when it is told to; python_dataset starts some",
    r"script/bootstrap python && .* && env/bin/pip install .*": "the same; docs/python.md has it in pieces",
    r"env/bin/python python/examples/\w+\.py .*": "python_long and python_learning run the examples",
    r"dpkg -i .*": "program_package installs into a root of its own",
    r"cc -O2 -pthread -c rhw\.c": ONE_FILE,
    r"cc -O2 -pthread -ffp-contract=off program\.c rhw\.o": ONE_FILE,
    r"cmake -S rhw .*-DRHW_SANITIZE=thread.*": SANITIZED,
    r"cmake --build build-thread .*": SANITIZED,
    r"export PKG_CONFIG_PATH=~/rhw-thread/.*": SANITIZED,
    r"make -B .*=thread\" threads": SANITIZED,
}

# What the pages leave to their reader, or a test need not wait for: expressions in a command, and what takes their place.
GIVEN = {
    r"^script/build && ": "",
    r"\bMODEL\b": "/usr/share/glmark2/models/bunny.obj",
    r"\b(DIR|OUT)\b": "folder",
    r"\bwaves\.frag\b": "examples/disc.frag",
    r"\bsum\.comp\b": "tests/unit/spirv/glsl/values.comp",
    r"out/recipes/window": "SDL_VIDEODRIVER=dummy out/recipes/window --frames 2",
    r"^make -B": "make -C examples/embedding -B",
    r"bench --scene fill": "bench --frames 1 --size 160x90 --peer none --scene fill_flat",
    r"bench --peer (interpreter|machine|emitted)": r"bench --frames 1 --size 160x90 --scene fill_flat --peer \1",
    r"bench --save": "bench --frames 1 --size 160x90 --peer none --scene fill_flat --save",
}

# Without these it is skipped.
NEEDED = ["cmake", "make", "pkg-config", "cc", "c++", "/usr/share/assimp/models", "/usr/share/glmark2/models"]

FILE_NAMED = re.compile(r"(?:-o|--out|--difference|--picture|--show \w+|-B) ([a-z][\w./-]*)")
STATUS_NAMED = re.compile(r"#.*\bexit status (\d):")
OUTSIDE = re.compile(r"^ {4}(?:script/|build/|build-test/|rhw |cc |cmake |make |\./)|That is `rhw", re.M)

failures = []


def fail(message):
    failures.append(message)
    print(f"FAILED: {message}", file=sys.stderr)


class Command:
    def __init__(self, page, text):
        self.page, self.typed = page, text
        status = STATUS_NAMED.search(text)
        self.status = int(status.group(1)) if status else 0
        self.text = re.sub(r"(^|\s+)#.*$", "", text)
        self.starts = False  # a block, or what is run of it

    def __str__(self):
        return f"{self.page}: {self.typed}"


def blocks_of(text):
    """Language and lines of each block of a page."""
    return re.findall(r"^```(\w*)\n(.*?)^```$", text, re.M | re.S)


def commands_of(page, text):
    """Those of the blocks for a shell, a line each unless it ends in a backslash."""
    found = []
    for language, block in blocks_of(text):
        commands = [Command(page, line) for line in block.replace("\\\n", "").splitlines() if language == "sh"]
        for command in commands:
            command.starts = command is commands[0]
        found += commands
    return found


def examples_of(page, manual):
    """The commands of a manual page's EXAMPLES."""
    section = re.search(r"^\.SH EXAMPLES\n.*?^\.nf\n(.*?)^\.fi", manual, re.M | re.S).group(1)
    return [Command(page, line.replace("\\-", "-")) for line in section.splitlines()]


def to_run(commands, used):
    """The commands without those of NOT_RUN, with what GIVEN says; adds what was needed to `used`."""
    kept, starts = [], False
    for command in commands:
        starts = starts or command.starts
        skipped = [rule for rule in NOT_RUN if re.fullmatch(rule, command.text)]
        used.update(skipped)
        if skipped or not command.text:
            continue
        command.starts, starts = starts, False
        for rule, given in GIVEN.items():
            command.text, count = re.subn(rule, given, command.text)
            used.update([rule] if count else [])
        kept.append(command)
    return kept


def make_checkout(folder, root, build):
    copied = {"examples", "build", "build-test", ".git", "out"}
    for entry in root.iterdir():
        if entry.name not in copied and not entry.name.startswith("build"):
            (folder / entry.name).symlink_to(entry)
    shutil.copytree(root / "examples", folder / "examples")
    (folder / "tests").unlink()
    shutil.copytree(root / "tests" / "golden", folder / "tests" / "golden")
    (folder / "tests" / "unit").symlink_to(root / "tests" / "unit")
    (folder / "build").symlink_to(build)
    (folder / "build-test").mkdir()
    (folder / "build-test" / "release").symlink_to(build)
    (folder / "folder").mkdir()
    shutil.copy(root / "examples" / "00_hello.c", folder / "program.c")


def give_models(folder):
    """The files that the manual page names."""
    models = Path("/usr/share")
    for name, file in {"bunny.obj": models / "glmark2/models/bunny.obj",
                       "part.stl": models / "assimp/models/STL/Wuson.stl",
                       "scene.glb": models / "assimp/models/glTF2/BoxTextured-glTF-Binary/BoxTextured.glb",
                       "expected.png": folder / "examples/00_hello.png",
                       "actual.png": folder / "examples/00_hello.png",
                       "models": models / "glmark2/models"}.items():
        (folder / name).symlink_to(file)


def run(commands, folder):
    """Runs them in one shell, which says on descriptor 3 what each ended with; returns all that they said."""
    (folder / "home").mkdir()
    (folder / "bin").mkdir()
    (folder / "bin" / "rhw").symlink_to(folder / "build" / "rhw")
    unwanted = {"CMAKE_PREFIX_PATH", "PKG_CONFIG_PATH", "MAKEFLAGS", "MAKELEVEL", "CFLAGS", "CXXFLAGS", "LDFLAGS"}
    environment = {name: value for name, value in os.environ.items() if name not in unwanted}
    environment.update(HOME=str(folder / "home"), PATH=f"{folder}/bin:{os.environ['PATH']}")
    back = f"cd '{folder}'\n"  # where a block begins its reader is in the checkout again
    script = "".join(f"{back * command.starts}{{ {command.text}\n}} >'{folder}/said.{i}' 2>&1 </dev/null\necho $? >&3\n"
                     for i, command in enumerate(commands))
    with open(folder / "statuses", "w", encoding="utf-8") as statuses:
        subprocess.run(["sh", "-c", f"exec 3>&{statuses.fileno()}\n{script}"], cwd=folder, env=environment,
                       pass_fds=[statuses.fileno()], check=False)
    ended = (folder / "statuses").read_text(encoding="utf-8").split()
    output = ""
    for i, command in enumerate(commands):
        if i >= len(ended):
            fail(f"{command}: was not run, as the shell had ended")
            continue
        said = (folder / f"said.{i}").read_text(encoding="utf-8", errors="replace")
        output += said
        if int(ended[i]) != command.status:
            fail(f"{command}: status {ended[i]}, not {command.status}\n{said[-1500:]}")
        for name in FILE_NAMED.findall(command.text):
            if not (folder / name).exists():
                fail(f"{command}: there is no {name}")
    return output


def run_page(page, commands, text, root, build):
    """Runs a page's commands; what its blocks without a language quote is what they say."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        make_checkout(folder, root, build)
        give_models(folder)
        started = time.monotonic()
        output = run(commands, folder)
        print(f"{time.monotonic() - started:6.1f} s  {len(commands)} commands of {page}", flush=True)
    for line in "".join(block for language, block in blocks_of(text) if not language).splitlines():
        if line not in output:
            fail(f"{page}: no command says: {line}")


def main():
    for name in NEEDED:
        if not shutil.which(name) and not Path(name).is_dir():
            print(f"no {name} here")
            return 77
    build, root = (Path(argument).resolve() for argument in sys.argv[1:3])
    part = sys.argv[3] if len(sys.argv) > 3 else None
    found = {str(page.relative_to(root)) for pattern in PAGES for page in root.glob(pattern)} - {"docs/gallery.md"}
    texts = {page: (root / page).read_text(encoding="utf-8") for page in sorted(found)}
    used, todo = set(), {}
    for page, text in texts.items():
        if stray := OUTSIDE.search(text):
            fail(f"{page}: a command outside of the sh blocks: {stray.group()}")
        todo[page] = to_run(commands_of(page, text), used)
    for manual in ("docs/rhw.1", "docs/rhw.3"):
        texts[manual] = (root / manual).read_text(encoding="utf-8")
        todo[manual] = to_run(examples_of(manual, texts[manual]), used)
    todo["docs/embedding.md"] += todo.pop("docs/rhw.3")  # where the library is installed
    if part:
        assert part in ("quick", "slow"), part
        todo = {page: commands for page, commands in todo.items() if (page in SLOW) == (part == "slow")}
    for page, commands in todo.items():
        if commands:
            run_page(page, commands, texts[page], root, build)
    for page in SLOW - set(texts):
        fail(f"there is no page {page}")
    for rule in [*NOT_RUN, *GIVEN]:
        if rule not in used:
            fail(f"no command is meant by the rule {rule}")
    print(f"{sum(map(len, todo.values()))} commands, {len(failures)} failures")
    return bool(failures)


if __name__ == "__main__":
    sys.exit(main())
