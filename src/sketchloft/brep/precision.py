"""How exactly the parts of a solid fit each other."""

from __future__ import annotations

from OCP.BRep import BRep_Tool

from sketchloft.brep.explore import edges_of, vertices_of
from sketchloft.brep.solid import Solid
from sketchloft.errors import ModelError

__all__ = ["check_precise"]

LARGEST = 3e-5
"""Largest gap between faces at an edge, in a solid about 1 across."""


def check_precise(solid: Solid) -> None:
    """Prove that faces meet at their edges without gaps that matter.

    Raises
    ------
    ModelError
        If the kernel allows itself more at an edge or a corner, as it may where surfaces nearly coincide.
    """
    at_edges = [BRep_Tool.Tolerance_s(edge) for edge in edges_of(solid.shape)]
    gap = max(at_edges + [BRep_Tool.Tolerance_s(corner) for corner in vertices_of(solid.shape)])
    if gap > LARGEST:
        raise ModelError(
            f"faces of the solid meet with gaps of up to {gap:.2g}, expected less than {LARGEST:g}; make the "
            "sections at the breaks equal or clearly different"
        )
