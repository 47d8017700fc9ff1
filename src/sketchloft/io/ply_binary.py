"""The body of a binary PLY file: rows packed one behind the other, where lists make them uneven."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from sketchloft.cloud import Floats
from sketchloft.errors import InputError
from sketchloft.io.ply_header import Element

__all__ = ["end_of", "read_columns"]


def read_columns(data: bytes, element: Element, at: int, columns: Sequence[int]) -> Floats:
    """Read some properties of every row of an element.

    Parameters
    ----------
    data : bytes
        The file.
    element : Element
    at : int
        Where its first row begins.
    columns : sequence of int
        Which properties; none of them a list.

    Returns
    -------
    (element.count, len(columns)) float array

    Raises
    ------
    InputError
        If the file ends before the last row.
    """
    rows = _even_rows(data, element, at)
    if rows is not None:
        values = [rows[str(k)] for k in columns]
    else:
        offsets = np.array([places[:-1] for places in _walk(data, element, at)], np.intp)
        values = [_gather(data, offsets[:, k], element.properties[k].type) for k in columns]
    return np.stack(values, axis=1).astype(np.float64)


def end_of(data: bytes, element: Element, at: int) -> int:
    """Return where the last row of an element ends that begins at `at`."""
    rows = _even_rows(data, element, at)
    if rows is not None:
        return at + rows.nbytes
    for places in _walk(data, element, at):
        at = places[-1]
    return at


def _even_rows(data: bytes, element: Element, at: int) -> NDArray[Any] | None:
    """Return the rows as records, or None if their lists are not all as long as in the first row."""
    first = next(_walk(data, element, at), []) if element.has_lists else []
    fields: list[tuple[str, np.dtype[Any], tuple[int, ...]]] = []
    lengths: dict[str, int] = {}
    for k, one in enumerate(element.properties):
        shape: tuple[int, ...] = ()
        if one.length is not None:
            lengths[f"n{k}"] = _length(data, one.length, first[k]) if first else 0
            fields.append((f"n{k}", one.length, ()))
            shape = (lengths[f"n{k}"],)
        fields.append((str(k), one.type, shape))
    record = np.dtype(fields)
    room = len(data) - at
    if record.itemsize * element.count > room:
        if element.has_lists:  # later rows may be shorter
            return None
        raise _cut_short(element, room // record.itemsize)
    if record.itemsize == 0:
        return np.empty(0, record)
    rows = np.frombuffer(data, record, element.count, at)
    return rows if all((rows[name] == length).all() for name, length in lengths.items()) else None


def _walk(data: bytes, element: Element, at: int) -> Iterator[list[int]]:
    """Yield for each row where its properties begin and where it ends; each hangs on the one before."""
    for row in range(element.count):
        places = []
        for one in element.properties:
            places.append(at)
            n_values = 1
            if one.length is not None:
                n_values = _length(data, one.length, at)
                at += one.length.itemsize
            at += n_values * one.type.itemsize
        if at > len(data):
            raise _cut_short(element, row)
        places.append(at)
        yield places


def _length(data: bytes, kind: np.dtype[Any], at: int) -> int:
    order: Literal["big", "little"] = "big" if kind.str[0] == ">" else "little"
    length = int.from_bytes(data[at : at + kind.itemsize], order, signed=kind.kind == "i")
    if length < 0:
        raise InputError(f"a list in the binary PLY has the length {length}; the file is damaged")
    return length


def _gather(data: bytes, places: NDArray[np.intp], kind: np.dtype[Any]) -> NDArray[Any]:
    return np.frombuffer(data, np.uint8)[places[:, None] + np.arange(kind.itemsize)].view(kind)[:, 0]


def _cut_short(element: Element, found: int) -> InputError:
    rows = {"vertex": "vertices"}.get(element.name, f"rows of {element.name}")
    return InputError(f"the header promises {element.count} {rows}, the file holds {found}; it was cut short")
