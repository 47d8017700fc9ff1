"""The input room: reads clouds from files and writes them, whatever the format.

One file per format, each ending in ``FORMAT = Format(...)``. To add one, write such a file
and put its FORMAT into FORMATS; help texts, tables and round-trip tests follow.
"""

from __future__ import annotations

import os
import stat
from dataclasses import replace
from pathlib import Path

from sketchloft.cloud import UNITS, PointCloud, Unit
from sketchloft.errors import InputError, OutputError, UsageError
from sketchloft.io import npy, pcd, ply, text
from sketchloft.io.content import HEAD, recognise
from sketchloft.io.format import Format
from sketchloft.output import beside

__all__ = ["FORMATS", "Format", "format_of", "read_cloud", "write_cloud"]

FORMATS: tuple[Format, ...] = (text.FORMAT, npy.FORMAT, ply.FORMAT, pcd.FORMAT)


def format_of(path: str | os.PathLike[str]) -> Format:
    """Return the format that a file's extension stands for.

    Parameters
    ----------
    path : path-like
        The file need not exist.

    Returns
    -------
    Format

    Raises
    ------
    InputError
        If no format has this extension.
    """
    suffix = Path(path).suffix.lower()
    for one in FORMATS:
        if suffix in one.suffixes:
            return one
    known = " ".join(known for one in FORMATS for known in one.suffixes)
    raise InputError(
        f"{path}: no cloud format has the extension {suffix or '(none)'}, known are {known}; "
        "rename the file, or convert it to one of them"
    )


def read_cloud(path: str | os.PathLike[str], *, unit: Unit = "mm", format: str | None = None) -> PointCloud:  # noqa: A002 - the usual name
    """Read the cloud in a file.

    Parameters
    ----------
    path : path-like
    unit : {"mm", "cm", "m", "in"}
        Unit of length of the file's coordinates.
    format : str, optional
        Name of the format; by default the extension decides.

    Returns
    -------
    PointCloud
        Points as they stand in the file, NaN and repeats included; named after the file.

    Raises
    ------
    UsageError
        If there is no such unit or format.
    InputError
        If the file is missing, unreadable, cut short or malformed, or holds no points.
    """
    if unit not in UNITS:
        raise UsageError(f"there is no unit {unit!r}; choose one of {', '.join(UNITS)}")
    path = Path(path)
    if path.is_dir():
        raise InputError(f"{path}: is a folder, expected a file; name one of the clouds in it")
    chosen = format_of(path) if format is None else _named(format)
    try:
        _check_content(path, chosen, named=format is not None)
        cloud = chosen.read(path)
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror or error}") from None
    except InputError as error:
        raise InputError(f"{path}: {error}") from None
    if not len(cloud):
        raise InputError(f"{path}: holds no points; check that the drawing was saved whole")
    return replace(cloud, unit=unit, name=path.stem)


def write_cloud(path: str | os.PathLike[str], cloud: PointCloud) -> None:
    """Write a cloud to a file in the format of its extension, whole or not at all.

    Parameters
    ----------
    path : path-like
        Replaced if it exists.
    cloud : PointCloud

    Raises
    ------
    OutputError
        If no format to write has this extension, or the file cannot be written.
    """
    path = Path(path)
    suffix = path.suffix.lower()
    write = next((one.write for one in FORMATS if suffix in one.suffixes), None)
    if write is None:
        known = " ".join(known for one in FORMATS if one.write for known in one.suffixes)
        raise OutputError(f"{path}: cannot write the extension {suffix or '(none)'}; choose one of {known}")
    with beside(path) as parts:
        write(next(parts), cloud)


def _named(name: str) -> Format:
    for one in FORMATS:
        if one.name == name:
            return one
    raise UsageError(f"there is no format {name!r}; choose one of {', '.join(one.name for one in FORMATS)}")


def _check_content(path: Path, chosen: Format, *, named: bool) -> None:
    status = path.stat()
    if stat.S_ISDIR(status.st_mode):
        raise InputError("is a folder, expected a file; name the file inside it")
    if not stat.S_ISREG(status.st_mode):
        raise InputError("is no regular file; save what comes out of it to a file first")
    if status.st_size == 0:
        raise InputError("is empty; check that the drawing was saved whole")
    with path.open("rb") as file:
        found = recognise(file.read(HEAD), FORMATS)
    if found is None or found is chosen:
        return
    asked = f"asked for as {chosen.name}" if named else f"called {path.suffix}"
    if isinstance(found, Format):
        raise InputError(
            f"is {asked}, but holds a {found.name.upper()} file; "
            f"give it the extension {found.suffixes[0]} or read it as format {found.name!r}"
        )
    raise InputError(f"is {asked}, but holds {found}, which is no cloud that can be read; convert it first")
