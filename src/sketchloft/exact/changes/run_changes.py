"""Run changes: what a stack could be instead, one run at a time."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise

from sketchloft.cloud import Floats
from sketchloft.exact.changes.change import FREE_GAIN, Change, free_gain
from sketchloft.exact.changes.section_radii import SectionRadii, piece_costs, section_radii
from sketchloft.exact.changes.simpler_walls import profiles_like, walls_like
from sketchloft.exact.changes.worth import LEANING
from sketchloft.exact.fit.schwarz import price
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.exact.model.joins import end_pole, natural_joins, sole_profile
from sketchloft.exact.model.surgery import with_run, with_split, with_wall
from sketchloft.exact.section.rarity import rarer
from sketchloft.intervals import cheapest_chain
from sketchloft.outline.polygons import Polygon
from sketchloft.outline.rectilinear import RectilinearPolygon
from sketchloft.stack import Run, Wall
from sketchloft.wall.profile import LineProfile, Profile, SplineProfile
from sketchloft.wall.revolved import Revolved, radius_at, sizes
from sketchloft.wall.swept import Swept

__all__ = ["closings", "fillings", "splits", "swaps"]

PIECE = 8.0
"""What a piece of a profile must gain for there to be more than three, in squared deviations."""
MOST_PIECES = 6
LESS_PLAIN = 2 * LEANING
"""What a piece that is no cylinder must gain besides its price, in the same."""
SHORTEST = 4
"""Radii that each part has at least."""
HOLE = 12.0
"""What a hole must gain: strokes leave many places empty by chance."""
TIP = 0.1
"""Height, in sizes of the cloud, of the tip that a flat end may lack to be taken for a pole."""
STRAIGHT = 4.0
"""Log odds for a straight wall of circles, against one that hardly bulges or leans."""
FLAT = 6.0
"""What a flat end must gain over a pole."""

Prices = tuple[float, float]
"""Of each number of a piece, and what one that is no cylinder must gain besides."""
Cuts = tuple[int, ...]


def splits(points: Floats, model: ExactModel, together: float) -> Iterator[Change]:
    """Runs of lines or arcs, many, three or two, for a revolved one, cut where they fit the points best.

    Parameters
    ----------
    points : (n, 3) float array
    model : ExactModel
    together : float
        How many of the points go together.

    Notes
    -----
    They are found at the price that a number has by Akaike's criterion, which follows the points, and by
    Schwarz's, which models are judged by and which sees cylinders where the first sees cones.
    """
    prices = (2.0, 0.0), (2 * price(1, len(points), together), LESS_PLAIN)
    for j, (run, low, high) in enumerate(model.stack.slabs()):
        wall = sole_profile(run)
        found = None if wall is None else section_radii(points, wall, (low, high), together)
        if wall is None or found is None:
            continue
        free = _is_free(wall)
        for pieces in zip(*(_pieces(found, each) for each in prices), strict=True):
            for cuts, profiles in filter(None, pieces):
                walls = [replace(wall, profile=profile) for profile in profiles]
                heights = [float(found.heights[k - 1 : k + 1].mean()) for k in cuts[1:-1]]
                split = with_split(model, j, heights, walls)
                handicap = -free_gain(len(walls), 0, len(points), together) if free else 0.0
                yield Change(split, range(j, j + len(walls)), handicap, free=free)


def _pieces(found: SectionRadii, prices: Prices) -> Iterator[tuple[Cuts, list[Profile]] | None]:
    """Where radii are best cut into many pieces, three and two, and these; None where they cannot be."""
    cost = piece_costs(found, SHORTEST, *prices)
    last = len(found.heights)
    inner = range(SHORTEST, last - SHORTEST + 1)
    many = tuple(cheapest_chain(cost + PIECE)[0])
    for cuts in (
        [many] if 4 <= len(many) - 1 <= MOST_PIECES else [],
        [(0, k, m, last) for k in inner for m in inner if m >= k + SHORTEST],
        [(0, k, last) for k in inner],
    ):
        best = min(cuts, key=lambda cut: sum(cost[pair] for pair in pairwise(cut)), default=None)
        yield None if best is None else (best, [_closest(found, *pair, prices) for pair in pairwise(best)])


def _closest(found: SectionRadii, start: int, stop: int, prices: Prices) -> Profile:
    """The line or arc that costs least in the place of some radii, as `piece_costs`."""
    part, (each, leaning) = slice(start, stop), prices
    z, r, deviation = found.heights[part], found.radii[part], found.deviations[part]

    def cost(profile: Profile) -> float:
        numbers = sizes(profile)
        left = float((((radius_at(profile, z)[0] - r) / deviation) ** 2).sum())
        return left + each * numbers + (leaning if numbers > 1 else 0.0)

    return min(profiles_like(z, r), key=cost)


def swaps(model: ExactModel) -> Iterator[Change]:
    """A wall of another kind in the place of each."""
    for j, (run, low, high) in enumerate(model.stack.slabs()):
        for i, wall in enumerate(run.walls):
            for other in walls_like(wall, low, high):
                free = _is_free(wall) or _bends(wall, other)
                changed = with_wall(model, j, i, other)
                handicap = -FREE_GAIN if _is_free(wall) else rarer([other], [wall])
                handicap -= STRAIGHT if _straightens(wall, other) else 0.0
                yield Change(changed, range(j, j + 1), handicap, free=free)


def _straightens(wall: Wall, other: Wall) -> bool:
    """Whether a cylinder or a cone takes the place of a wall of circles that bulges or leans a little."""
    plain = isinstance(other, Revolved) and isinstance(other.profile, LineProfile)
    return plain and (isinstance(wall, Swept) or wall.kind == "torus")


def fillings(model: ExactModel) -> Iterator[Change]:
    """Runs without one of their holes."""
    for j, run in enumerate(model.stack.runs):
        for i in range(len(run.walls) - run.holes, len(run.walls)):
            filled = Run((*run.walls[:i], *run.walls[i + 1 :]), run.holes - 1)
            yield Change(with_run(model, j, filled), range(j, j + 1), -HOLE)


def closings(model: ExactModel) -> Iterator[Change]:
    """Spheres and domes that end flat a little before their pole, with the pole."""
    runs, breaks = model.stack.runs, model.stack.breaks
    for k, j, side in ((0, 0, -1), (len(runs), len(runs) - 1, 1)):
        pole = end_pole(runs[j], side)
        if model.joins[k] == "step" and pole is not None and 0 < side * (pole - breaks[k]) < TIP:
            moved = breaks.copy()
            moved[k] = pole
            closed = natural_joins(model.between(moved))
            yield Change(closed, range(j, j + 1), -FLAT)


def _is_free(wall: Wall) -> bool:
    return isinstance(wall, Revolved) and isinstance(wall.profile, SplineProfile)


def _bends(wall: Wall, other: Wall) -> bool:
    """Whether the other has corners of any angle where the wall's are right: its noise must tell."""
    if not isinstance(wall, Swept) or not isinstance(other, Swept):
        return False
    return isinstance(wall.outline, RectilinearPolygon) and isinstance(other.outline, Polygon)
