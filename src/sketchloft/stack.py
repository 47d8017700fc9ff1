"""Stack: a solid as runs of walls along the slicing direction, each between two breaks."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.wall.filleted import Filleted
from sketchloft.wall.foot import WallBoundary
from sketchloft.wall.lofted import Lofted
from sketchloft.wall.revolved import Revolved
from sketchloft.wall.ruled import Ruled
from sketchloft.wall.swept import Swept
from sketchloft.wall.torus import Torus, torus_of

__all__ = ["THIN", "Run", "Stack", "Wall", "section_boundary", "spanned"]

Wall = Revolved | Swept | Ruled | Filleted | Lofted
SPANNING = (Ruled, Filleted, Lofted)
"""Walls that begin and end at the breaks of their run."""
THIN = 1e-6
"""Half the thickness of what stands for a section."""


@dataclass(frozen=True)
class Run:
    """What lies between two breaks: a section of one or several pieces, some with holes.

    Parameters
    ----------
    walls : tuple of Wall
        Outer walls, apart from each other, then the walls of holes.
    holes : int
        How many of the walls, at the end, bound holes.
    """

    walls: tuple[Wall, ...]
    holes: int = 0

    @property
    def kinds(self) -> list[str]:
        """Of its walls."""
        return [wall.kind for wall in self.walls]

    def sign(self, index: int) -> int:
        """1 for an outer wall, -1 for the wall of a hole."""
        return -1 if index >= len(self.walls) - self.holes else 1

    def area(self, heights: Floats) -> Floats:
        """Area of the sections at heights (m,), without the holes."""
        return np.asarray(sum(self.sign(i) * wall.area(heights) for i, wall in enumerate(self.walls)))

    @property
    def torus(self) -> Torus | None:
        """The torus that an outer wall and its hole are the halves of; None for other runs."""
        return torus_of(*self.walls) if len(self.walls) == 2 and self.holes else None


@dataclass(frozen=True)
class Stack:
    """Runs one upon another in the frame of the slicing direction.

    Parameters
    ----------
    breaks : (k + 1,) float array
        Rising heights; run i lies between breaks i and i + 1. Where two walls meet in a kink the break is
        where they cross; where they do not meet there is a step, a planar ledge.
    runs : tuple of k Run
    """

    breaks: Floats
    runs: tuple[Run, ...]

    def slabs(self) -> Iterator[tuple[Run, float, float]]:
        """Each run with the heights of the breaks below and above it."""
        for run, (low, high) in zip(self.runs, pairwise(self.breaks.tolist()), strict=True):
            yield run, low, high

    @property
    def walls(self) -> tuple[Wall, ...]:
        """Those of all runs, from the first to the last."""
        return tuple(wall for run in self.runs for wall in run.walls)

    def with_walls(self, change: Callable[[Wall], Wall]) -> Stack:
        """Return the stack with each wall changed."""
        runs = tuple(replace(run, walls=tuple(change(wall) for wall in run.walls)) for run in self.runs)
        return replace(self, runs=runs)


def section_boundary(wall: Wall, height: float, count: int) -> WallBoundary:
    """About `count` points around a wall's section."""
    return wall.boundary(height - THIN, height + THIN, count)


def spanned(stack: Stack) -> Stack:
    """Let those walls that do begin and end at the breaks of their runs."""
    if not any(isinstance(wall, SPANNING) for wall in stack.walls):
        return stack
    runs = tuple(
        replace(run, walls=tuple(w.between(low, high) if isinstance(w, SPANNING) else w for w in run.walls))
        for run, low, high in stack.slabs()
    )
    return replace(stack, runs=runs)
