"""The header of a PLY file: which elements its body holds, and of which properties."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from sketchloft.errors import InputError

__all__ = ["Element", "Header", "Property", "parse_header"]

_TYPES = {
    "char": "i1",
    "uchar": "u1",
    "short": "i2",
    "ushort": "u2",
    "int": "i4",
    "uint": "u4",
    "float": "f4",
    "double": "f8",
    "int8": "i1",
    "uint8": "u1",
    "int16": "i2",
    "uint16": "u2",
    "int32": "i4",
    "uint32": "u4",
    "float32": "f4",
    "float64": "f8",
}
_ORDERS = {"ascii": "=", "binary_little_endian": "<", "binary_big_endian": ">"}
_START = re.compile(rb"ply[ \t]*(\r\n|\n|\r)")


@dataclass(frozen=True)
class Property:
    """One value, or a list of values behind their number where `length` is given."""

    name: str
    type: np.dtype[Any]
    length: np.dtype[Any] | None = None


@dataclass(frozen=True)
class Element:
    """`count` rows of the same properties."""

    name: str
    count: int
    properties: tuple[Property, ...] = ()

    @property
    def has_lists(self) -> bool:
        """Whether the rows can differ in length."""
        return any(one.length is not None for one in self.properties)


@dataclass(frozen=True)
class Header:
    """What the header says; it has `n_lines` lines, and the body begins at byte `start`."""

    is_ascii: bool
    elements: tuple[Element, ...]
    n_lines: int
    start: int


def parse_header(data: bytes) -> Header:
    """Parse the header at the start of a PLY file.

    Parameters
    ----------
    data : bytes
        The file.

    Returns
    -------
    Header

    Raises
    ------
    InputError
        If it is no PLY header, or not a whole one.
    """
    start = _START.match(data)
    if start is None:
        raise InputError("does not begin with a line 'ply'; check its extension")
    line_end = start[1]  # not just any: the first byte of a binary body can look like one
    end = re.compile(line_end + rb"end_header[ \t]*" + line_end).search(data)
    if end is None:
        raise InputError("the PLY header has no line end_header; the file was cut short")
    order: str | None = None
    elements: list[Element] = []
    lines = data[: end.start()].decode("utf-8", "replace").split(line_end.decode())
    for number, line in enumerate(lines, 1):
        match line.split():
            case ["format", encoding, *_] if encoding in _ORDERS:
                order = _ORDERS[encoding]
            case ["element", name, count] if count.isascii() and count.isdigit():
                elements.append(Element(name, int(count)))
            case ["property", *words] if elements and order and (one := _property(words, order)):
                elements[-1] = replace(elements[-1], properties=(*elements[-1].properties, one))
            case [] | ["ply"] | ["comment", *_] | ["obj_info", *_]:
                pass
            case _:
                raise InputError(f"line {number} of the PLY header cannot be understood: {line.strip()!r}")
    if order is None:
        raise InputError(f"the PLY header has no line format; expected one of {', '.join(_ORDERS)}")
    return Header(order == "=", tuple(elements), len(lines) + 1, end.end())


def _property(words: list[str], order: str) -> Property | None:
    match words:
        case ["list", length, kind, name] if _TYPES.get(length, "f")[0] in "iu" and kind in _TYPES:
            return Property(name, np.dtype(order + _TYPES[kind]), np.dtype(order + _TYPES[length]))
        case [kind, name] if kind in _TYPES:
            return Property(name, np.dtype(order + _TYPES[kind]))
    return None
