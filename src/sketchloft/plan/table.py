"""Tables of a plan's file: whether their keys and values are such as are expected."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, TypeVar

from sketchloft.errors import InputError

__all__ = ["Table", "check_keys", "checked", "listed", "one_of", "tables"]

Table = Mapping[str, Any]
T = TypeVar("T")
W = TypeVar("W", bound=str)


def check_keys(
    table: Table, place: str, required: Sequence[str], optional: Sequence[str] = (), what: str = "this"
) -> None:
    """Find out whether a table has all keys that it needs, and no others than it may have.

    Parameters
    ----------
    table : mapping
    place : str
        What messages begin with.
    required, optional : sequence of str
    what : str
        What has these keys.

    Raises
    ------
    InputError
        Names the key, and the valid ones.
    """
    for key in table:
        if key not in required and key not in optional:
            raise InputError(
                f"{place}unknown key {key!r}; the keys of {what} are {listed([*required, *optional])}"
            )
    for key in required:
        if key not in table:
            raise InputError(f"{place}the key {key!r} is missing; {what} needs {listed(required)}")


def checked(parse: Callable[[Any], T], raw: Any, place: str) -> T:
    """Parse a value; a ValueError becomes an InputError that names the place."""
    try:
        return parse(raw)
    except ValueError as error:
        raise InputError(f"{place}: {error}") from None


def tables(raw: Any, place: str) -> list[Table]:
    """Return an array of one table or more."""
    if not isinstance(raw, list) or not raw or not all(isinstance(item, dict) for item in raw):
        raise InputError(f"{place}: found {str(raw)[:60]}, expected one table or more")
    return raw


def one_of(raw: Any, words: Sequence[W], place: str) -> W:
    """Return one of several words."""
    for word in words:
        if raw == word:
            return word
    raise InputError(f"{place}: found {str(raw)[:60]!r}, expected one of {listed(words)}")


def listed(words: Iterable[str]) -> str:
    """Words with commas between them."""
    return ", ".join(words)
