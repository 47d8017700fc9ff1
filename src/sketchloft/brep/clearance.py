"""Clearance: the walls of a run must not meet. Plain numpy."""

from __future__ import annotations

from itertools import combinations

import numpy as np

from sketchloft.brep.lofted_skin import lofted_skin
from sketchloft.brep.sections import check_sections
from sketchloft.errors import ModelError
from sketchloft.stack import Run, Stack
from sketchloft.wall.lofted import Lofted

__all__ = ["check_walls"]

AROUND = 384
"""Points on a wall that are looked at to tell whether it meets another one."""


def check_walls(stack: Stack) -> None:
    """Prove that no two walls of a run meet: outer ones lie apart, holes within one of them and apart.

    Raises
    ------
    ModelError
        If they do, or if a section of a lofted wall crosses itself; the message names the run's heights.

    Notes
    -----
    A swept wall crosses itself only if its outline does, which its first section then shows.
    """
    for run, low, high in stack.slabs():
        for wall in run.walls:
            if isinstance(wall, Lofted):
                check_sections(lofted_skin(wall, low, high))
        if len(run.walls) > 1 and not _apart(run, low, high):
            raise ModelError(
                f"walls meet between the heights {low:.4g} and {high:.4g}, so there is no clean section; "
                "put a break where they start to meet, or make the hole smaller"
            )


def _apart(run: Run, low: float, high: float) -> bool:
    rims = [wall.boundary(low, high, AROUND).points for wall in run.walls]
    outer = len(rims) - run.holes
    inside = np.zeros(len(rims))
    for i, j in combinations(range(len(rims)), 2):
        ahead = run.walls[i].foot(rims[j]).distance
        back = run.walls[j].foot(rims[i]).distance
        if ahead.min() > 0 and back.min() > 0:
            continue
        if not (i < outer <= j and ahead.max() < 0 and back.min() > 0):
            return False
        inside[j] += 1
    return bool((inside[outer:] == 1).all())
