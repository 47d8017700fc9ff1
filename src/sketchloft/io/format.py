"""Format: what every file format of a cloud tells about itself."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from sketchloft.cloud import PointCloud

__all__ = ["Format"]


@dataclass(frozen=True)
class Format:
    """A file format.

    Parameters
    ----------
    name : str
        What `read_cloud(..., format=name)` calls it.
    suffixes : tuple of str
        Extensions in lower case, with the dot; the first one is the usual one.
    description : str
        One line for help texts and tables.
    read : callable
        Reads the cloud in a file. Raises InputError, whose message need not name the file,
        and lets OSError pass; `read_cloud` deals with both, and sets unit and name.
    write : callable or None
        Writes a cloud to a new file; None where the format is only read.
    starts : tuple of bytes
        What such a file can begin with and no file of another format does; may be empty.
    """

    name: str
    suffixes: tuple[str, ...]
    description: str
    read: Callable[[Path], PointCloud]
    write: Callable[[Path, PointCloud], None] | None
    starts: tuple[bytes, ...] = ()
