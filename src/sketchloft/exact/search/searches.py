"""Searches: which first stacks are searched from, until the points have nothing against where one ends."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial

from sketchloft.cloud import Floats
from sketchloft.exact.fit.clear import CLEAR
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.exact.search.found import Found
from sketchloft.exact.search.search import search
from sketchloft.exact.start.choose_start import along, apart, other_starts
from sketchloft.exact.start.direction import Candidate
from sketchloft.exact.start.seen import Seen
from sketchloft.exact.start.segments import SegmentsParams
from sketchloft.exact.start.start import Start, plain, start_along
from sketchloft.outline.spline_loop import SplineLoop
from sketchloft.stack import Wall
from sketchloft.wall.lofted import Lofted
from sketchloft.wall.profile import SplineProfile
from sketchloft.wall.revolved import Revolved
from sketchloft.wall.swept import Swept
from sketchloft.workers import Workers

__all__ = ["searched"]

BLURRED = 0.006
"""Noise, as a share of the size, above which the walls of a cloud of strokes may be the wrong ones."""
ALONE_BLURRED = 0.005
"""The same of one run of stiff walls, which a thing that is seen from its side may be taken for."""
HOPELESS = 0.0095
"""That of a first stack, above which a search from it hardly ever ends well."""
WRONG = 15.0
"""Misfit above which those of an even cloud may be."""
LEDGE = 0.02
"""Share of a section that jumps at a step."""


def searched(
    points: Floats,
    vector: Floats,
    candidates: tuple[Candidate, ...],
    params: SegmentsParams,
    *,
    seen: Seen | None,
    progress: Callable[[str], None],
    workers: Workers,
) -> Iterator[Found]:
    """Yield where searches end, the best first; those after it are for a model that makes no solid.

    Parameters
    ----------
    points : (n, 3) float array
        About 1 across, about their middle.
    vector : (3,) float array
        The slicing direction, or the likeliest.
    candidates : tuple of Candidate
        Directions that were compared; where there are none, the direction is given and does not move.
    params : SegmentsParams
    seen : Seen or None
        Along the direction, where the points were looked at before.
    progress : callable
        Called with "runs", "evidence" and "fit" as they begin.
    workers : Workers

    Raises
    ------
    StageError
        If no section is found, or the points are on a skin.

    Notes
    -----
    The first search is from the likeliest direction, unless strokes leave the walls along it so blurred that
    it is hardly the right one. Only where its end leaves something to wish for, more is looked at, which
    takes longer: the same direction cut more finely, where strokes leave its walls a little blurred; and the
    first stacks along other directions. Then there is a search from the best of these, and others from the
    next one, where the points have something against its walls, or a free loft beside other runs hides what
    they have, or all runs have corners; and from the next and the sharpest, where strokes leave its walls
    blurred. Each end with a free loft is followed by one without.
    """
    look = partial(search, tilt=bool(candidates), progress=progress, workers=workers)
    progress("runs")
    first = start_along(points, vector, candidates, params, seen=seen, workers=workers)
    progress("evidence")
    found = [first]
    ends = [] if _hopeless(first) else [look(first)]
    if ends and first.together > 1 and ends[0].model.sigma < BLURRED and not _clear(ends[0]):
        progress("runs")
        found += along(points, ends[0].frame.direction, candidates, params, fine=True, workers=workers)
        progress("evidence")
        ends += map(look, found[1:])
    done = [end.start for end in ends]
    if any(map(_clear, ends)):
        for end in sorted(ends, key=_value, reverse=True):
            yield from _with_less(end, look)
        ends = []
    progress("runs")
    far = bool(ends) and first.together == 1 and _doubtful(ends[0])
    starts = apart([*found, *other_starts(points, tuple(found), params, workers, far=far)])
    progress("evidence")
    if starts[0] not in done:
        ends.append(look(starts[0]))
    left = [start for start in starts[1:] if start not in done]
    for start in _further(max(ends, key=_value), left) if ends else []:
        ends.append(look(start))
        left.remove(start)
    for end in sorted(ends, key=_value, reverse=True):
        yield from _with_less(end, look)
    for start in left:
        yield from _with_less(look(start), look)


def _with_less(end: Found, look: Callable[..., Found]) -> Iterator[Found]:
    """Yield an end, and after one with a free loft where the search ends without."""
    yield end
    if _has_loft(end.model):
        yield look(end.start, lofts=False)


def _hopeless(first: Start) -> bool:
    """Whether strokes leave the walls of a first stack so blurred that others come first."""
    return first.together > 1 and first.merged.sigma >= HOPELESS


def _clear(end: Found) -> bool:
    """Whether no other direction can be expected to explain more: nothing simpler, or no sharper walls."""
    if end.start.together == 1:
        return _simple(end.model) and end.misfit <= WRONG
    return end.model.sigma < (_blurred(end.model) if _stiff(end.model) else CLEAR)


def _blurred(model: ExactModel) -> float:
    """Noise above which the walls of a model may be the wrong ones."""
    return ALONE_BLURRED if len(model.stack.runs) == 1 and _stiff(model) else BLURRED


def _stiff(model: ExactModel) -> bool:
    """Whether no wall can bend to where strokes are: seen along a wrong direction it is far from them."""
    alone = len(model.stack.runs) == 1 and not _has_loft(model)
    return _simple(model) or (alone and not any(map(_bulges, model.stack.walls)))


def _bulges(wall: Wall) -> bool:
    """Whether a free outline bulges: such a wall is free along the axis and about it."""
    return isinstance(wall, Swept) and isinstance(wall.outline, SplineLoop) and "bow" in wall.free


def _simple(model: ExactModel) -> bool:
    """Whether all is one run of equal sections, or lines and arcs about one axis."""
    return plain(model) or all(
        isinstance(wall, Revolved) and not isinstance(wall.profile, SplineProfile)
        for wall in model.stack.walls
    )


def _further(end: Found, others: list[Start]) -> list[Start]:
    """Which other starts the best end so far leaves worth a search."""
    if not others:
        return []
    if end.start.together == 1:
        return others[:1] if _doubtful(end) else []
    if end.model.sigma < _blurred(end.model):
        return []
    sharpest = min(others, key=lambda start: start.merged.sigma)
    return [others[0]] if others[0] is sharpest else [others[0], sharpest]


def _doubtful(end: Found) -> bool:
    """Whether an even cloud may be explained better along a direction that is far behind."""
    return end.misfit > WRONG or _patched(end.model) or _terraced(end.model)


def _patched(model: ExactModel) -> bool:
    """Whether a free loft lies beside other runs, as it may where a simpler thing is seen from its side."""
    return len(model.stack.runs) > 1 and _has_loft(model)


def _terraced(model: ExactModel) -> bool:
    """Whether there are steps and no wall is round, as where slopes are seen from their side."""
    steps = any(_is_step(model, k) for k in range(1, len(model.stack.runs)))
    return steps and not any(isinstance(wall, Revolved) for wall in model.stack.walls)


def _is_step(model: ExactModel, k: int) -> bool:
    """Whether the section jumps at a break."""
    at = model.stack.breaks[k : k + 1]
    below, above = (float(run.area(at)[0]) for run in model.stack.runs[k - 1 : k + 1])
    return abs(above - below) > LEDGE * max(below, above)


def _has_loft(model: ExactModel) -> bool:
    return any(isinstance(wall, Lofted) for wall in model.stack.walls)


def _value(end: Found) -> float:
    return end.value
