"""Kinked: neighbouring runs whose sections are the same at their break, as far as the points can tell."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.exact.model.kinks import end_outline, kink_ties, sole_wall
from sketchloft.exact.model.surgery import with_run
from sketchloft.exact.search.as_many_as_pay import fitted_if_it_pays
from sketchloft.outline.chain_outline import ChainOutline
from sketchloft.outline.outline import Outline
from sketchloft.outline.placed_polygons import Rectangle
from sketchloft.stack import Run, section_boundary
from sketchloft.wall.ruled import Ruled
from sketchloft.wall.swept import Swept

__all__ = ["kinked"]

NEAR, NOISES = 0.01, 4.0
"""Sections may be one that are apart by so much of the size, and so many noise deviations, at most."""
NODES = 64
QUARTER = np.pi / 2


def kinked(points: Floats, model: ExactModel, together: float) -> ExactModel:
    """Give swept and ruled walls that meet at a break one outline there, where the likelihood allows it.

    Parameters
    ----------
    points : (n, 3) float array
        All points.
    model : ExactModel
        Fitted to them.
    together : float
        How many of the points go together.

    Notes
    -----
    A roof stands upon its house: without this a thin ledge would be left all around.
    """
    for k in range(1, len(model.stack.runs)):
        model = fitted_if_it_pays(points, model, _bent(model, k), together)
    return model


def _bent(model: ExactModel, k: int) -> Iterator[ExactModel]:
    """The model with one outline for the runs below and above a break, if their sections are near."""
    below, above = (sole_wall(run) for run in model.stack.runs[k - 1 : k + 1])
    if below is None or above is None or model.joins[k] != "step":
        return
    height = float(model.stack.breaks[k])
    if max(_apart(below, above, height), _apart(above, below, height)) > NEAR + NOISES * model.sigma:
        return
    for run, wall, other, side in ((k, above, below, -1), (k - 1, below, above, 1)):
        moved = _moved_to(wall, other, height, side)
        bent = None if moved is None else with_run(model, run, Run((moved,)))
        if bent is not None and kink_ties(bent.stack.runs[k - 1], bent.stack.runs[k], k):
            yield bent


def _apart(wall: Swept | Ruled, other: Swept | Ruled, height: float) -> float:
    """How far the section of a wall is from another wall at most."""
    return float(np.abs(other.foot(section_boundary(wall, height, NODES).points).distance).max())


def _moved_to(wall: Swept | Ruled, other: Swept | Ruled, height: float, side: int) -> Swept | Ruled | None:
    """The wall upon the outline of one beyond its lower (-1) or upper (1) end, if it can be."""
    if isinstance(wall, Ruled):
        return _set_upon(wall, end_outline(other, -side), side)
    if isinstance(other, Swept) and wall.free and "height" not in wall.free:
        return _moved_off(wall, other, height)
    return None


def _set_upon(wall: Ruled, outline: Outline | ChainOutline, side: int) -> Ruled | None:
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


def _moved_off(wall: Swept, other: Swept, height: float) -> Swept:
    """The wall upon the outline of another one, so that both have the same section at a height."""
    at = np.array([height])
    here, there = float(wall.scale(at)[0]), float(other.scale(at)[0])
    taper = wall.taper * there / here
    start = height - (there - 1) / taper if taper else height
    moved = replace(wall, outline=other.outline, height=start, taper=taper, free=(*wall.free, "height"))
    return moved.about_centre()
