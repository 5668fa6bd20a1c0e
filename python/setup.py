# SPDX-License-Identifier: MIT
"""Builds the package: CMake makes the extension, and the libraries that it needs beyond libc are taken along.

Most of those libraries come as shared objects alone, so they cannot be linked into the extension. They go into
rhw/lib, where the extension's RPATH finds them, and the wheel then runs wherever the libc is as new as that of the
machine that built it. The environment variable RHW_BUILD_DIR names a CMake build of the checkout to build in, instead
of one of its own.
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext
from wheel.bdist_wheel import bdist_wheel

ROOT = Path(__file__).resolve().parent.parent
#: What every Linux with glibc and a C++ program has.
SYSTEM = re.compile(r"(ld-linux.*|linux-vdso|libc|libm|libdl|librt|libpthread|libstdc\+\+|libgcc_s)\.so\b.*")


def version() -> str:
    text = (ROOT / "include/rhw/base.h").read_text()
    return ".".join(re.findall(r"RHW_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)", text))


def libraries(extension: Path) -> dict:
    """Paths of the shared libraries that the extension and they themselves need, by their names."""
    environment = {key: value for key, value in os.environ.items() if key != "LD_LIBRARY_PATH"}
    lines = subprocess.run(["ldd", extension], check=True, capture_output=True, text=True, env=environment).stdout
    found = {}
    for line in lines.splitlines():
        name, _, place = line.strip().partition(" => ")
        if SYSTEM.fullmatch(os.path.basename(name.split(" ")[0])):
            continue
        if not place.startswith("/"):
            raise SystemExit(f"setup.py: {extension.name} needs {name}, which is not installed")
        found[name] = Path(place.rsplit(" (", 1)[0])
    return found


def copyright_of(library: Path) -> "Path | None":
    """Debian's file about the licence of a library, where dpkg knows it."""
    for path in (library, library.resolve()):
        for place in (path, Path("/usr") / path.relative_to("/")):
            asked = subprocess.run(["dpkg-query", "-S", place], capture_output=True, text=True)
            if asked.returncode == 0:
                return Path("/usr/share/doc") / asked.stdout.split(":")[0] / "copyright"
    return None


def static_libraries(build: Path) -> list:
    """Paths of the archives that the extension has inside, as CMake found them."""
    found = re.findall(r"^\w[^\n=]*:FILEPATH=(/[^\n]*\.a)$", (build / "CMakeCache.txt").read_text(), re.M)
    return [Path(path) for path in found]


class BuildExtension(build_ext):
    def build_extension(self, ext: Extension) -> None:
        target = Path(self.get_ext_fullpath(ext.name))
        build = Path(os.environ.get("RHW_BUILD_DIR") or Path(self.build_temp).resolve() / "cmake")
        if not (build / "CMakeCache.txt").exists():
            generator = ["-G", "Ninja"] if shutil.which("ninja") else []
            subprocess.run(["cmake", "-S", ROOT, "-B", build, *generator, "-DCMAKE_BUILD_TYPE=Release",
                            "-DRHW_PYTHON=ON", "-DRHW_PROGRAM=OFF", "-DRHW_EXAMPLES=OFF", "-DRHW_INSTALL=OFF",
                            f"-DPython3_EXECUTABLE={sys.executable}"], check=True)
        subprocess.run(["cmake", "--build", build, "--target", "rhw_python", "--parallel", str(os.cpu_count())],
                       check=True)
        built = build / "python/rhw/_rhw.abi3.so"
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(built, target)
        self.take_along(built, target.parent / "lib")
        for path in static_libraries(build):
            terms = copyright_of(path)
            if terms and terms.exists():
                shutil.copy(terms, target.parent / "lib" / f"{terms.parent.name}.copyright")

    def take_along(self, extension: Path, folder: Path) -> None:
        folder.mkdir(exist_ok=True)
        for name, path in libraries(extension).items():
            shutil.copy(path, folder / name)
            terms = copyright_of(path)
            if terms and terms.exists():
                shutil.copy(terms, folder / f"{name}.copyright")


class BuildWheel(bdist_wheel):
    def get_tag(self):
        """The libc that was linked with is the oldest that will do (PEP 600)."""
        python, abi, machine = super().get_tag()
        libc, _, number = (os.confstr("CS_GNU_LIBC_VERSION") or "").partition(" ")
        if libc == "glibc" and machine.startswith("linux_"):
            major, minor = number.split(".")[:2]
            machine = machine.replace("linux_", f"manylinux_{major}_{minor}_", 1)
        return python, abi, machine


setup(
    version=version(),
    ext_modules=[Extension("rhw._rhw", sources=[], py_limited_api=True)],
    cmdclass={"build_ext": BuildExtension, "bdist_wheel": BuildWheel},
    options={"bdist_wheel": {"py_limited_api": "cp39"}},
)
