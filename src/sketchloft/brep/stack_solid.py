"""The exact solid of a stack."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from sketchloft.brep.block import Block
from sketchloft.brep.check import check_closed
from sketchloft.brep.clearance import check_walls
from sketchloft.brep.joined import joined
from sketchloft.brep.meridian import Piece, Straight, meridian
from sketchloft.brep.pieces import check_pieces
from sketchloft.brep.revolved_block import revolved_block
from sketchloft.brep.run_block import run_block
from sketchloft.brep.solid import Solid
from sketchloft.cloud import Floats
from sketchloft.errors import ModelError
from sketchloft.stack import Run, Stack
from sketchloft.wall.revolved import Revolved

__all__ = ["stack_solid"]

FUZZY = (1e-6, 1e-5, 0.0)
"""Distances up to which edges are taken for one, tried in this order."""
COAXIAL = 1e-9
"""Distance of axes, as a share of the size, up to which they are one."""


def stack_solid(stack: Stack) -> Solid:
    """Make the exact solid of a stack.

    Parameters
    ----------
    stack : Stack
        About 1 across.

    Returns
    -------
    Solid
        One closed shell, normals outwards. Revolved walls make cylinders, cones, spheres, tori and surfaces
        of revolution, swept ones planes, cylinders, cones, extrusions and B-splines, lofted ones B-splines.

    Raises
    ------
    ModelError
        If the runs do not make one solid; the message names the break.

    Notes
    -----
    Neighbouring runs of coaxial revolved walls are one turned profile, whose pieces meet exactly. Other runs
    are made each on its own, of faces that share their edges, and united.
    """
    size = _size(stack)
    groups = _groups(stack.runs)
    for fuzzy in FUZZY:
        solid = Solid(joined([_block(stack, *group, size) for group in groups], fuzzy))
        if _is_valid(solid):
            return solid
    _explain(stack, groups, size)
    raise ModelError("the CAD kernel cannot join the runs; choose other breaks")


def _is_valid(solid: Solid) -> bool:
    try:
        check_closed(solid)
    except ModelError:
        return False
    return True


def _explain(stack: Stack, groups: list[tuple[int, int]], size: float) -> None:
    """Raise what is wrong with the first run or break that makes no valid solid by itself."""
    check_walls(stack)
    blocks = [_block(stack, *group, size) for group in groups]
    check_pieces(joined(blocks))
    for (first, last), block in zip(groups, blocks, strict=True):
        if not _is_valid(Solid(joined([block]))):
            low, high = stack.breaks[[first, last]]
            raise ModelError(
                f"the walls between the heights {low:.4g} and {high:.4g} make no valid solid: a section "
                "there crosses itself or another one; choose another kind of wall"
            )
    for i, (first, _) in enumerate(groups[1:], start=1):
        if not _is_valid(Solid(joined([_block(stack, *group, size) for group in groups[i - 1 : i + 1]]))):
            raise ModelError(
                f"the runs do not join at the break at height {stack.breaks[first]:.4g}: their sections "
                "touch in a point or a line, or nearly coincide; make them equal there, or clearly different"
            )


def _block(stack: Stack, first: int, last: int, size: float) -> Block:
    breaks = stack.breaks[first : last + 1]
    if _centre(stack.runs[first]) is None:
        return run_block(stack.runs[first], float(breaks[0]), float(breaks[1]), size)
    return _turned(stack.runs[first:last], breaks, size)


def _size(stack: Stack) -> float:
    """Diagonal of the box around the walls."""
    ends = zip(stack.runs, stack.breaks[:-1].tolist(), stack.breaks[1:].tolist(), strict=True)
    points = [wall.boundary(low, high, 64).points for run, low, high in ends for wall in run.walls]
    return float(np.linalg.norm(np.ptp(np.concatenate(points), axis=0)))


def _centre(run: Run) -> Floats | None:
    """Common axis of a run's wall and its one hole, if it has any; None for other runs."""
    walls = run.walls
    if len(walls) - run.holes != 1 or run.holes > 1 or not all(isinstance(wall, Revolved) for wall in walls):
        return None
    centres = [wall.centre for wall in walls if isinstance(wall, Revolved)]
    return centres[0] if np.abs(centres[-1] - centres[0]).max() <= COAXIAL else None


def _groups(runs: Sequence[Run]) -> list[tuple[int, int]]:
    """First and last-but-one index of the runs that are one turned profile; others are by themselves."""
    groups = [(0, 1)]
    for i, run in enumerate(runs[1:], start=1):
        here, before = _centre(run), _centre(runs[i - 1])
        if here is not None and before is not None and np.abs(here - before).max() <= COAXIAL:
            groups[-1] = (groups[-1][0], i + 1)
        else:
            groups.append((i, i + 1))
    return groups


def _turned(runs: Sequence[Run], breaks: Floats, size: float) -> Block:
    walls = [[wall for wall in run.walls if isinstance(wall, Revolved)] for run in runs]
    outer = meridian([pair[0].profile for pair in walls], breaks, size)
    inner_profiles = [pair[1].profile if len(pair) > 1 else Straight() for pair in walls]
    if any(len(pair) > 1 for pair in walls):
        inner = meridian(inner_profiles, breaks, size)
    else:
        foot, head = (np.array([0.0, piece[1]]) for piece in (outer[0].start, outer[-1].end))
        inner = [Piece(Straight(), foot, head)]
    return revolved_block(outer, inner, walls[0][0].centre)
