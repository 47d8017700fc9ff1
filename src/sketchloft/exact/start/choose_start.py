"""Choose start: directions that explain the points about as well are told apart by their first stacks."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.direction import Axis
from sketchloft.exact.start.direction import Candidate
from sketchloft.exact.start.segments import SegmentsParams
from sketchloft.exact.start.start import Start, directions, start_along
from sketchloft.exact.start.through_sphere import through_sphere

__all__ = ["started"]

CLOSE = 0.03
"""Log likelihood per point by which a direction may be behind the best and yet have the better stack, where
no points go together; one that is behind for want of symmetry only is looked at whatever its distance."""
SAME = 0.9994
"""Cosine of the angle within which the fit of a first stack finds the same direction."""
BESIDE = 0.996
"""The same for the direction from a ball to what is beside it, which is known to a few degrees."""
CONTENDERS = 2
"""Directions beside the best whose first stacks are looked at."""
BLURRED_CONTENDERS = 4
"""The same for a cloud of strokes, by rough first stacks."""
FULL = 2
"""How many of these are looked at again in full."""
BEHIND = 40.0
"""Log likelihood by which a rough first stack may be behind the best one and yet be worth a full one."""
CLEAR = 0.004
"""Noise, as a share of the size, that a cloud of strokes has at least where its walls are wrong."""
TURNED = 0.04
"""Angle in radians by which the fit of a first stack has turned that is worth another."""

Candidates = tuple[Candidate, ...]


def started(
    points: Floats, axis: Axis, params: SegmentsParams, progress: Callable[[str], None]
) -> tuple[Start, ...]:
    """Find the direction and the first stack; those along other directions that were looked at, too.

    Parameters
    ----------
    points : (n, 3) float array
        About 1 across, about their middle.
    axis : "auto" or (3,) tuple of float
    params : SegmentsParams
    progress : callable
        Called with "runs" when the direction is known, or a few are.

    Returns
    -------
    tuple of Start
        The best first, by what its first stack is worth.

    Raises
    ------
    StageError
        If no section is found, or the points are on a skin.
    """
    candidates = directions(points, params) if axis == "auto" else ()
    progress("runs")
    vector = candidates[0].vector if candidates else np.asarray(axis, dtype=float)
    first = start_along(points, vector, candidates, params)
    blurred = first.together > 1
    others = _blurred_contenders if blurred else _contenders
    starts = [first, *others(points, first, candidates, params)]
    best = max(starts, key=_value)
    if best.settling[2, 2] < np.cos(TURNED) and not best.plain:
        starts.append(start_along(points, best.direction, best.candidates, params))
        best = max(starts, key=_value)
    balls = (through_sphere(start) for start in sorted(starts, key=_value, reverse=True) if candidates)
    through = next((direction for direction in balls if direction is not None), None)
    if through is not None and all(abs(float(through @ start.direction)) < BESIDE for start in starts):
        starts.append(start_along(points, through, best.candidates, params))
        best = max(starts, key=_value)
    if blurred and not best.plain:
        starts.append(start_along(points, best.frame.axes[2], best.candidates, params, fine=True))
    return _apart(sorted(starts, key=_value, reverse=True))


def _contenders(points: Floats, first: Start, candidates: Candidates, params: SegmentsParams) -> list[Start]:
    """First stacks along the directions next to the best, until one is plain."""
    found: list[Start] = []
    close = [k for k in _unlike(candidates)[1:] if _close(candidates[k], candidates[0])]
    for k in close[:CONTENDERS]:
        if max([first, *found], key=_value).plain:
            break
        found.append(start_along(points, candidates[k].vector, _led_by(candidates, k), params))
    return found


def _close(candidate: Candidate, best: Candidate) -> bool:
    """Whether a direction is hardly behind the best, or only for want of symmetry."""
    return candidate.value > best.value - CLOSE or candidate.likelihood > best.likelihood


def _blurred_contenders(
    points: Floats, first: Start, candidates: Candidates, params: SegmentsParams
) -> list[Start]:
    """First stacks of a cloud of strokes along other directions than the best, unless that is clear.

    Notes
    -----
    An even cloud tells its direction by how sharp its sections are. Strokes that drift blur all of them, so
    that hardly a direction can be ruled out before its walls are fitted, however good the first may look.
    """
    if first.merged.sigma < CLEAR:
        return []
    rough = [
        start_along(points, candidates[k].vector, _led_by(candidates, k), params, rough=True)
        for k in _unlike(candidates)[: BLURRED_CONTENDERS + 1][1:]
    ]
    least = max(start.value for start in (first, *rough)) - BEHIND
    likely = _apart(sorted((start for start in rough if start.value > least), key=_value, reverse=True))
    again = [start.candidates for start in likely[:FULL]]
    return [start_along(points, order[0].vector, order, params) for order in again]


def _unlike(candidates: Candidates) -> list[int]:
    """Which candidates are no other's direction, about."""
    found: list[int] = []
    for k, candidate in enumerate(candidates):
        if all(abs(float(candidate.vector @ candidates[i].vector)) < SAME for i in found):
            found.append(k)
    return found


def _led_by(candidates: Candidates, k: int) -> Candidates:
    return (candidates[k], *candidates[:k], *candidates[k + 1 :])


def _apart(starts: list[Start]) -> tuple[Start, ...]:
    """The first of the starts whose directions have become one."""
    found: list[Start] = []
    for start in starts:
        if all(abs(float(start.direction @ other.direction)) < SAME for other in found):
            found.append(start)
    return tuple(found)


def _value(start: Start) -> float:
    return start.value
