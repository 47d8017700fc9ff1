"""The faces of a run: each of its outer walls with the holes in it, and the sections at both ends."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from OCP.Geom import Geom_Plane
from OCP.gp import gp_Ax3, gp_Dir
from OCP.TopoDS import TopoDS, TopoDS_Edge, TopoDS_Face

from sketchloft.brep.block import Block
from sketchloft.brep.filleted_block import filleted_block, plain
from sketchloft.brep.kernel import point
from sketchloft.brep.lofted_tube import lofted_tube
from sketchloft.brep.revolved_tube import revolved_tube
from sketchloft.brep.ruled_tube import ruled_tube
from sketchloft.brep.shell_parts import planar_face, turned_around
from sketchloft.brep.swept_tube import swept_tube
from sketchloft.brep.tube import Tube
from sketchloft.errors import ModelError
from sketchloft.stack import Run, Wall
from sketchloft.wall.filleted import Filleted
from sketchloft.wall.lofted import Lofted
from sketchloft.wall.revolved import Revolved
from sketchloft.wall.ruled import Ruled
from sketchloft.wall.swept import Swept

__all__ = ["run_block"]


def run_block(run: Run, low: float, high: float, size: float) -> Block:
    """Make the faces of a run between two heights.

    Parameters
    ----------
    run : Run
    low, high : float
    size : float
        Of the whole stack.
    """
    first = run.walls[0]
    if isinstance(first, Filleted) and len(run.walls) == 1:
        here = first.between(low, high)
        return filleted_block(here, run_block(Run((plain(here),)), low, high, size))
    outer = len(run.walls) - run.holes
    holes: list[list[Wall]] = [[] for _ in range(outer)]
    for hole in run.walls[outer:]:
        holes[_owner(hole, run.walls[:outer], low, high)].append(hole)
    block = Block([], [], [])
    for wall, inner in zip(run.walls[:outer], holes, strict=True):
        _add(
            block, _tube(wall, low, high, size), [_tube(hole, low, high, size) for hole in inner], (low, high)
        )
    return block


def _owner(hole: Wall, outer: Sequence[Wall], low: float, high: float) -> int:
    """Index of the outer wall that a hole is deepest within."""
    rim = hole.boundary(low, high, 48).points
    return int(np.argmin([wall.foot(rim).distance.mean() for wall in outer]))


def _tube(wall: Wall, low: float, high: float, size: float) -> Tube:
    if isinstance(wall, Revolved):
        return revolved_tube(wall, low, high, size)
    if isinstance(wall, Swept):
        return swept_tube(wall, low, high)
    if isinstance(wall, Ruled):
        return ruled_tube(wall, low, high)
    if isinstance(wall, Lofted):
        return lofted_tube(wall, low, high)
    raise ModelError("found a filleted prism beside other walls in a run, expected it alone; use a prism")


def _add(block: Block, wall: Tube, holes: Sequence[Tube], heights: tuple[float, float]) -> None:
    """Add a wall and its holes to a block; they have no section where they come down to a point."""
    block.walls.extend(wall.faces)
    block.walls.extend(TopoDS.Face(face.Reversed()) for hole in holes for face in hole.faces)
    low, high = heights
    if wall.bottom:
        block.bottom.append(TopoDS.Face(_cap(low, wall.bottom, [hole.bottom for hole in holes]).Reversed()))
    if wall.top:
        block.top.append(_cap(high, wall.top, [hole.top for hole in holes]))


def _cap(height: float, outer: Sequence[TopoDS_Edge], holes: Sequence[Sequence[TopoDS_Edge]]) -> TopoDS_Face:
    """The face at a height, its normal upwards."""
    plane = Geom_Plane(gp_Ax3(point((0, 0, height)), gp_Dir(0, 0, 1)))
    return planar_face(plane, [outer, *(turned_around(hole) for hole in holes if hole)])
