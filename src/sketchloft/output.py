"""Output: files that are written whole or not at all."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Mapping
from pathlib import Path

from sketchloft.errors import OutputError

__all__ = ["check_writable", "write_all"]


def check_writable(path: Path) -> None:
    """Find out, before the work begins, whether a file could be written.

    Raises
    ------
    OutputError
        If the path is a folder, or its folder is missing or not writable.
    """
    folder = path.parent
    if path.is_dir():
        raise OutputError(f"{path}: is a folder, expected a file; add a file name")
    if not folder.is_dir():
        raise OutputError(f"{path}: the folder {folder} does not exist; make it first")
    if not os.access(folder, os.W_OK | os.X_OK):
        raise OutputError(f"{path}: the folder {folder} is not writable; choose another one")


def write_all(contents: Mapping[Path, bytes]) -> None:
    """Write files beside their places first and rename them last, so that all are written or none.

    Parameters
    ----------
    contents : mapping of Path to bytes

    Raises
    ------
    OutputError
        If one cannot be written; then none is touched.
    """
    beside = {path: path.with_name(f".{path.name}.{os.getpid()}.part") for path in contents}
    path = next(iter(contents), Path())
    try:
        for path, content in contents.items():
            beside[path].write_bytes(content)
        for path, part in beside.items():
            part.replace(path)
    except OSError as error:
        raise OutputError(f"{path}: cannot be written: {error.strerror or error}") from None
    finally:
        for part in beside.values():
            with contextlib.suppress(OSError):
                part.unlink(missing_ok=True)
