# SPDX-License-Identifier: MIT
"""How a run ends early. Each has one line that names the thing and the rule."""


class Mistake(Exception):
    """What was asked for cannot be: exit status 2."""


class Failure(Exception):
    """The work cannot be done: exit status 1."""


class Broken(Failure):
    """A model cannot be drawn; others can."""
