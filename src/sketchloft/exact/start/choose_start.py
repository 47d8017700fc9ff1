"""Choose start: directions that explain the points about as well are told apart by their first stacks."""

from __future__ import annotations

from itertools import chain

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.errors import StageError
from sketchloft.exact.fit.clear import CLEAR
from sketchloft.exact.start.direction import Candidate
from sketchloft.exact.start.segments import SegmentsParams
from sketchloft.exact.start.start import Start, start_along
from sketchloft.exact.start.through_sphere import through_sphere
from sketchloft.outline.circle import Circle
from sketchloft.wall.revolved import Revolved
from sketchloft.wall.swept import Swept
from sketchloft.workers import ALONE, Workers

__all__ = ["along", "apart", "other_starts"]

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
BEHIND = 40.0
"""Log likelihood by which a rough first stack may be behind the best one and yet be worth a search."""
TURNED = 0.04
"""Angle in radians by which the fit of a first stack has turned that is worth another."""

Candidates = tuple[Candidate, ...]


def other_starts(
    points: Floats,
    found: tuple[Start, ...],
    params: SegmentsParams,
    workers: Workers = ALONE,
    *,
    far: bool = False,
) -> tuple[Start, ...]:
    """Find the first stacks along other directions that explain the points about as well.

    Parameters
    ----------
    points : (n, 3) float array
        As for the first.
    found : tuple of Start
        Those along the best, as it is cut at first and, maybe, more finely.
    params : SegmentsParams
    workers : Workers, optional
    far : bool
        Whether an even cloud has so much against what was found that, where no direction is close behind,
        those far behind are looked at.

    Returns
    -------
    tuple of Start
    """
    if found[0].together > 1:
        starts = [*found, *_blurred_contenders(points, found, params, workers)]
    else:
        starts = [*found, *_contenders(points, found, params, workers, far=far)]
    best = max(starts, key=_value)
    ways = [False] if _turned(best) or (best.rough and not _round(best)) else []
    ways += [True] if _blurred(best) and not best.fine else []
    starts += _looks(points, best.direction, best, params, ways, workers=workers)
    best = max(starts, key=_value)
    balls = (through_sphere(start) for start in sorted(starts, key=_value, reverse=True) if best.candidates)
    through = next((direction for direction in balls if direction is not None), None)
    if through is not None and all(abs(float(through @ start.direction)) < BESIDE for start in starts):
        ways = [False, True] if _blurred(best) else [False]
        starts += _looks(points, through, best, params, ways, workers=workers)
    return tuple(starts[len(found) :])


def _turned(best: Start) -> bool:
    """Whether the fit has turned so far that other cuts may be the right ones."""
    return bool(best.settling[2, 2] < np.cos(TURNED)) and not best.plain


def _blurred(best: Start) -> bool:
    """Whether strokes leave the walls so blurred that breaks may be missing."""
    return best.together > 1 and not best.plain and best.merged.sigma >= CLEAR


def _looks(
    points: Floats,
    direction: Floats,
    best: Start,
    params: SegmentsParams,
    ways: list[bool],
    *,
    workers: Workers,
) -> list[Start]:
    """First stacks along a direction that is known better now, its heights cut as before or more finely."""
    parts = [(points, direction, best.candidates, params, fine) for fine in ways]
    return list(chain(*workers.beside(along, parts)))


def _contenders(
    points: Floats, found: tuple[Start, ...], params: SegmentsParams, workers: Workers, *, far: bool
) -> list[Start]:
    """First stacks along the directions next to the best, until one is plain; or along those far behind."""
    others: list[Start] = []
    candidates = found[0].candidates
    unlike = _unlike(candidates)[1:]
    close = [k for k in unlike if _close(candidates[k], candidates[0])]
    for k in (close or (unlike if far else []))[:CONTENDERS]:
        if close and max([*found, *others], key=_value).plain:
            break
        others += along(points, candidates[k].vector, _led_by(candidates, k), params, workers=workers)
    return others


def _close(candidate: Candidate, best: Candidate) -> bool:
    """Whether a direction is hardly behind the best, or only for want of symmetry."""
    return candidate.value > best.value - CLOSE or candidate.likelihood > best.likelihood


def _blurred_contenders(
    points: Floats, found: tuple[Start, ...], params: SegmentsParams, workers: Workers
) -> list[Start]:
    """Rough first stacks of a cloud of strokes along other directions than the best, unless that is clear.

    Notes
    -----
    An even cloud tells its direction by how sharp its sections are. Strokes that drift blur all of them, so
    that hardly a direction can be ruled out before its walls are fitted, however good the first may look.
    """
    if found[0].merged.sigma < CLEAR:
        return []
    candidates = found[0].candidates
    contenders = _unlike(candidates)[: BLURRED_CONTENDERS + 1][1:]
    ahead = [(points, candidates[k].vector, _led_by(candidates, k), params) for k in contenders]
    rough = list(chain(*workers.beside(along, ahead, rough=True)))
    least = max(start.value for start in (*found, *rough)) - BEHIND
    return apart([start for start in rough if start.value > least])


def along(
    points: Floats,
    vector: Floats,
    candidates: Candidates,
    params: SegmentsParams,
    fine: bool = False,
    *,
    rough: bool = False,
    workers: Workers = ALONE,
) -> list[Start]:
    """The first stack along a further direction (`start_along`); none where it has no section."""
    try:
        return [start_along(points, vector, candidates, params, fine=fine, rough=rough, workers=workers)]
    except StageError:
        return []


def _round(start: Start) -> bool:
    """Whether all sections are circles, so that strokes that are this blurred tell of no corners."""
    return all(
        isinstance(wall, Revolved) or (isinstance(wall, Swept) and isinstance(wall.outline, Circle))
        for wall in start.merged.stack.walls
    )


def _unlike(candidates: Candidates) -> list[int]:
    """Which candidates are no other's direction, about."""
    found: list[int] = []
    for k, candidate in enumerate(candidates):
        if all(abs(float(candidate.vector @ candidates[i].vector)) < SAME for i in found):
            found.append(k)
    return found


def _led_by(candidates: Candidates, k: int) -> Candidates:
    return (candidates[k], *candidates[:k], *candidates[k + 1 :])


def apart(starts: list[Start]) -> list[Start]:
    """Sort starts by what their stacks are worth; of those whose directions have become one keep the best."""
    found: list[Start] = []
    for start in sorted(starts, key=_value, reverse=True):
        if all(abs(float(start.direction @ other.direction)) < SAME for other in found):
            found.append(start)
    return found


def _value(start: Start) -> float:
    return start.value
