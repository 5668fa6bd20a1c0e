# SPDX-License-Identifier: MIT
"""A place in a source where a small change alters what the program means."""
from dataclasses import dataclass

# What a comparison or an operator becomes.
OTHER = {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==", "+": "-", "-": "+", "+=": "-=", "-=": "+="}
COMPARISONS = ("<", "<=", ">", ">=", "==", "!=")


@dataclass
class Place:
    """A mutant: `mutated` stands for the bytes start..end of a file, and has {on} where the switch is asked."""

    file: str
    line: int  # from 1 on
    kind: str  # comparison, sign, constant, condition, check or statement
    start: int
    end: int
    mutated: str
    told: str  # the change in words
    number: int = 0

    def __str__(self):
        return f"{self.file}:{self.line}: {self.kind}: {self.told}"


def short(text, most=48):
    """The text in one line of at most that many characters."""
    text = " ".join(text.split())
    return text if len(text) <= most else text[: most - 1] + "…"


def constant_becomes(text):
    """What a number becomes: one more, or twice as much where it has a point; None where it is no plain number."""
    digits = text.rstrip("uUlLfF") if not text.lower().startswith("0x") else text.rstrip("uUlL")
    try:
        value = int(digits, 0)
    except ValueError:
        try:
            return "1.0" + text[len(digits):] if float(digits) == 0 else f"(2 * {text})"
        except ValueError:
            return None
    return f"{value + 1}{text[len(digits):]}"
