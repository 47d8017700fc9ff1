"""Exact: what the method that models a body as runs of exact walls is asked, and what it finds."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from sketchloft.cloud import Floats
from sketchloft.exact.start.segments import SegmentsParams
from sketchloft.frame import Frame

if TYPE_CHECKING:  # which take their time to load
    from sketchloft.brep.facts import SolidFacts
    from sketchloft.brep.solid import Solid
    from sketchloft.exact.model.exact_model import ExactModel
    from sketchloft.exact.start.direction import Candidate

__all__ = ["EXACT_MODULES", "EXACT_STAGES", "ExactBody", "ExactParams"]

EXACT_STAGES = ("input", "bodies", "direction", "runs", "evidence", "fit", "solid")

EXACT_MODULES = (
    "sketchloft.exact.exact_body",
    "scipy.ndimage",
    "scipy.sparse.csgraph",
    "scipy.spatial",
    "scipy.special",
)
"""What the method needs and takes half a second to load."""


@dataclass(frozen=True)
class ExactParams:
    """How the exact method searches.

    Parameters
    ----------
    segments : SegmentsParams
    """

    segments: SegmentsParams = field(default_factory=SegmentsParams)


@dataclass(frozen=True)
class ExactBody:
    """One body of the cloud, with what the exact method found.

    Parameters
    ----------
    name : str
    points : (n, 3) float array
        In the frame of the slicing direction, about 1 across.
    vector : (3,) float array
        The slicing direction.
    candidates : tuple of Candidate
        Directions that were compared; none where it was given.
    frame : Frame
        From the axes of the cloud to those of the body.
    centre : (3,) float array
        Where the origin of that frame is, in the cloud's coordinates about its centre.
    scale : float
        Length of its unit.
    cuts : (k + 1,) float array
        Where the moments of the points say that the sections change.
    first, model : ExactModel
        Segment by segment, and in the end.
    solid : Solid
        Where the cloud is, in its unit.
    facts : SolidFacts
        What the checks of the solid found.
    """

    name: str
    points: Floats
    vector: Floats
    candidates: tuple[Candidate, ...]
    frame: Frame
    centre: Floats
    scale: float
    cuts: Floats
    first: ExactModel
    model: ExactModel
    solid: Solid
    facts: SolidFacts
