"""The checks that a solid must pass before it is given out."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from OCP.BRep import BRep_Tool
from OCP.BRepCheck import BRepCheck_Analyzer
from OCP.Geom import Geom_BSplineSurface

from sketchloft.brep.explore import faces_of, shells_of
from sketchloft.brep.facts import SolidFacts, edge_uses, solid_facts
from sketchloft.brep.kernel import skin_of
from sketchloft.brep.sections import check_sections, section_volume
from sketchloft.brep.solid import Solid
from sketchloft.cloud import Floats
from sketchloft.errors import ModelError
from sketchloft.surface import SkinSurface, distinct_knots, evaluate

__all__ = ["check_closed", "check_solid"]

VOLUME_TOLERANCE = 1e-6
"""Largest difference between the volume of the solid and that of its sections, as a share."""
DISTANCE_TOLERANCE = 1e-7
"""Largest distance of the solid from the curves of its sections, as a share of its size."""


def check_solid(solid: Solid, surface: SkinSurface) -> SolidFacts:
    """Prove that a loft is a valid solid, and the one that its skin describes.

    Parameters
    ----------
    solid : Solid
        What `loft_solid` made, not moved since.
    surface : SkinSurface
        The skin it was made of.

    Returns
    -------
    SolidFacts

    Raises
    ------
    ModelError
        If the skin cuts itself (`check_sections`); if the solid is not one closed
        shell or the kernel finds it invalid; if it is inside out, or its volume, integrated over its faces,
        differs from that of its sections; if it does not pass through its sections.
    """
    check_sections(surface)
    check_closed(solid)
    facts = solid_facts(solid)
    expected = section_volume(surface)
    if abs(facts.volume - expected) > VOLUME_TOLERANCE * expected:
        raise ModelError(
            f"the faces of the solid enclose a volume of {facts.volume:.7g}, its sections one of "
            f"{expected:.7g}; loft straight instead of smooth, or choose other slices"
        )
    size = float(np.linalg.norm(np.ptp(facts.bounds, axis=0)))
    away = _distance_from_sections(solid, surface)
    if away > DISTANCE_TOLERANCE * size:
        raise ModelError(
            f"the solid, {size:.3g} across, passes {away:.2g} beside its sections; loft the sections again"
        )
    return facts


def check_closed(solid: Solid) -> None:
    """Prove that a solid is one closed shell that the kernel accepts.

    Raises
    ------
    ModelError
        If it is not.
    """
    shells = shells_of(solid.shape)
    if len(shells) != 1:
        raise ModelError(f"the solid has {len(shells)} shells, expected one; model its bodies one by one")
    free = sum(uses != (1, 1) for uses in edge_uses(solid.shape))
    if free or not BRep_Tool.IsClosed_s(shells[0]):
        raise ModelError(
            f"the solid is open: {free} of its edges do not join two faces back to back; "
            "close both ends of the loft"
        )
    if not BRepCheck_Analyzer(solid.shape).IsValid():
        raise ModelError(
            "the CAD kernel finds the solid invalid; choose other slices, or fewer control points per contour"
        )


def _distance_from_sections(solid: Solid, surface: SkinSurface) -> float:
    """Largest distance between the curves of the sections and the same curves on the solid's faces.

    The faces keep the parameters of the skin but for a whole turn, and may run around the other way.
    """
    ends = distinct_knots(surface.u_knots)
    u = (ends[:-1, None] + np.diff(ends)[:, None] * np.array([0.0, 0.3, 0.7])).ravel()
    v = distinct_knots(surface.v_knots)
    wanted = evaluate(surface, u, v)
    surfaces = [BRep_Tool.Surface_s(face) for face in faces_of(solid.shape)]
    skins = [skin_of(found) for found in surfaces if isinstance(found, Geom_BSplineSurface)]
    period = ends[-1] - ends[0]
    return min(_distance(wanted, skins, at, v, period) for at in (u, ends[0] + ends[-1] - u))


def _distance(wanted: Floats, skins: list[SkinSurface], u: Floats, v: Floats, period: float) -> float:
    """`wanted` (len(v), len(u), 3) against the skins; infinite where none of them covers a parameter."""
    away = np.full(wanted.shape[:2], np.inf)
    for skin in skins:
        rows = np.flatnonzero(_within(v, skin.v_knots))
        for turned in (u, u + period):
            columns = np.flatnonzero(_within(turned, skin.u_knots))
            if len(rows) and len(columns):
                cells = np.ix_(rows, columns)
                gaps = np.linalg.norm(evaluate(skin, turned[columns], v[rows]) - wanted[cells], axis=2)
                away[cells] = np.minimum(away[cells], gaps)
    return float(away.max())


def _within(parameters: Floats, knots: Floats) -> NDArray[np.bool_]:
    slack = 1e-9 * (knots[-1] - knots[0])
    return (parameters >= knots[0] - slack) & (parameters <= knots[-1] + slack)
