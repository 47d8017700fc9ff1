"""Numbers as a file gives them: finite, and in the shape that is expected."""

from __future__ import annotations

from typing import Any

import numpy as np

__all__ = ["Shape", "numbers"]

Shape = tuple[int | None, ...]
"""Entries along each axis; None is any number of them."""

WORDS: dict[Shape, str] = {
    (): "a number",
    (2,): "a point [x, y]",
    (3,): "a vector [x, y, z]",
    (None,): "a list of numbers",
    (None, 2): "a list of points [x, y]",
    (None, None, 2): "a list of rings, each of them as many points [x, y]",
}


def numbers(raw: object, shape: Shape) -> Any:
    """Read finite numbers, a float or an array, of a shape.

    Raises
    ------
    ValueError
        Says what was found and what was expected.
    """
    expected = WORDS[shape]
    if not _numeric(raw, len(shape)):
        raise ValueError(f"found {_short(raw)}, expected {expected}")
    try:
        found = np.array(raw, dtype=np.float64)
    except (ValueError, OverflowError):
        raise ValueError(f"found {_short(raw)}, expected {expected}") from None
    fits = found.ndim == len(shape) and all(n in (None, m) for n, m in zip(shape, found.shape, strict=True))
    if not fits or not found.size or not np.isfinite(found).all():
        raise ValueError(f"found {_short(raw)}, expected {expected}, all of them finite")
    return found if shape else float(found)


def _numeric(raw: object, axes: int) -> bool:
    if axes:
        return isinstance(raw, list) and all(_numeric(item, axes - 1) for item in raw)
    return isinstance(raw, int | float) and not isinstance(raw, bool)


def _short(raw: object) -> str:
    text = repr(raw)
    return text if len(text) <= 60 else text[:57] + "..."
