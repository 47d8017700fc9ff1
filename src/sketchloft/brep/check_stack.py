"""The checks that the solid of a stack must pass before it is given out."""

from __future__ import annotations

import numpy as np
from OCP.BRep import BRep_Tool
from OCP.BRepTools import BRepTools
from OCP.gp import gp_Pnt2d
from OCP.IntTools import IntTools_FClass2d
from OCP.TopAbs import TopAbs_State
from OCP.TopoDS import TopoDS_Face

from sketchloft.brep.check import check_closed
from sketchloft.brep.clearance import check_walls
from sketchloft.brep.explore import faces_of
from sketchloft.brep.facts import SolidFacts, solid_facts
from sketchloft.brep.kernel import CONFUSION
from sketchloft.brep.precision import check_precise
from sketchloft.brep.solid import Solid
from sketchloft.cloud import Floats
from sketchloft.errors import ModelError
from sketchloft.stack import Stack
from sketchloft.stack_distance import distance_from_stack
from sketchloft.stack_volume import stack_volume

__all__ = ["check_stack"]

VOLUME_TOLERANCE = 1e-5
"""Largest difference between the volume of the solid and that of its sections, as a share."""
DISTANCE_TOLERANCE = 1e-5
"""Largest distance of the solid from its walls and breaks, as a share of its size."""
GRID = (np.arange(7) + 0.5) / 7


def check_stack(solid: Solid, stack: Stack) -> SolidFacts:
    """Prove that a solid is valid, and the one that a stack describes.

    Parameters
    ----------
    solid : Solid
        What `stack_solid` made, not moved since.
    stack : Stack
        What it was made of.

    Returns
    -------
    SolidFacts

    Raises
    ------
    ModelError
        If walls of a run meet (`check_walls`); if the solid is not one closed shell, the kernel finds it
        invalid, or its faces do not meet closely; if its volume, integrated over its faces, differs from
        that of the stack's sections; if one of its faces is neither on a wall nor at a break.

    Notes
    -----
    A closed surface that lies on the walls and breaks, and encloses as much as they do, is theirs.
    """
    check_walls(stack)
    check_closed(solid)
    check_precise(solid)
    facts = solid_facts(solid)
    expected = stack_volume(stack)
    if not abs(facts.volume - expected) <= VOLUME_TOLERANCE * expected:
        raise ModelError(
            f"the faces of the solid enclose a volume of {facts.volume:.7g}, its sections one of "
            f"{expected:.7g}; choose other breaks, or another kind of wall where sections change much"
        )
    size = float(np.linalg.norm(np.ptp(facts.bounds, axis=0)))
    points = np.concatenate([_points_on(face) for face in faces_of(solid.shape)])
    away = distance_from_stack(points, stack)
    worst = int(np.argmax(away))
    if away[worst] > DISTANCE_TOLERANCE * size:
        raise ModelError(
            f"the solid, {size:.3g} across, passes {away[worst]:.2g} beside its walls at a height of "
            f"{points[worst, 2]:.4g}; choose other breaks, or another kind of wall there"
        )
    return facts


def _points_on(face: TopoDS_Face) -> Floats:
    """Points (n, 3) within a face."""
    surface, within = BRep_Tool.Surface_s(face), IntTools_FClass2d(face, CONFUSION)
    u0, u1, v0, v1 = BRepTools.UVBounds_s(face)
    found = []
    for u in (u0 + (u1 - u0) * GRID).tolist():
        for v in (v0 + (v1 - v0) * GRID).tolist():
            if within.Perform(gp_Pnt2d(u, v)) == TopAbs_State.TopAbs_IN:
                at = surface.Value(u, v)
                found.append((at.X(), at.Y(), at.Z()))
    return np.array(found).reshape(-1, 3)
