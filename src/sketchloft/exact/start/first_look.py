"""First look: the bodies of a cloud, their directions, and what is seen along the likeliest of these."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from sketchloft.bodies import BodiesParams, separate_bodies
from sketchloft.cloud import MIN_POINTS, Floats, Ints
from sketchloft.dispersion import clump
from sketchloft.errors import StageError
from sketchloft.exact.start.direction import Candidate, exact_direction
from sketchloft.exact.start.seen import Seen, in_frame, sampled, seen_along, without_strays
from sketchloft.exact.start.segments import SegmentsParams
from sketchloft.frame import principal_frame
from sketchloft.robust_size import middle_and_size

__all__ = ["FirstLook", "first_look", "looked_over"]


@dataclass(frozen=True, eq=False)
class FirstLook:
    """Directions that a body may be sliced along.

    Parameters
    ----------
    middle, scale : (3,) float array, float
        Of the body, which was looked at about its middle and about 1 across.
    candidates : tuple of Candidate
        The likeliest first.
    seen : Seen
        Along the first.
    """

    middle: Floats
    scale: float
    candidates: tuple[Candidate, ...]
    seen: Seen


def looked_over(
    points: Floats, bodies: BodiesParams, segments: SegmentsParams
) -> list[tuple[Ints, FirstLook | None]]:
    """Separate a cloud into bodies and have a first look at each.

    Parameters
    ----------
    points : (n, 3) float array
        In canonical order.
    bodies : BodiesParams
    segments : SegmentsParams

    Returns
    -------
    list of tuple of (m,) int array and FirstLook
        Indices of a body's points, the largest body first. There is no look at one that has too few or such
        that nothing is to be seen: whoever models the body finds out why.

    Raises
    ------
    StageError
        As `separate_bodies`.
    """
    parts = separate_bodies(points, bodies)
    return [(part, _at_body(points[part], segments)) for part in parts]


def _at_body(points: Floats, segments: SegmentsParams) -> FirstLook | None:
    if len(points) < MIN_POINTS:
        return None
    try:
        return first_look(points, segments)
    except (StageError, np.linalg.LinAlgError):
        return None


def first_look(points: Floats, params: SegmentsParams) -> FirstLook:
    """Compare directions to slice along, and look along the likeliest.

    Parameters
    ----------
    points : (n, 3) float array
        Of a body.
    params : SegmentsParams

    Notes
    -----
    They are found in the frame of the principal axes, so that they turn with the cloud.
    """
    middle, scale = middle_and_size(points)
    points = (points - middle) / scale
    frame = principal_frame(points)
    grid, together, kept = without_strays(sampled(in_frame(points, frame)))
    mean = kept.mean(axis=0)
    grid = replace(grid, origin=grid.origin - mean)
    found = exact_direction(kept - mean, grid, params, clump(together))
    candidates = tuple(replace(one, vector=frame.to_world(one.vector)) for one in found)
    return FirstLook(middle, scale, candidates, seen_along(points, candidates[0].vector, params))
