"""Inset: the rectangle at an even distance inside another."""

from __future__ import annotations

from dataclasses import replace

from sketchloft.outline.placed_polygons import Rectangle, RoundedRectangle

__all__ = ["Insettable", "inset"]

Insettable = Rectangle | RoundedRectangle
LEAST = 1e-9
"""Lengths of an outline that an inset has used up."""


def inset(outline: Insettable, depth: float) -> Insettable:
    """Return the outline whose points are the depth inside; fillets get tighter, corners stay sharp."""
    width, height = (max(side - 2 * depth, LEAST) for side in (outline.width, outline.height))
    if isinstance(outline, Rectangle):
        return replace(outline, width=width, height=height)
    radius = min(max(outline.radius - depth, 0.0), min(width, height) / 2)
    return replace(outline, width=width, height=height, radius=radius)
