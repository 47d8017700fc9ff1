"""Exact: the method that models a body as runs of exact walls, fitted to all its points at once."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.direction import Axis
from sketchloft.errors import ModelError
from sketchloft.exact.coaxial import coaxial
from sketchloft.exact.direction import Candidate
from sketchloft.exact.evidence import improved, merged
from sketchloft.exact.fit import climb
from sketchloft.exact.flush import flush
from sketchloft.exact.inward_gap import without_gap
from sketchloft.exact.joins import natural_joins
from sketchloft.exact.likelihood import beside_walls
from sketchloft.exact.model import ExactModel, thicker
from sketchloft.exact.resection import resectioned
from sketchloft.exact.segments import SegmentsParams
from sketchloft.exact.sharpen import least_noise, sharpened
from sketchloft.exact.start import BESIDE, Start, started
from sketchloft.exact.upright import upright
from sketchloft.frame import Frame
from sketchloft.robust_size import middle_and_size
from sketchloft.wall.lofted import Lofted

if TYPE_CHECKING:
    from sketchloft.brep.facts import SolidFacts
    from sketchloft.brep.solid import Solid

__all__ = ["EXACT_STAGES", "ExactBody", "ExactParams", "exact_body"]

EXACT_STAGES = ("input", "bodies", "direction", "runs", "evidence", "fit", "solid")
AT_LEAST = 0.004
"""Noise that the evidence is judged with at least: sharper walls would trap the search."""


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

    Raises
    ------
    StageError
        If no section is found.
    ModelError
        If the solid fails a check.
    """
    from sketchloft.brep.build_stack import built_stack  # noqa: PLC0415  the kernel takes most of a second

    progress("direction")
    middle, scale = middle_and_size(points)
    start = started((points - middle) / scale, axis, params.segments, progress)
    progress("evidence")
    for lofts in (True, False):
        model, points, turn = _fitted(start, tilt=axis == "auto", lofts=lofts, progress=progress)
        found = Frame(turn.T @ start.frame.axes)
        progress("solid")
        try:
            solid, facts = built_stack(model.stack, origin + middle, found.axes, scale)
            break
        except ModelError:
            if not any(isinstance(wall, Lofted) for run in model.stack.runs for wall in run.walls):
                raise
    return ExactBody(
        name,
        points,
        found.direction,
        start.candidates,
        found,
        middle,
        scale,
        start.cuts,
        start.first,
        model,
        solid,
        facts,
    )


def _fitted(
    start: Start, *, tilt: bool, lofts: bool, progress: Callable[[str], None]
) -> tuple[ExactModel, Floats, Floats]:
    """Find the runs on a sample and fit them to all points; those turned with the direction; the rotation."""
    sample, together, model = start.sample, start.together, start.settled
    model = natural_joins(replace(natural_joins(model), sigma=max(model.sigma, AT_LEAST)))
    model, _, _ = climb(sample[beside_walls(sample, model, BESIDE * model.sigma)], model, 8)
    turn = np.eye(3)
    if tilt:
        model, turn = upright(sample, model, together)
    model = improved(sample @ turn, model, together, lofts=lofts)
    if tilt:
        model, rotation = upright(sample @ turn, model, together)
        turn = turn @ rotation
    again = resectioned(sample @ turn, model, together, start.cuts, (start.settling @ turn)[2, 2])
    if again is not model:
        model = improved(sample @ turn, again, together, lofts=lofts)
    model, _, rotation = coaxial(sample @ turn, model, together, tilt=tilt)
    turn = turn @ rotation
    progress("fit")
    every = len(start.points) / len(sample)
    model = thicker(model, every)
    model, points, rotation = sharpened(start.points @ start.settling @ turn, model, tilt=tilt)
    turn = turn @ rotation
    model = merged(sample @ turn, thicker(model, 1 / every), together)
    model = thicker(model, every)
    model = thicker(without_gap(model, least_noise(model, len(points))), 1 / every)
    model = flush(sample @ turn, model, together)
    return thicker(model, every), points, start.settling @ turn
