"""The faces of a filleted prism: the kernel rounds the edges of the prism."""

from __future__ import annotations

import numpy as np
from OCP.BRep import BRep_Tool
from OCP.BRepFilletAPI import BRepFilletAPI_MakeFillet
from OCP.Geom import Geom_Plane
from OCP.TopAbs import TopAbs_Orientation
from OCP.TopoDS import TopoDS_Edge, TopoDS_Face

from sketchloft.brep.block import Block
from sketchloft.brep.bounds import bounds_of
from sketchloft.brep.explore import edges_of, faces_of, solids_of, vertices_of
from sketchloft.brep.shell_parts import solid_of
from sketchloft.errors import ModelError
from sketchloft.outline.placed_polygons import Rectangle, RoundedRectangle
from sketchloft.wall.filleted import Filleted
from sketchloft.wall.swept import Swept

__all__ = ["filleted_block", "plain"]

LEVEL = 1e-7
"""Heights that differ by less, in a solid about 1 across, are one."""


def filleted_block(wall: Filleted, prism: Block) -> Block:
    """Round the edges of a prism.

    Parameters
    ----------
    wall : Filleted
        At its heights.
    prism : Block
        The faces of `plain(wall)` between the same heights.

    Raises
    ------
    ModelError
        If the kernel cannot make the fillets.
    """
    solid = solid_of([*prism.walls, *prism.bottom, *prism.top])
    maker = BRepFilletAPI_MakeFillet(solid)
    for edge in edges_of(solid):  # each is met twice, once in either sense
        if edge.Orientation() == TopAbs_Orientation.TopAbs_FORWARD and _is_rounded(edge, wall):
            maker.Add(wall.radius, edge)
    maker.Build()
    if not maker.IsDone():
        raise ModelError(f"the CAD kernel cannot make fillets of radius {wall.radius:.4g}; make it smaller")
    (rounded,) = solids_of(maker.Shape())
    block = Block([], [], [])
    for face in faces_of(rounded):
        height = _level(face)
        if height is not None and abs(height - wall.low) < LEVEL:
            block.bottom.append(face)
        elif height is not None and abs(height - wall.high) < LEVEL:
            block.top.append(face)
        else:
            block.walls.append(face)
    return block


def plain(wall: Filleted) -> Swept:
    """The prism with sharp edges."""
    outline = wall.outline
    if isinstance(outline, RoundedRectangle):
        outline = Rectangle(outline.centre, outline.width, outline.height, outline.angle)
    return Swept(outline, wall.low, np.zeros(2), np.zeros(2))


def _is_rounded(edge: TopoDS_Edge, wall: Filleted) -> bool:
    heights = [BRep_Tool.Pnt_s(corner).Z() for corner in vertices_of(edge)]
    if max(heights) - min(heights) > LEVEL:
        return wall.fillet is None
    end = "bottom" if abs(heights[0] - wall.low) < LEVEL else "top"
    return wall.ends in (end, "both")


def _level(face: TopoDS_Face) -> float | None:
    """Height of a face that is level."""
    if not isinstance(BRep_Tool.Surface_s(face), Geom_Plane):
        return None
    low, high = bounds_of(face)[:, 2].tolist()
    return (low + high) / 2 if high - low < 10 * LEVEL else None
