# SPDX-License-Identifier: MIT
"""Files that appear whole or not at all."""

from __future__ import annotations

import contextlib
import errno
import filecmp
import os
import secrets
from typing import BinaryIO, Iterator, Optional, Union

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


_DESCRIPTORS = "/proc/self/fd"  #: where files without a name can be found, to give them one


def _open_unnamed(folder: str) -> Optional[BinaryIO]:
    """A new file that vanishes with the process until it gets a name. None where the system or the folder has none."""
    try:
        return open(os.open(folder, os.O_TMPFILE | os.O_WRONLY, 0o666), "wb") if os.path.isdir(_DESCRIPTORS) else None
    except (AttributeError, OSError):
        return None


def _name(file: BinaryIO, name: str) -> None:
    """Gives it a name that is free."""
    folder = os.open(_DESCRIPTORS, os.O_RDONLY)
    try:
        os.link(str(file.fileno()), name, src_dir_fd=folder, follow_symlinks=True)
    finally:
        os.close(folder)


@contextlib.contextmanager
def _gone_unless_whole(temporary: str) -> Iterator[None]:
    """Removes it where the block is left by an exception: Ctrl-C comes just when it has its name, too."""
    try:
        yield
    except BaseException:
        with contextlib.suppress(FileNotFoundError):
            os.unlink(temporary)
        raise


def _name_whole(file: BinaryIO, target: str, temporary: str, new: bool) -> None:
    file.flush()
    try:
        _name(file, target)
    except FileExistsError:
        if new:
            raise
        with _gone_unless_whole(temporary):
            _name(file, temporary)
            os.replace(temporary, target)


@contextlib.contextmanager
def _named(target: str, temporary: str, new: bool) -> Iterator[BinaryIO]:
    # What others may do with it is the system's to say: to ask for the process's mask is to change it for other threads.
    with _gone_unless_whole(temporary):
        with open(temporary, "xb") as file:
            yield file
        if new:
            _put_in_place(temporary, target)
        else:
            os.replace(temporary, target)


@contextlib.contextmanager
def replacing(path: Path, new: bool = False) -> Iterator[BinaryIO]:
    """A file beside a place, which gets its name at the end of the block. It is gone where that is left by an exception.

    Where the system has files without a name, nothing is left of it either when the process is killed.

    new: FileExistsError where another has the name by then.
    """
    target = os.path.realpath(path)  # a link stays one
    temporary = os.path.join(os.path.dirname(target), TEMPORARY + secrets.token_hex(8))
    try:
        unnamed = _open_unnamed(os.path.dirname(target))
        if unnamed is None:
            with _named(target, temporary, new) as file:
                yield file
        else:
            with unnamed as file:
                yield file
                _name_whole(file, target, temporary, new)
    except OSError as error:
        if error.errno is None:
            raise
        raise OSError(error.errno, error.strerror, os.fspath(path)) from None  # not the name of today


def equals(file: BinaryIO, path: str) -> bool:
    """Whether a file of `replacing` has so far the bytes of another, if that is there."""
    file.flush()
    name = file.name if isinstance(file.name, str) else os.path.join(_DESCRIPTORS, str(file.fileno()))
    return os.path.exists(path) and filecmp.cmp(name, path, shallow=False)


def write(path: Path, data: bytes) -> None:
    """Writes a file beside its place and then gives it its name. What is no regular file is written directly."""
    name = os.fspath(path)
    if os.path.exists(name) and not os.path.isfile(name):
        with open(name, "wb") as file:
            file.write(data)
        return
    with replacing(name) as file:
        file.write(data)
