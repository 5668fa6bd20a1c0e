# SPDX-License-Identifier: MIT
"""Files that appear whole or not at all."""

from __future__ import annotations

import os
import tempfile
from typing import Union

Path = Union[str, "os.PathLike[str]"]


def write(path: Path, data: bytes) -> None:
    """Writes a file beside its place and then gives it its name. What is no regular file is written directly."""
    name = os.fspath(path)
    if os.path.exists(name) and not os.path.isfile(name):
        with open(name, "wb") as file:
            file.write(data)
        return
    target = os.path.realpath(name)  # a link stays one
    handle, temporary = tempfile.mkstemp(prefix=".rhw-", dir=os.path.dirname(target) or ".")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(data)
        umask = os.umask(0)
        os.umask(umask)
        os.chmod(temporary, 0o666 & ~umask)
        os.replace(temporary, target)
    except BaseException:
        os.unlink(temporary)
        raise
