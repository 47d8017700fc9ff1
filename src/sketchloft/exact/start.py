"""Start: the direction to slice along and the first stack along it, settled on the points.

Directions that explain the points about as well are told apart by their first stacks.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.direction import Axis
from sketchloft.dispersion import clump, dispersion
from sketchloft.errors import StageError
from sketchloft.exact.direction import Candidate, exact_direction
from sketchloft.exact.evidence import merged
from sketchloft.exact.first_stack import first_stack
from sketchloft.exact.fit import climb, fit_density
from sketchloft.exact.inside_density import inside_density
from sketchloft.exact.level_set import LevelSet, hollow_share, level_set, on_grid
from sketchloft.exact.likelihood import beside_walls
from sketchloft.exact.model import ExactModel
from sketchloft.exact.segments import SegmentsParams, segments
from sketchloft.exact.trial import MOST_NOISE, worth
from sketchloft.frame import Frame, frame_along, principal_frame
from sketchloft.wall.swept import Swept

__all__ = ["BESIDE", "ROOM", "SEARCH_POINTS", "Start", "started"]

START = 0.006
"""Noise that the search begins with, as a share of the size."""
ROOM = 1.25
"""Volume that strays are taken to come from, in that of the box around the points."""
SEARCH_POINTS = 12_000
"""The search looks at no more points; the fit looks at all."""
DIGITS = 6
"""Of coordinates: what a unit, an origin or a turn leaves in the last digits must not change the model."""
BESIDE = 8.0
"""Noise deviations beside the walls within which points are fitted."""
HOLLOW = 0.4
"""Share of a closed region that is empty inside from which on it is a skin."""
CLOSE = 0.03
"""Log likelihood per point by which a direction may be behind the best and yet have the better stack, where
no points go together."""
TURNED = 0.04
"""Angle in radians by which the fit of a first stack has turned that is worth another."""
CONTENDERS = 3


@dataclass(frozen=True)
class Start:
    """What the search starts from.

    Parameters
    ----------
    candidates : tuple of Candidate
        Directions that were compared, the chosen one first; none where it was given.
    frame : Frame
        Of the slicing direction.
    points, sample : (n, 3), (m, 3) float arrays
        All points in this frame, and those that the search looks at.
    cuts : (k + 1,) float array
        Where the moments of the points say that the sections change.
    together : float
        How many points go together.
    first, settled, merged : ExactModel
        Segment by segment, fitted, and with no more runs than it needs.
    settling : (3, 3) float array
        The rotation of the points that fitting made: it is in `sample`, not in `points`.
    """

    candidates: tuple[Candidate, ...]
    frame: Frame
    points: Floats
    sample: Floats
    cuts: Floats
    together: float
    first: ExactModel
    settled: ExactModel
    merged: ExactModel
    settling: Floats


def started(points: Floats, axis: Axis, params: SegmentsParams, progress: Callable[[str], None]) -> Start:
    """Find the direction and the first stack.

    Parameters
    ----------
    points : (n, 3) float array
        About 1 across, about their middle.
    axis : "auto" or (3,) tuple of float
    params : SegmentsParams
    progress : callable
        Called with "runs" when the direction is known, or a few are.

    Raises
    ------
    StageError
        If no section is found, or the points are on a skin.
    """
    candidates = _candidates(points, params) if axis == "auto" else ()
    progress("runs")
    vector = candidates[0].vector if candidates else np.asarray(axis, dtype=float)
    best = _start(points, vector, candidates, params, fine=False)
    close = CLOSE * float(np.sqrt(best.together))
    for k, other in enumerate(candidates[1:CONTENDERS], 1):
        if _plain(best.merged) or other.value < candidates[0].value - close:
            break
        order = (other, *candidates[:k], *candidates[k + 1 :])
        best = max(best, _start(points, other.vector, order, params, fine=False), key=_worth)
    if best.settling[2, 2] < np.cos(TURNED) and not _plain(best.merged):
        turned = best.settling.T @ best.frame.axes
        best = max(best, _start(points, turned[2], best.candidates, params, fine=False), key=_worth)
    if best.together > 1 and not _plain(best.merged):
        fine = _start(points, best.frame.axes[2], best.candidates, params, fine=True)
        best = max(best, fine, key=_worth)
    return best


def _plain(model: ExactModel) -> bool:
    """Whether there is one run, and all its sections are the same: nothing simpler can be found."""
    walls = [wall for run in model.stack.runs for wall in run.walls]
    return len(model.stack.runs) == 1 and not any(isinstance(wall, Swept) and wall.free for wall in walls)


def _worth(start: Start) -> float:
    return worth(start.sample, start.merged, start.together, len(start.sample))


def _start(
    points: Floats, vector: Floats, candidates: tuple[Candidate, ...], params: SegmentsParams, *, fine: bool
) -> Start:
    """First stack along a direction, with cuts as few as strokes call for, or finer ones."""
    frame = frame_along(vector, points)
    local = np.round(frame.to_local(points), DIGITS)
    sample = _sample(local)
    grid, together, kept = _seen(sample)
    if hollow_share(grid) > HOLLOW:
        raise StageError(
            "the points lie on the skin of the thing only, and this method needs points inside; "
            "draw the inside too, or use the paper's method",
            stage="runs",
        )
    density = inside_density(sample, grid, together)
    cuts = segments(kept, params, clump(together) if fine else together)
    space = ROOM * float(np.prod(np.ptp(sample, axis=0)))
    first = first_stack(kept, cuts, grid.blur, sigma=START, together=together, density=density, space=space)
    if first is None:
        raise StageError("found no section that the points fill; draw more of the inside", stage="runs")
    settled, sample, settling = _settled(sample, first, tilt=bool(candidates))
    lean = merged(sample, settled, together)
    return Start(candidates, frame, local, sample, cuts, together, first, settled, lean, settling)


def _candidates(points: Floats, params: SegmentsParams) -> tuple[Candidate, ...]:
    """Directions, found in the frame of the principal axes so that they turn with the cloud."""
    frame = principal_frame(points)
    grid, together, kept = _seen(_sample(np.round(frame.to_local(points), DIGITS)))
    mean = kept.mean(axis=0)
    grid = replace(grid, origin=grid.origin - mean)
    found = exact_direction(kept - mean, grid, params, clump(together))
    return tuple(replace(candidate, vector=frame.to_world(candidate.vector)) for candidate in found)


def _sample(points: Floats) -> Floats:
    """Every so many points, as many as the search looks at."""
    return points[:: len(points) // SEARCH_POINTS + 1]


def _seen(points: Floats) -> tuple[LevelSet, float, Floats]:
    """The level set of points, how many of them go together, and those that are no strays."""
    together = dispersion(points)
    grid = level_set(points, clump(together))
    return grid, together, points[on_grid(grid, points, 2 * grid.blur)]


def _settled(points: Floats, model: ExactModel, *, tilt: bool) -> tuple[ExactModel, Floats, Floats]:
    """The first stack fitted, the points turned with its direction, and the rotation."""
    turn = np.eye(3)
    for noise in (False, True):
        model = fit_density(points, model, 2)
        near = points[beside_walls(points, model, BESIDE * model.sigma)]
        model, _, rotation = climb(near, model, 8, tilt=tilt, noise=noise, most=MOST_NOISE)
        points, turn = points @ rotation, turn @ rotation
    return model, points, turn
