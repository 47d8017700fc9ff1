"""Soundness: whether a model's walls can bound a solid at all, before points judge it."""

from __future__ import annotations

from itertools import permutations

import numpy as np
from numpy.typing import NDArray

from sketchloft.cloud import Floats
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.exact.model.joins import poles
from sketchloft.outline.chain_outline import ChainOutline
from sketchloft.outline.polygons import LineArc, Polygon, thin_cuts
from sketchloft.outline.rectilinear import RectilinearPolygon
from sketchloft.outline.rounded_polygon import RoundedPolygon
from sketchloft.outline.spline_loop import SplineLoop
from sketchloft.ring import ring_area
from sketchloft.stack import Run, Wall, section_boundary
from sketchloft.wall.filleted import Filleted
from sketchloft.wall.lofted import Lofted
from sketchloft.wall.profile import ends_of
from sketchloft.wall.revolved import Revolved
from sketchloft.wall.ruled import SAMPLES, Ruled
from sketchloft.wall.swept import Swept

__all__ = ["covers", "detached", "slits", "sound"]

MAY_CROSS = (Polygon, LineArc, RectilinearPolygon, RoundedPolygon, SplineLoop)
"""Outlines that may cross themselves."""
FARTHEST = 1e4
"""Parameters are below this, as the cloud is about 1 across."""
LEFT = 0.02
"""Share of a section that its holes leave at least."""
ROOM = 0.49
"""Largest fillet, in shares of a prism's edges."""
AROUND = 32
LEVELS = np.arange(17) / 16
"""Shares of a run's height at which its sections are looked at."""
INNER = slice(5, -5)
"""Which of these are the ones away from its ends."""


def sound(model: ExactModel) -> bool:
    """Whether the breaks rise, and every wall encloses something and nowhere crosses itself."""
    breaks = model.stack.breaks
    if not (np.abs(model.vector) < FARTHEST).all() or not (np.diff(breaks) > 0).all():
        return False
    for j, run in enumerate(model.stack.runs):
        if not all(covers(wall, breaks[j], breaks[j + 1]) and _closes(wall) for wall in run.walls):
            return False
        ends = breaks[j] + (breaks[j + 1] - breaks[j]) * LEVELS
        at = ends[INNER]  # a sphere may end before its break does
        pieces = _outer(run, at)  # none where the loop of a hole is looked at by itself
        if run.holes and pieces and (run.area(at) < LEFT * sum(pieces)).any():
            return False
        if len(run.walls) > 1 and not all(_apart(run, height) for height in (at[0], at[-1])):
            return False
        if any((wall.area(at) <= 0).any() or not _simple(wall, ends[::2]) for wall in run.walls):
            return False
    return True


def _apart(run: Run, height: float) -> bool:
    """Whether the pieces of a section lie beside each other, and the holes too, each of them in a piece."""
    rings = [section_boundary(wall, height, AROUND).points for wall in run.walls]
    pieces = len(run.walls) - run.holes
    pairs = [*permutations(range(pieces), 2), *permutations(range(pieces, len(rings)), 2)]
    if any(_overlap(rings[i], rings[k]) and _within(run.walls[i], rings[k]).any() for i, k in pairs):
        return False
    return all(
        np.any([_within(wall, ring) for wall in run.walls[:pieces]], axis=0).all() for ring in rings[pieces:]
    )


def _overlap(ring: Floats, other: Floats) -> bool:
    """Whether the boxes around two rings have a place in common."""
    low = np.maximum(ring.min(axis=0), other.min(axis=0))
    return bool((low <= np.minimum(ring.max(axis=0), other.max(axis=0))).all())


def _within(wall: Wall, ring: Floats) -> NDArray[np.bool_]:
    """(m,) whether points (m, 3) are inside a wall."""
    return np.asarray(wall.foot(ring).distance < 0)


def _outer(run: Run, heights: Floats) -> list[Floats]:
    return [wall.area(heights) for wall in run.walls[: len(run.walls) - run.holes]]


def detached(model: ExactModel) -> int:
    """Number of walls that end before a break that other runs lie beyond, so that these hang on nothing."""
    return sum(_ends_within(wall, model, j) for j, run in enumerate(model.stack.runs) for wall in run.walls)


def _ends_within(wall: Wall, model: ExactModel, j: int) -> bool:
    """Whether a sphere or a dome ends before a break that other runs lie beyond."""
    low, high = poles(wall)
    below, above = model.stack.breaks[j], model.stack.breaks[j + 1]
    return bool((j > 0 and below < low) or (j + 1 < len(model.stack.runs) and above > high))


def slits(model: ExactModel) -> float:
    """Number of slits in outlines, as a search may pass through and no designer draws, by their thinness."""
    outlines = [wall.outline for wall in model.stack.walls if isinstance(wall, Swept)]
    return sum(thin_cuts(*outline.chain()) for outline in outlines if isinstance(outline, ChainOutline))


def _closes(wall: Wall) -> bool:
    """Whether a wall that bows is part of an ellipsoid, or of its like over another outline."""
    return not isinstance(wall, Swept) or not wall.bows or abs(wall.bow) > abs(wall.taper)


def _simple(wall: Wall, heights: Floats) -> bool:
    """Whether the sections at heights (m,) nowhere cross themselves, and are not turned inside out."""
    from shapely import is_valid, linearrings, polygons  # noqa: PLC0415

    if isinstance(wall, Lofted):
        count = 4 * wall.poles.shape[1]
        rings = wall.ring(heights, np.arange(count) / count)
    elif isinstance(wall, Ruled):
        rings = wall.ring(heights, SAMPLES).reshape(len(heights), -1, 2)
    elif isinstance(wall, Swept) and isinstance(wall.outline, MAY_CROSS):
        rings = wall.outline.boundary(64).points[None]
    else:
        return True
    outwards = all(ring_area(ring) > 0 for ring in rings)
    return outwards and bool(is_valid(polygons(linearrings(rings))).all())


def covers(wall: Wall, low: float, high: float) -> bool:
    """Whether a spline's knots, or a torus, reach over a stretch of heights."""
    ends = (-np.inf, np.inf)
    if isinstance(wall, Lofted):
        ends = wall.knots[0], wall.knots[-1]
    if isinstance(wall, Revolved):
        if wall.kind != "sphere":  # which may end before its run does
            ends = ends_of(wall.profile)
        if wall.kind == "spline revolve" and not (wall.area(low + (high - low) * LEVELS) > 0).all():
            return False
    if isinstance(wall, Filleted):
        return _fits(wall.between(low, high))
    return bool(ends[0] <= low and high <= ends[1])


def _fits(wall: Filleted) -> bool:
    """Whether the fillets of a prism leave room between them."""
    return 0 < wall.radius < ROOM * min(wall.outline.width, wall.outline.height, wall.high - wall.low)
