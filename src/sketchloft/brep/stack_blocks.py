"""Which runs of a stack are made as one block of faces, and the blocks themselves."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from sketchloft.brep.block import Block
from sketchloft.brep.meridian import Piece, Straight, meridian
from sketchloft.brep.revolved_block import revolved_block, torus_block
from sketchloft.brep.run_block import run_block
from sketchloft.cloud import Floats
from sketchloft.stack import Run, Stack
from sketchloft.wall.revolved import Revolved

__all__ = ["Group", "block_of", "groups_of"]

COAXIAL = 1e-9
"""Distance of axes, in a stack about 1 across, up to which they are one."""
Group = tuple[int, int]
"""First run of a block, and the first run of the next."""


def groups_of(runs: Sequence[Run]) -> list[Group]:
    """The runs that are one turned profile; all others are by themselves."""
    groups = [(0, 1)]
    for i, run in enumerate(runs[1:], start=1):
        here, before = _centre(run), _centre(runs[i - 1])
        if here is not None and before is not None and np.abs(here - before).max() <= COAXIAL:
            groups[-1] = (groups[-1][0], i + 1)
        else:
            groups.append((i, i + 1))
    return groups


def block_of(stack: Stack, group: Group, size: float) -> Block:
    """Make the faces of a group of runs.

    Parameters
    ----------
    stack : Stack
    group : (int, int)
    size : float
        Of the whole stack.
    """
    first, last = group
    breaks = stack.breaks[first : last + 1]
    if _centre(stack.runs[first]) is None:
        return run_block(stack.runs[first], float(breaks[0]), float(breaks[1]), size)
    return _turned(stack.runs[first:last], breaks, size)


def _centre(run: Run) -> Floats | None:
    """Common axis of a run's wall and its one hole, if it has any; None for other runs."""
    walls = run.walls
    if len(walls) - run.holes != 1 or run.holes > 1 or not all(isinstance(wall, Revolved) for wall in walls):
        return None
    centres = [wall.centre for wall in walls if isinstance(wall, Revolved)]
    return centres[0] if np.abs(centres[-1] - centres[0]).max() <= COAXIAL else None


def _turned(runs: Sequence[Run], breaks: Floats, size: float) -> Block:
    walls = [[wall for wall in run.walls if isinstance(wall, Revolved)] for run in runs]
    outer = meridian([pair[0].profile for pair in walls], breaks, size)
    if any(len(pair) > 1 for pair in walls):
        inner = meridian([pair[1].profile if len(pair) > 1 else Straight() for pair in walls], breaks, size)
    else:
        foot, head = (np.array([0.0, end[1]]) for end in (outer[0].start, outer[-1].end))
        inner = [Piece(Straight(), foot, head)]
    torus = runs[0].torus
    if torus is not None and len(outer) == 1 and _ends(outer) == _ends(inner):
        return torus_block(torus)
    return revolved_block(outer, inner, walls[0][0].centre)


def _ends(pieces: Sequence[Piece]) -> list[list[float]]:
    return [pieces[0].start.tolist(), pieces[-1].end.tolist()]
