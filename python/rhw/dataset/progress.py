# SPDX-License-Identifier: MIT
"""A line on a terminal that tells how far the work is, and lines that stay."""

from __future__ import annotations

import sys
import time


class Progress:
    """views: to be drawn. Nothing is told with `quiet`, and how far it is only where a terminal shows it."""

    def __init__(self, views: int, quiet: bool):
        self._views, self._quiet = views, quiet
        self._done, self._shown = 0, 0
        self._lively = not quiet and sys.stderr.isatty()
        self._begun = time.monotonic()

    def add(self, views: int) -> None:
        self._done += views
        self.show()

    def show(self) -> None:
        if self._lively:
            line = f"{self._done} of {self._views} views{self._left()}"
            sys.stderr.write("\r" + line.ljust(self._shown))
            sys.stderr.flush()
            self._shown = len(line)

    def _left(self) -> str:
        seconds = time.monotonic() - self._begun
        if self._done == 0 or seconds < 1:
            return ""
        left = round(seconds / self._done * (self._views - self._done))
        clock = f"{left // 3600}:{left // 60 % 60:02}:{left % 60:02}" if left >= 3600 else f"{left // 60}:{left % 60:02}"
        return f", {self._done / seconds:.1f} a second, {clock} left"

    def clear(self) -> None:
        if self._shown:
            sys.stderr.write("\r" + " " * self._shown + "\r")
            sys.stderr.flush()
            self._shown = 0

    def warn(self, line: str) -> None:
        if not self._quiet:
            self.fail(line)

    def fail(self, line: str) -> None:
        self.clear()
        print(f"rhw.dataset: {line}", file=sys.stderr, flush=True)
        self.show()
