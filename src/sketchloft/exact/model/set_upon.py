"""Set upon: a wall moved to the outline that another one has where they meet."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.exact.model.kinks import end_outline, kink_ties, sole_wall
from sketchloft.exact.model.surgery import with_run
from sketchloft.outline.chain_outline import ChainOutline
from sketchloft.outline.outline import Outline
from sketchloft.outline.placed_polygons import Rectangle
from sketchloft.stack import Run
from sketchloft.wall.ruled import Ruled
from sketchloft.wall.swept import Swept

__all__ = ["moved_off", "set_upon_each_other", "with_bend"]

QUARTER = np.pi / 2


def set_upon_each_other(model: ExactModel, k: int) -> Iterator[tuple[int, Swept | Ruled]]:
    """Runs beside a step, each with its wall upon the outline of the other one, where it can be."""
    below, above = (sole_wall(run) for run in model.stack.runs[k - 1 : k + 1])
    if below is None or above is None or model.joins[k] != "step":
        return
    height = float(model.stack.breaks[k])
    for j, wall, other, side in ((k, above, below, -1), (k - 1, below, above, 1)):
        moved = _set_upon(wall, other, height, side)
        if moved is not None:
            yield j, moved


def with_bend(model: ExactModel, k: int, j: int, wall: Swept | Ruled) -> ExactModel | None:
    """The model with a wall in run j, if it and its neighbour meet at break k with one outline then."""
    bent = with_run(model, j, Run((wall,)))
    return bent if kink_ties(bent.stack.runs[k - 1], bent.stack.runs[k], k) else None


def _set_upon(wall: Swept | Ruled, other: Swept | Ruled, height: float, side: int) -> Swept | Ruled | None:
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
