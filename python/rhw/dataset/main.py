# SPDX-License-Identifier: MIT
"""The command line, and how it ends."""

from __future__ import annotations

import os
import signal
import sys
import warnings
from typing import NoReturn, Optional, Sequence

from .errors import Failure, Mistake


def main(arguments: Optional[Sequence[str]] = None) -> NoReturn:
    """Exit status 0, 1 when the work failed, 2 for a wrong command line; Ctrl-C ends it by its signal."""
    try:
        status = _run(arguments)
    except Mistake as error:
        status = _fail(str(error), 2)
    except Failure as error:
        status = _fail(str(error), 1)
    except BrokenPipeError:  # who read our last line is gone
        status = 1
        sys.stdout = None  # type: ignore[assignment]
    except OSError as error:
        status = _fail(f"{error.filename}: {error.strerror}" if error.filename else str(error), 1)
    except MemoryError:
        status = _fail("there is not enough memory", 1)
    except KeyboardInterrupt:
        # Threads that draw would be waited for at the interpreter's end; files are whole at any moment.
        begin = "\n" if sys.stderr.isatty() else ""
        print(f"{begin}rhw.dataset: ended; the same command goes on from here", file=sys.stderr, flush=True)
        signal.signal(signal.SIGINT, signal.SIG_DFL)
        os.kill(os.getpid(), signal.SIGINT)
        raise
    sys.exit(status)


def _run(arguments: Optional[Sequence[str]]) -> int:
    from . import options, run, verify  # what takes a while to import may be interrupted, too

    # A camera of a file may well look past the model.
    warnings.filterwarnings("ignore", message=".*nothing of the model is in the picture")
    asked = options.read(arguments)
    if asked.verify is not None:
        return verify.verify(asked.verify, asked.quiet)
    return run.make(asked.folder, asked.plan(), asked.how())


def _fail(line: str, status: int) -> int:
    print(f"rhw.dataset: {line}", file=sys.stderr)
    return status
