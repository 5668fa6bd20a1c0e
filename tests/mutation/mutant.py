# SPDX-License-Identifier: MIT
"""The switch of mutants in Python modules; mutant.h describes it."""
import mmap
import os

_on = int(os.environ.get("RHW_MUTANT", "0"))
_reached = None
if "RHW_MUTANTS_REACHED" in os.environ:
    with open(os.environ["RHW_MUTANTS_REACHED"], "r+b") as _file:
        _reached = mmap.mmap(_file.fileno(), 0)


def mutant(number):
    """Returns True if mutant `number` is on."""
    if _reached is not None:
        _reached[number] = 1
    return _on == number
