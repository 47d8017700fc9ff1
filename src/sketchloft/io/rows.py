"""Rows of numbers written as text: what the text formats share."""

from __future__ import annotations

import io
from collections.abc import Iterator

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.errors import InputError
from sketchloft.io.fields import is_number, is_tidy, split, tidy

__all__ = ["POLARS_FROM", "read_rows", "take"]

POLARS_FROM = 2_000_000
"""Bytes of text from which polars is worth the 0.35 s of its import."""
BLOCK = 500_000
"""Bytes of text that numpy parses at a time."""


def take(body: bytes, skip: int, count: int) -> tuple[bytes, int]:
    """Cut rows out of the body of a file whose header tells how many there are.

    Parameters
    ----------
    body : bytes
        Lines that end in a line feed.
    skip, count : int
        How many rows to pass over, and how many to take.

    Returns
    -------
    rows : bytes
        The text of the rows.
    lines : int
        How many lines lie before them.

    Raises
    ------
    InputError
        If there are fewer rows.
    """
    if count == 0:
        return b"", 0
    text = np.frombuffer(b"\n" + body + b"\n", np.uint8) == ord("\n")
    ends = np.flatnonzero(text[1:] & ~text[:-1])  # of the lines that are not empty
    if len(ends) < skip + count:
        raise InputError(
            f"the header promises {count} points, the file holds {max(0, len(ends) - skip)}; it was cut short"
        )
    start = int(ends[skip - 1]) + 1 if skip else 0
    stop = int(ends[skip + count - 1]) + 1
    return body[start:stop], body.count(b"\n", 0, start)


def read_rows(body: bytes, columns: tuple[int, int, int], delimiter: bytes, first_line: int) -> Floats:
    """Read x, y and z of every row.

    Parameters
    ----------
    body : bytes
        Lines that end in a line feed.
    columns : tuple of three int
        Where in a row x, y and z stand, from 0. There may be further values.
    delimiter : bytes
        As `fields.sniff` found it.
    first_line : int
        Number in the file of the first line of `body`, for messages.

    Returns
    -------
    (n, 3) float array

    Raises
    ------
    InputError
        If a row has too few values or one that is not a number.

    Notes
    -----
    Both parsers round correctly, so that the same text gives the same bits through either.
    What polars will not read goes through numpy, so that the errors are the same as well.
    """
    if len(body) >= POLARS_FROM:
        points = _by_polars(body if is_tidy(body, delimiter) else tidy(body, delimiter), columns, delimiter)
        if points is not None:
            return points
    return np.concatenate(list(_by_numpy(body, columns, delimiter, first_line)))


def _by_numpy(
    body: bytes, columns: tuple[int, int, int], delimiter: bytes, first_line: int
) -> Iterator[Floats]:
    """Parse block by block, so that only the block of a fault is searched for its line."""
    yield np.empty((0, 3))
    start = 0
    while start < len(body):
        stop = body.find(b"\n", start + BLOCK) + 1 or len(body)
        block = body[start:stop]
        if text := tidy(block, delimiter):
            lines = io.StringIO(text.decode("ascii", "replace"))
            try:
                yield np.loadtxt(lines, delimiter=delimiter.decode(), usecols=columns, comments=None, ndmin=2)
            except ValueError as error:
                fault = _first_fault(block, columns, delimiter, first_line)
                raise InputError(fault or f"not rows of numbers ({error})") from None
        first_line += block.count(b"\n")
        start = stop


def _by_polars(text: bytes, columns: tuple[int, int, int], delimiter: bytes) -> Floats | None:
    import polars as pl  # noqa: PLC0415 - costs more than numpy takes for a small file

    names = [f"column_{i + 1}" for i in range(max(columns) + 1)]
    wanted = [names[i] for i in columns]
    schema = {name: pl.Float64() if name in wanted else pl.String() for name in names}
    try:
        frame = pl.read_csv(
            text,
            has_header=False,
            separator=delimiter.decode(),
            schema=schema,
            columns=wanted,
            quote_char=None,
            truncate_ragged_lines=True,
        )
    except pl.exceptions.PolarsError:
        return None
    if any(frame.null_count().row(0)):
        return None
    return np.ascontiguousarray(frame.select(wanted).to_numpy())


def _first_fault(body: bytes, columns: tuple[int, int, int], delimiter: bytes, first_line: int) -> str | None:
    for number, line in enumerate(body.split(b"\n"), first_line):
        fields = split(line, delimiter)
        if not fields:
            continue
        shown = line.strip()[:60].decode("utf-8", "replace")
        if len(fields) <= max(columns):
            return (
                f"line {number} ({shown!r}) is too short: {len(fields)} of at least {max(columns) + 1} "
                "values; the file may be cut short"
            )
        for name, column in zip("xyz", columns, strict=True):
            if not is_number(fields[column]):
                found = fields[column].decode("utf-8", "replace")
                return f"line {number} ({shown!r}): {name} is {found!r}, expected a number (nan if unknown)"
    return None
