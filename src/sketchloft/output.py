"""Output: files that are written whole or not at all."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterator
from pathlib import Path

from sketchloft.errors import OutputError

__all__ = ["beside", "check_writable"]


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


@contextlib.contextmanager
def beside(*paths: Path) -> Iterator[Iterator[Path]]:
    """Write files beside their places first and rename them last, so that all are written or none.

    Parameters
    ----------
    *paths : Path
        Replaced where they exist.

    Yields
    ------
    iterator of Path
        Where to write each of them in turn, with the same extension.

    Raises
    ------
    OutputError
        If one cannot be written; then none is touched.
    """
    parts = {path.with_name(f".{path.stem}.{os.getpid()}.part{path.suffix}"): path for path in paths}
    current = paths[0]

    def in_turn() -> Iterator[Path]:
        nonlocal current
        for part, path in parts.items():
            current = path
            yield part

    try:
        yield in_turn()
        for part in in_turn():
            part.replace(current)
    except OSError as error:
        raise OutputError(f"{current}: cannot be written: {error.strerror or error}") from None
    finally:
        for part in parts:
            with contextlib.suppress(OSError):
                part.unlink(missing_ok=True)
