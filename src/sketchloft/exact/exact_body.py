"""Exact body: runs of exact walls fitted to all points of a body at once, and their solid."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.direction import Axis
from sketchloft.errors import ModelError
from sketchloft.exact.body import ExactBody, ExactParams
from sketchloft.exact.search.searches import searched
from sketchloft.exact.start.first_look import FirstLook, first_look
from sketchloft.robust_size import middle_and_size
from sketchloft.workers import ALONE, Workers

__all__ = ["exact_body"]


def exact_body(
    name: str,
    points: Floats,
    origin: Floats,
    *,
    axis: Axis,
    look: FirstLook | None,
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
    look : FirstLook or None
        The first look at the body, where there has been one.
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
    if look is None:
        progress("direction")
    if axis == "auto":
        look = look or first_look(points, params.segments)
        middle, scale, candidates, seen = look.middle, look.scale, look.candidates, look.seen
        vector = candidates[0].vector
    else:
        middle, scale = middle_and_size(points)
        vector, candidates, seen = np.asarray(axis, dtype=float), (), None
    unit = (points - middle) / scale
    from sketchloft.brep.build_stack import built_stack  # noqa: PLC0415  the kernel takes most of a second

    refused: list[ModelError] = []
    for found in searched(
        unit, vector, candidates, params.segments, seen=seen, progress=progress, workers=workers
    ):
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
