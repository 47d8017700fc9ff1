"""The header of a PCD file: the fields of a point, and how many points there are."""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from typing import Any

import numpy as np

from sketchloft.errors import InputError

__all__ = ["Header", "parse_header"]

_TYPES = {
    f"{kind}{size}": np.dtype(f"<{kind.lower()}{size}")
    for kind, size in (*itertools.product("IU", "1248"), ("F", "4"), ("F", "8"))
}

MAX_COUNT = 65_535
"""Most values in one field of one point; the largest feature descriptors have some thousand."""


@dataclass(frozen=True)
class Header:
    """The fields of a point in the order of the file, each of `counts` values of a type."""

    names: tuple[str, ...]
    types: tuple[np.dtype[Any], ...]
    counts: tuple[int, ...]
    n_points: int

    def index(self, name: str) -> int:
        """Return which field has a name."""
        return self.names.index(name)


def parse_header(text: str) -> Header:
    """Parse the lines of a PCD header.

    Parameters
    ----------
    text : str
        The header up to the line DATA.

    Returns
    -------
    Header
        With x, y and z among its fields, one value each; names in lower case.

    Raises
    ------
    InputError
        If anything is missing or contradicts itself.
    """
    lines = (line.split() for line in text.splitlines() if not line.lstrip().startswith("#"))
    said = {words[0].upper(): words[1:] for words in lines if words}
    names = tuple(name.lower() for name in said.get("FIELDS", said.get("COLUMNS", [])))
    if any(names.count(name) != 1 for name in "xyz"):
        raise InputError(
            f"the PCD fields are {' '.join(names) or 'not given'}, expected x, y and z among them"
        )
    sizes, kinds = said.get("SIZE", []), said.get("TYPE", [])
    counts = said.get("COUNT", ["1"] * len(names))
    if not len(sizes) == len(kinds) == len(counts) == len(names):
        raise InputError("FIELDS, SIZE, TYPE and COUNT of the PCD header differ in length")
    try:
        types = tuple(_TYPES[kind.upper() + size] for kind, size in zip(kinds, sizes, strict=True))
        if "POINTS" in said:
            n_points = int(said["POINTS"][0])
        else:
            n_points = int(said["WIDTH"][0]) * int(said["HEIGHT"][0])
        header = Header(names, types, tuple(map(int, counts)), n_points)
    except (KeyError, IndexError, ValueError):
        raise InputError("SIZE, TYPE, COUNT or POINTS of the PCD header cannot be understood") from None
    if any(header.counts[header.index(name)] != 1 for name in "xyz"):
        raise InputError(f"COUNT in the PCD header is {' '.join(counts)}, expected 1 for x, y and z")
    if n_points < 0 or not all(0 <= count <= MAX_COUNT for count in header.counts):
        raise InputError(
            f"a COUNT or POINTS of the PCD header is negative or beyond {MAX_COUNT} values a field"
        )
    return header
