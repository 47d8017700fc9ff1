"""Round ends: revolved runs at the ends of a stack that may end with half a sphere of their own radius."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.changes.change import CHAIN_GAIN, FREE_GAIN, Change
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.exact.model.joins import natural_joins, sole_profile
from sketchloft.exact.model.surgery import with_runs, with_split
from sketchloft.outline.circle import Circle
from sketchloft.stack import Run
from sketchloft.wall.profile import ArcProfile, LineProfile, Profile, SplineProfile
from sketchloft.wall.revolved import Revolved, radius_at
from sketchloft.wall.swept import Swept

__all__ = ["capped", "round_ends"]

HEIGHTS = 25
SHORTEST = 0.2
"""Length of the cylinder between round ends at least, in its radius: what is shorter is a sphere."""
BEYOND = 1 / 6
"""How far the pole of half a sphere is beyond a flat end that was fitted to it, about, in its radius: with a
third the volumes were the same."""
SIDES = ((-1, 1), (-1,), (1,))


def round_ends(model: ExactModel) -> Iterator[Change]:
    """Half a sphere of its own radius at an end of a cylinder, or at both, for what is there instead.

    Notes
    -----
    That is part of a revolved run at an end of the stack, or a run of circles beyond a cylinder. The halves
    have the axis and the radius of the cylinder from the start, so that three runs have no more numbers than
    one. Otherwise a curve that follows a few points takes the place of both ends.
    """
    last = len(model.stack.runs) - 1
    for j, (run, low, high) in enumerate(model.stack.slabs()):
        wall = sole_profile(run)
        if wall is None or isinstance(wall.profile, ArcProfile):
            continue
        free = isinstance(wall.profile, SplineProfile)
        beyond = 0.0 if free else BEYOND
        radius = float(np.median(radius_at(wall.profile, np.linspace(low, high, HEIGHTS))[0]))
        for sides in SIDES:
            at_ends = (j == 0 or -1 not in sides) and (j == last or 1 not in sides)
            if at_ends and high - low > (len(sides) + SHORTEST) * radius:
                poles = low - beyond * radius * (-1 in sides), high + beyond * radius * (1 in sides)
                heights, walls = capped(wall.centre, radius, poles, sides)
                simpler = (CHAIN_GAIN if len(walls) > 2 else FREE_GAIN) if free else 0.0
                split = _reaching(with_split(model, j, heights, walls), poles, sides)
                yield Change(split, range(j, j + len(walls)), -simpler, free=free)
    for end, j, side in ((0, 1, -1), (last, last - 1, 1)):
        if last > 0 and _bulges(model.stack.runs[end]):
            yield from _cap(model, j, side)


def _reaching(model: ExactModel, poles: tuple[float, float], sides: tuple[int, ...]) -> ExactModel:
    """The model with its ends at poles, on some sides."""
    breaks = model.stack.breaks.copy()
    for side, end, pole in ((-1, 0, poles[0]), (1, -1, poles[1])):
        breaks[end] = pole if side in sides else breaks[end]
    return natural_joins(model.between(breaks))


def _bulges(run: Run) -> bool:
    """Whether a run of circles is none of the plain kinds."""
    wall = run.walls[0]
    swept = isinstance(wall, Swept) and isinstance(wall.outline, Circle)
    return len(run.walls) == 1 and (swept or wall.kind in ("torus", "spline revolve"))


def _cap(model: ExactModel, j: int, side: int) -> Iterator[Change]:
    """Half a sphere for the run beyond a cylinder, on one side of it."""
    wall = sole_profile(model.stack.runs[j])
    if wall is None or wall.kind != "cylinder":
        return
    first, last = sorted((j, j + side))
    low, high = model.stack.breaks[[first, last + 1]].tolist()
    radius = float(radius_at(wall.profile, np.array([low]))[0][0])
    if high - low > (1 + SHORTEST) * radius:
        heights, walls = capped(wall.centre, radius, (low, high), (side,))
        one = with_runs(model, first, last, model.stack.runs[j])
        yield Change(with_split(one, first, heights, walls), range(first, last + 1))


def capped(
    centre: Floats, radius: float, ends: tuple[float, float], sides: tuple[int, ...]
) -> tuple[list[float], list[Revolved]]:
    """Walls of a cylinder with half a sphere at some sides, -1 and 1, and the heights between them."""
    low, high = ends[0] + radius * (-1 in sides), ends[1] - radius * (1 in sides)
    profiles: list[Profile] = [LineProfile((low + high) / 2, radius, None)]
    if -1 in sides:
        profiles.insert(0, ArcProfile(low, None, radius))
    if 1 in sides:
        profiles.append(ArcProfile(high, None, radius))
    heights = [height for side, height in ((-1, low), (1, high)) if side in sides]
    return heights, [Revolved(centre, profile) for profile in profiles]
