"""Exact: the method that models a body as runs of exact walls, fitted to all its points at once."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.direction import Axis
from sketchloft.errors import ModelError
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.exact.search.searches import searched
from sketchloft.exact.start.direction import Candidate
from sketchloft.exact.start.segments import SegmentsParams
from sketchloft.exact.start.start import directions
from sketchloft.frame import Frame
from sketchloft.robust_size import middle_and_size
from sketchloft.workers import ALONE, Workers

if TYPE_CHECKING:
    from sketchloft.brep.facts import SolidFacts
    from sketchloft.brep.solid import Solid

__all__ = ["EXACT_STAGES", "ExactBody", "ExactParams", "exact_body"]

EXACT_STAGES = ("input", "bodies", "direction", "runs", "evidence", "fit", "solid")


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


def exact_body(
    name: str,
    points: Floats,
    origin: Floats,
    *,
    axis: Axis,
    params: ExactParams,
    progress: Callable[[str], None],
    workers: Workers = ALONE,
) -> ExactBody:
    """Model a body.

    Parameters
    ----------
    name : str
    points : (n, 3) float array
        About `origin`.
    origin : (3,) float array
    axis : "auto" or (3,) tuple of float
        Slicing direction.
    params : ExactParams
    progress : callable
        Called with the name of each stage when it begins.
    workers : Workers, optional

    Raises
    ------
    StageError
        If no section is found.
    ModelError
        If the solid fails a check.
    """
    progress("direction")
    middle, scale = middle_and_size(points)
    unit = (points - middle) / scale
    compared = workers.begin(directions, unit, params.segments) if axis == "auto" else None
    # The kernel takes most of a second, in which a worker compares the directions.
    from sketchloft.brep.build_stack import built_stack  # noqa: PLC0415

    candidates = () if compared is None else compared.result()
    vector = candidates[0].vector if candidates else np.asarray(axis, dtype=float)
    refused: list[ModelError] = []
    for found in searched(unit, vector, candidates, params.segments, progress=progress, workers=workers):
        start, frame = found.start, found.frame
        progress("solid")
        try:
            solid, facts = built_stack(found.model.stack, origin + middle, frame.axes, scale)
            break
        except ModelError as error:
            refused.append(error)
    else:
        raise refused[-1]
    return ExactBody(
        name,
        found.points,
        frame.direction,
        start.candidates,
        frame,
        middle,
        scale,
        start.cuts,
        start.first,
        found.model,
        solid,
        facts,
    )
