"""Which shape each slice gets: by hand, for all or single slices, or by evidence (paper, section 4.7)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, get_args

from sketchloft.errors import UsageError

__all__ = ["Choice", "ShapesParams", "choices", "parse_shapes"]

Choice = Literal["auto", "off", "circle", "ellipse", "rectangle"]
CHOICES: tuple[Choice, ...] = get_args(Choice)


@dataclass(frozen=True)
class ShapesParams:
    """How the sections' shapes are recognised.

    Parameters
    ----------
    shapes : str
        One of "auto", "off" (closed splines), "circle", "ellipse", "rectangle" for all slices, or single
        slices and ranges of them, counted from 0: "3:circle,7-9:rectangle"; the other slices are as the
        word without a number says, "auto" if there is none.
    """

    shapes: str = "auto"


def choices(asked: str, count: int) -> tuple[Choice, ...]:
    """Read what is asked for.

    Parameters
    ----------
    asked : str
        As in `ShapesParams`.
    count : int
        Number of slices.

    Returns
    -------
    tuple of str
        One choice per slice.

    Raises
    ------
    UsageError
        If a word is unknown or a slice does not exist.
    """
    parts = [part.strip().rpartition(":") for part in asked.split(",")]
    chosen: list[Choice] = ["auto"] * count
    for place, _, word in parts:
        if not place:
            chosen = [_known(word)] * count
    for place, _, word in parts:
        if place:
            first, last = _range(place, count)
            chosen[first : last + 1] = [_known(word)] * (last + 1 - first)
    return tuple(chosen)


def parse_shapes(text: str) -> str:
    """Check the words of `ShapesParams.shapes`; which slices exist is not known yet.

    Raises
    ------
    UsageError
        If a word is unknown.
    """
    for part in text.split(","):
        _known(part.strip().rpartition(":")[2])
    return text


def _known(word: str) -> Choice:
    for choice in CHOICES:
        if word.strip() == choice:
            return choice
    raise UsageError(f"shapes: found '{word}', expected one of {', '.join(CHOICES)}")


def _range(text: str, count: int) -> tuple[int, int]:
    first, dash, last = text.partition("-")
    try:
        low = int(first)
        high = int(last) if dash else low
    except ValueError:
        raise UsageError(
            f"shapes: found '{text}' for slices, expected a number or a range such as 7-9"
        ) from None
    if not 0 <= low <= high < count:
        raise UsageError(f"shapes: found slices {text}, but the slices are 0 to {count - 1}")
    return low, high
