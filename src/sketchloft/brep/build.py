"""Build: a skin made a solid, proved and placed where the cloud is."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from sketchloft.brep.bounds import bounds_of
from sketchloft.brep.check import check_solid
from sketchloft.brep.facts import SolidFacts
from sketchloft.brep.place import placed
from sketchloft.brep.solid import Solid, loft_solid
from sketchloft.cloud import Floats
from sketchloft.errors import ModelError
from sketchloft.surface import SkinSurface

__all__ = ["built"]


def built(surface: SkinSurface, origin: Floats, axes: Floats) -> tuple[Solid, SolidFacts]:
    """Make a solid of a skin and place it.

    Parameters
    ----------
    surface : SkinSurface
        In its own frame, of any size.
    origin : (3,) float array
        Where the origin of that frame is.
    axes : (3, 3) float array
        Its axes, in rows.

    Returns
    -------
    Solid
        Placed.
    SolidFacts
        Of the placed solid.

    Raises
    ------
    ModelError
        If the solid fails a check.

    Notes
    -----
    The tolerances of the kernel are absolute, so the solid is built and checked at a size of 1.
    """
    corners = surface.poles.reshape(-1, 3)
    middle = (corners.min(axis=0) + corners.max(axis=0)) / 2
    size = float(np.ptp(corners, axis=0).max())
    unit = replace(surface, poles=(surface.poles - middle) / size)
    try:
        solid = loft_solid(unit)
        facts = check_solid(solid, unit)
    except ModelError as error:
        raise ModelError(f"solid: {error}") from None
    there = placed(solid, size, origin + middle @ axes, axes)
    facts = replace(
        facts, volume=facts.volume * size**3, area=facts.area * size**2, bounds=bounds_of(there.shape)
    )
    return there, facts
