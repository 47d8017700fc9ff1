"""Kinks: where a wall begins to taper, drift or twist away from one that has the same outline there."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np

from sketchloft.exact.model.exact_model import Tie
from sketchloft.outline.chain_outline import ChainOutline
from sketchloft.outline.outline import Outline
from sketchloft.outline.placed_polygons import Rectangle
from sketchloft.stack import Run, Wall
from sketchloft.wall.ruled import Ruled
from sketchloft.wall.swept import Swept

__all__ = [
    "end_outline",
    "kink",
    "kink_ties",
    "sole_wall",
    "squared_ties",
    "with_kink",
    "without_loose_heights",
]

Walls = tuple[Swept | Ruled, Swept | Ruled]


def sole_wall(run: Run) -> Swept | Ruled | None:
    """Return the wall of a run that has one only, and that swept or ruled."""
    wall = run.walls[0]
    return wall if len(run.walls) == 1 and isinstance(wall, (Swept, Ruled)) else None


def end_outline(wall: Swept | Ruled, side: int) -> Outline | ChainOutline:
    """Outline that a wall has at its lower (-1) or upper end (1), or that it is carried from."""
    if isinstance(wall, Swept):
        return wall.outline
    return wall.bottom if side < 0 else wall.top


def kink(below: Run, above: Run) -> float | None:
    """Height at which two swept walls of the same outline have the same section, where one's height is free.

    Parameters
    ----------
    below, above : Run
    """
    first, last = _of_one_outline(below, above) or (None, None)
    if not isinstance(first, Swept) or not isinstance(last, Swept):
        return None
    for wall, other in ((last, first), (first, last)):
        if "height" not in wall.free:
            continue
        if other.still:
            return wall.height
        if _only_tapers(wall) and _only_tapers(other) and np.array_equal(wall.pivot, other.pivot):
            bend = wall.taper - other.taper
            return (wall.taper * wall.height - other.taper * other.height) / bend if bend else None
    return None


def kink_ties(below: Run, above: Run, j: int) -> list[Tie]:
    """What two walls, of run j - 1 and j, that meet in a kink have in common."""
    walls = _of_one_outline(below, above)
    if walls is None or not (_kept(walls) or kink(below, above) is not None):
        return []
    first, last = walls
    lead = len(first.bottom.vector) if isinstance(first, Ruled) else 0
    return [((j - 1, 0, lead + k), (j, 0, k)) for k in range(len(end_outline(last, -1).vector))]


def squared_ties(run: Run, j: int) -> list[Tie]:
    """What both ends of the ruled wall of run j have in common if they are rectangles turned alike."""
    wall = sole_wall(run)
    if not isinstance(wall, Ruled):
        return []
    if not (isinstance(wall.bottom, Rectangle) and isinstance(wall.top, Rectangle)):
        return []
    below, above = wall.bottom.vector, wall.top.vector
    if wall.bottom.angle != wall.top.angle:
        return []
    shared = [0, 1, 4] if np.array_equal(below[:2], above[:2]) else [4]
    return [((j, 0, k), (j, 0, len(below) + k)) for k in shared]


def with_kink(below: Run, above: Run) -> tuple[Run, Run]:
    """Free the height of one of two walls of the same outline, so that they may meet in a kink there."""
    first, last = _of_one_outline(below, above) or (None, None)
    if not isinstance(first, Swept) or not isinstance(last, Swept) or kink(below, above) is not None:
        return below, above
    if not last.still:
        return below, Run((_with_height(last),))
    return (below if first.still else Run((_with_height(first),))), above


def without_loose_heights(runs: tuple[Run, ...]) -> tuple[Run, ...]:
    """Hold the heights of walls that meet no other wall in a kink: they would say what the outline does."""
    if not any(isinstance(wall, Swept) and "height" in wall.free for run in runs for wall in run.walls):
        return runs
    bent = [False, *(kink(*pair) is not None for pair in pairwise(runs)), False]
    return tuple(
        run if bent[j] or bent[j + 1] else Run(tuple(map(_with_height_held, run.walls)), run.holes)
        for j, run in enumerate(runs)
    )


def _with_height_held(wall: Wall) -> Wall:
    if not isinstance(wall, Swept):
        return wall
    return replace(wall, free=tuple(name for name in wall.free if name != "height"))


def _of_one_outline(below: Run, above: Run) -> Walls | None:
    """The walls of two runs that have one each, of exactly the same outline at their break; or None."""
    first, last = sole_wall(below), sole_wall(above)
    if first is None or last is None:
        return None
    ends = end_outline(first, 1), end_outline(last, -1)
    same = type(ends[0]) is type(ends[1]) and np.array_equal(ends[0].vector, ends[1].vector)
    return (first, last) if same else None


def _kept(walls: Walls) -> bool:
    """Whether one of two walls is ruled and the other one, too, has its outline wherever the break is."""
    ruled = [isinstance(wall, Ruled) for wall in walls]
    return any(ruled) and all(isinstance(wall, Ruled) or wall.still for wall in walls)


def _with_height(wall: Swept) -> Swept:
    return replace(wall, free=(*wall.free, "height"))


def _only_tapers(wall: Swept) -> bool:
    return not (wall.bows or wall.twist or np.any(wall.drift) or {"drift", "twist"} & {*wall.free})
