"""Text: one point a line.

Blanks, tabs, commas or semicolons between the values; x y z first, unless a header names
the columns, in any order and case, quoted or not: ``"X","Y","Z","Intensity"``. A comment
with as many names as there are columns (``//X Y Z R G B``) is such a header too. Comments
begin with # or //. A first line that is one whole number is a count of points, as the
.pts files of Leica scanners have it. A file may hold nan, but not leave a value out.

Written with the shortest digits that give the same float64 back: .csv with commas and a
header, .pts with its count, the others as plain rows with blanks.
"""

from __future__ import annotations

import csv
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from sketchloft.cloud import PointCloud
from sketchloft.errors import InputError
from sketchloft.io.fields import is_number, line_feeds, sniff, split, without_comments
from sketchloft.io.format import Format
from sketchloft.io.rows import read_rows

__all__ = ["FORMAT"]

FIRST_THREE = (0, 1, 2)
TAIL = 4_096
"""Bytes at the end of the file that hold its last two rows."""


@dataclass(frozen=True)
class _Head:
    """What stands before the rows: where they start, and what it says about them."""

    start: int
    first_line: int
    delimiter: bytes
    columns: tuple[int, int, int]
    n_names: int | None
    n_points: int | None


def _read(path: Path) -> PointCloud:
    body = _decode(path.read_bytes())
    head = _read_head(body)
    rows = body[head.start :]
    _check_last_row(rows, head)
    points = read_rows(rows, head.columns, head.delimiter, head.first_line)
    if head.n_points is not None and head.n_points != len(points):
        more = "was cut short" if len(points) < head.n_points else "has a wrong count"
        raise InputError(
            f"the count line promises {head.n_points} points, the file holds {len(points)}; it {more}"
        )
    return PointCloud.of(points)


def _decode(data: bytes) -> bytes:
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        data = data.decode("utf-16", "replace").encode()
    if b"\0" in data:
        raise InputError("found binary data, expected text; give the file the extension of its format")
    return line_feeds(data.removeprefix(b"\xef\xbb\xbf"))


def _lines(body: bytes) -> Iterator[tuple[int, bytes]]:
    start = 0
    while start < len(body):
        stop = body.find(b"\n", start)
        stop = len(body) if stop < 0 else stop
        yield start, body[start:stop]
        start = stop + 1


def _read_head(body: bytes) -> _Head:
    names: list[str] | None = None
    n_points: int | None = None
    comment = b""
    for number, (start, line) in enumerate(_lines(body), 1):
        delimiter = sniff(line)
        fields = split(line, delimiter)
        if not fields:
            comment = line.strip().lstrip(b"#/") or comment
        elif names is None and n_points is None and len(fields) == 1 and fields[0].isdigit():
            n_points = int(fields[0])
        elif names is not None or all(is_number(field) for field in fields[:3]):
            if names is None:
                names = _names(comment, sniff(comment))
                names = names if len(names) == len(fields) and _are_columns(names) else None
            columns = FIRST_THREE if names is None else _columns(names)
            return _Head(start, number, delimiter, columns, None if names is None else len(names), n_points)
        else:
            names = _names(without_comments(line), delimiter)
            if not _are_columns(names):
                shown = line.strip()[:60].decode("utf-8", "replace")
                raise InputError(
                    f"line {number} ({shown!r}) is neither a row of numbers nor a header that names "
                    "x, y and z once each; say which columns they are, or take the line out"
                )
    raise InputError("holds no points, expected a row x y z for each")


def _names(header: bytes, delimiter: bytes) -> list[str]:
    text = header.decode("utf-8", "replace").replace("\t", "\t" if delimiter == b"\t" else " ").strip()
    try:
        cells = next(csv.reader([text], delimiter=delimiter.decode(), skipinitialspace=True), [])
    except csv.Error:  # no header is as long as that
        return []
    names = [cell.strip().lower() for cell in cells]
    while names and not names[-1]:  # of a delimiter at the end of the line
        names.pop()
    return names


def _are_columns(names: Sequence[str]) -> bool:
    return all(names.count(name) == 1 for name in "xyz")


def _columns(names: Sequence[str]) -> tuple[int, int, int]:
    return names.index("x"), names.index("y"), names.index("z")


def _check_last_row(rows: bytes, head: _Head) -> None:
    """Hold the last row against the one before it, and against the header."""
    lines = [line for line in rows[-TAIL:].split(b"\n") if split(line, head.delimiter)]
    if len(rows) > TAIL:
        del lines[:1]  # the tail may begin inside it
    if not lines:
        return
    before, last = (split(line, head.delimiter) for line in (lines[-2:][0], lines[-1]))
    number = head.first_line + rows.count(b"\n", 0, rows.rindex(lines[-1]))
    where = f"line {number} ({lines[-1].strip()[:60].decode('utf-8', 'replace')!r})"
    if not rows.endswith(b"\n") and len(last) < len(before):
        raise InputError(
            f"{where} ends the file after {len(last)} values where the line before has {len(before)}; "
            "the file was cut short"
        )
    n_filled = max((n for n, field in enumerate(last, 1) if field), default=0)
    if head.n_names is not None and head.n_names not in (len(last), n_filled):
        raise InputError(
            f"the header names {head.n_names} columns, but {where} has {len(last)} values; correct the header"
        )


def _write(path: Path, cloud: PointCloud) -> None:
    import polars as pl  # noqa: PLC0415 - costs 0.35 s, and most commands write no text

    is_csv = path.suffix.lower() == ".csv"
    with path.open("wb") as file:
        if path.suffix.lower() == ".pts":
            file.write(b"%d\n" % len(cloud))
        frame = pl.DataFrame(cloud.points, schema=["x", "y", "z"], orient="row")
        frame.write_csv(file, include_header=is_csv, separator="," if is_csv else " ")


FORMAT = Format(
    name="text",
    suffixes=(".xyz", ".txt", ".csv", ".pts", ".asc"),
    description="rows of x y z, with or without a header",
    read=_read,
    write=_write,
)
