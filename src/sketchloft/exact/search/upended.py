"""Upended: a box stood on another of its faces, from where more of its edges may be rounded ones."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.changes.evidence import improved
from sketchloft.exact.changes.filleted_walls import fillets
from sketchloft.exact.changes.worth import worth
from sketchloft.exact.fit.fit_density import fit_density
from sketchloft.exact.fit.likelihood import value_of
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.exact.model.surgery import with_run
from sketchloft.exact.search.box_along import box_along, box_sizes, evenly_filled
from sketchloft.outline.candidates import rectangle_of
from sketchloft.outline.placed_polygons import Rectangle, RoundedRectangle
from sketchloft.outline.stadium import Stadium
from sketchloft.stack import Run, Stack, Wall
from sketchloft.wall.swept import Swept
from sketchloft.workers import ALONE, Workers

__all__ = ["upended"]

AROUND = 96
FILLED = 0.9
"""Share of the rectangle around it that the section of a box fills, edges rounded or not."""
HINT = 0.5
"""Log likelihood of independent points that fillets of a given size must gain for others to be tried."""


def upended(
    points: Floats,
    first: ExactModel,
    model: ExactModel,
    together: float,
    *,
    lofts: bool,
    workers: Workers = ALONE,
) -> tuple[ExactModel, Floats]:
    """Stand a box on another face where fillets that are seen from there explain more.

    Parameters
    ----------
    points : (n, 3) float array
    first : ExactModel
        What the search began with: where that is a box and the model is none any more, it may be that its
        fillets were taken for runs.
    model : ExactModel
    together : float
        How many of the points go together.
    lofts : bool
        Whether free lofts are tried.
    workers : Workers, optional

    Returns
    -------
    ExactModel
    (3, 3) float array
        The rotation: new points = old points @ rotation.

    Notes
    -----
    A box is the same along either of its edges, so that its sections do not tell the direction. Fillets do:
    those along one edge, or around one face, are rounded corners or ends of a prism along that edge only.
    """
    best, turn = model, np.eye(3)
    box = model if len(model.stack.runs) == 1 else replace(first, sigma=model.sigma)
    for other, rotation in _stood_otherwise(points, box):
        turned = points @ rotation
        least = value_of(turned, other) + HINT * together
        if max(value_of(turned, with_run(other, 0, Run((wall,)))) for wall in _rounded(other)) > least:
            found = improved(turned, other, together, lofts=lofts, workers=workers)
            if best is model:
                best = fit_density(points, model)
            if _worth(turned, found, together) > _worth(points @ turn, best, together):
                best, turn = found, rotation
    return best, turn


def _worth(points: Floats, model: ExactModel, together: float) -> float:
    return worth(points, model, together, len(points))


def _stood_otherwise(points: Floats, model: ExactModel) -> list[tuple[ExactModel, Floats]]:
    """The box along its two other edges, and the rotations that bring these along z; none if it is no box."""
    (run, low, high), *others = model.stack.slabs()
    wall = run.walls[0]
    if others or len(run.walls) > 1 or not isinstance(wall, Swept) or wall.free:
        return []
    outline = wall.outline
    if isinstance(outline, (RoundedRectangle, Stadium)):
        return []
    box = outline if isinstance(outline, Rectangle) else rectangle_of(outline.boundary(AROUND).points)
    if outline.area < FILLED * box.area:
        return []
    density = len(points) / float(box_sizes(box, low, high).prod())
    found = []
    for edge in (0, 1):
        seen = box_along(box, low, high, edge)
        sharp = replace(wall, outline=Rectangle(seen.centre, seen.width, seen.height, 0.0))
        stood = evenly_filled(Stack(np.array(seen.ends), (Run((sharp,)),)), model, density)
        found.append((fit_density(points @ seen.turn, stood), seen.turn))
    return found


def _rounded(model: ExactModel) -> Iterator[Wall]:
    """The box with fillets on the edges along it, on all edges, and on those of either end."""
    wall = model.stack.runs[0].walls[0]
    if isinstance(wall, Swept) and isinstance(wall.outline, Rectangle):
        for prisms in map(list, fillets(wall.outline)):
            yield replace(wall, outline=prisms[0].outline)
            yield from prisms
