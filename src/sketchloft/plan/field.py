"""Fields: the values that describe a wall, what they are called and measured in, and what they may be."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from sketchloft.plan.numbers import Shape, numbers
from sketchloft.plan.plan import Numbers

__all__ = ["Choice", "Field", "Fitted", "Number", "Quantity"]

Quantity = Literal["length", "ratio", "angle", "per length", "angle per length", "count"]
Fitted = Literal["each", "across", "curved", "no"]

DEGREES = 180 / np.pi


@dataclass(frozen=True)
class Number:
    """A number, or an array of them.

    Parameters
    ----------
    name : str
        In the file.
    attribute : str
        In the wall or outline.
    quantity : Quantity
        In the file: lengths in the cloud's unit, angles in degrees.
    shape : tuple of int or None
        None is any length.
    fitted : {"each", "across", "curved", "no"}
        How many of a wall's parameters it is: one for each number; one for each point, across the wall;
        one for each number that is not 0; or none.
    required : bool
    least : int
        Fewest entries of an array; smallest count.
    sign : {"any", "positive", "not negative"}
    """

    name: str
    attribute: str
    quantity: Quantity = "length"
    shape: Shape = ()
    fitted: Fitted = "each"
    required: bool = True
    least: int = 1
    sign: Literal["any", "positive", "not negative"] = "any"

    def parse(self, raw: object) -> Numbers:
        """Read a value of a file.

        Raises
        ------
        ValueError
            Says what was found and what was expected.
        """
        value = numbers(raw, self.shape)
        if self.quantity == "count" and (value != round(value) or value < self.least):
            raise ValueError(f"found {raw!r}, expected a whole number from {self.least}")
        least = np.min(value)
        if (self.sign != "any" and least < 0) or (self.sign == "positive" and least == 0):
            raise ValueError(f"found {raw!r}, expected a {self.sign} number")
        if self.shape[:1] == (None,) and len(value) < self.least:
            raise ValueError(f"found a list of {len(value)}, expected at least {self.least} entries")
        return int(value) if self.quantity == "count" else value

    def stored(self, value: Any, scale: float) -> Numbers:
        """Value in a file of one in a wall whose unit of length has this size."""
        if self.quantity == "count":
            return int(value)
        found = np.asarray(value, dtype=np.float64) * self._factor(scale)
        return found if self.shape else float(found)

    def modelled(self, value: Any, scale: float) -> Any:
        """Value in a wall of one in a file."""
        return int(value) if self.quantity == "count" else value / self._factor(scale)

    def entries(self, value: Any) -> int:
        """How many of a wall's parameters a value is."""
        every = np.size(value)
        curved = int(np.count_nonzero(value))
        return {"each": every, "across": every // 2, "curved": curved, "no": 0}[self.fitted]

    def _factor(self, scale: float) -> float:
        match self.quantity:
            case "length":
                return scale
            case "per length":
                return 1 / scale
            case "angle":
                return DEGREES
            case "angle per length":
                return DEGREES / scale
            case _:
                return 1.0


@dataclass(frozen=True)
class Choice:
    """One of several words.

    Parameters
    ----------
    name, attribute : str
    words : mapping of str to object
        What each stands for; the first is taken where none is written.
    """

    name: str
    attribute: str
    words: Mapping[str, Any]
    required: bool = False

    def parse(self, raw: object) -> str:
        """Read a value of a file, as `Number.parse`."""
        if not isinstance(raw, str) or raw not in self.words:
            raise ValueError(f"found {raw!r}, expected one of " + ", ".join(map(repr, self.words)))
        return raw

    def stored(self, value: Any, _: float) -> str:
        """Return the word for a value."""
        return next(word for word, meaning in self.words.items() if meaning == value)

    def modelled(self, value: Any, _: float) -> Any:
        """Return the value that a word stands for."""
        return self.words[value]

    def entries(self, _: Any) -> int:
        """No parameter."""
        return 0


Field = Number | Choice
