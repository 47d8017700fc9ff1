"""Set upon: a wall moved to the outline that another one has where they meet."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from sketchloft.exact.model.kinks import end_outline
from sketchloft.outline.chain_outline import ChainOutline
from sketchloft.outline.outline import Outline
from sketchloft.outline.placed_polygons import Rectangle
from sketchloft.wall.ruled import Ruled
from sketchloft.wall.swept import Swept

__all__ = ["moved_off", "set_upon"]

QUARTER = np.pi / 2


def set_upon(wall: Swept | Ruled, other: Swept | Ruled, height: float, side: int) -> Swept | Ruled | None:
    """The wall upon the outline of one beyond its lower (-1) or upper (1) end, if it can be."""
    if isinstance(wall, Ruled):
        return _between_rectangles(wall, end_outline(other, -side), side)
    if isinstance(other, Swept) and wall.free and "height" not in wall.free:
        return moved_off(wall, other, height)
    return None


def _between_rectangles(wall: Ruled, outline: Outline | ChainOutline, side: int) -> Ruled | None:
    """The wall between rectangles, one of them another one and the other turned as that is."""
    near, far = (wall.bottom, wall.top) if side < 0 else (wall.top, wall.bottom)
    if not (isinstance(near, Rectangle) and isinstance(far, Rectangle) and isinstance(outline, Rectangle)):
        return None
    quarters = round((outline.angle - far.angle) / QUARTER)
    sides = (far.height, far.width) if quarters % 2 else (far.width, far.height)
    centre = outline.centre if np.array_equal(near.centre, far.centre) else far.centre
    turned = Rectangle(centre, *sides, outline.angle)
    return (
        replace(wall, bottom=outline, top=turned) if side < 0 else replace(wall, bottom=turned, top=outline)
    )


def moved_off(wall: Swept, other: Swept, height: float) -> Swept:
    """The wall upon the outline of another one, so that both have the same section at a height."""
    at = np.array([height])
    here, there = float(wall.scale(at)[0]), float(other.scale(at)[0])
    taper = wall.taper * there / here
    start = height - (there - 1) / taper if taper else height
    moved = replace(wall, outline=other.outline, height=start, taper=taper, free=(*wall.free, "height"))
    return moved.about_centre()
