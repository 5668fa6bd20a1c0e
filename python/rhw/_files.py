# SPDX-License-Identifier: MIT
"""Files that appear whole or not at all."""

from __future__ import annotations

import contextlib
import errno
import os
import secrets
from typing import BinaryIO, Iterator, Union

Path = Union[str, "os.PathLike[str]"]

TEMPORARY = ".rhw-"  #: what the names of files begin with that are being written


#: What a system says whose files have one name each.
_NO_LINKS = (errno.EPERM, errno.ENOSYS, errno.ENOTSUP, errno.EOPNOTSUPP)


def _put_in_place(temporary: str, target: str) -> None:
    """Unless something is there; without links, of several who come at the very same moment the last one has it."""
    try:
        os.link(temporary, target)
    except OSError as error:
        if error.errno not in _NO_LINKS:
            raise
        if os.path.exists(target):
            raise FileExistsError(errno.EEXIST, os.strerror(errno.EEXIST)) from None
        os.replace(temporary, target)
    else:
        os.unlink(temporary)


@contextlib.contextmanager
def replacing(path: Path, new: bool = False) -> Iterator[BinaryIO]:
    """A file beside a place, which gets its name at the end of the block. It is gone where that is left by an exception.

    new: FileExistsError where another has the name by then.
    """
    target = os.path.realpath(path)  # a link stays one
    temporary = os.path.join(os.path.dirname(target), TEMPORARY + secrets.token_hex(8))
    try:
        # What others may do with it is the system's to say: to ask for the process's mask is to change it for other threads.
        file = open(temporary, "xb")
        try:
            with file:
                yield file
            if new:
                _put_in_place(temporary, target)
            else:
                os.replace(temporary, target)
        except BaseException:
            with contextlib.suppress(FileNotFoundError):
                os.unlink(temporary)
            raise
    except OSError as error:
        if error.errno is None:
            raise
        raise OSError(error.errno, error.strerror, os.fspath(path)) from None  # not the name of today


def write(path: Path, data: bytes) -> None:
    """Writes a file beside its place and then gives it its name. What is no regular file is written directly."""
    name = os.fspath(path)
    if os.path.exists(name) and not os.path.isfile(name):
        with open(name, "wb") as file:
            file.write(data)
        return
    with replacing(name) as file:
        file.write(data)
