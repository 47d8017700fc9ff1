"""Start: the first stack along a direction, settled on the points."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.dispersion import clump
from sketchloft.errors import StageError
from sketchloft.exact.changes.evidence import merged
from sketchloft.exact.changes.free_trial import MOST_NOISE
from sketchloft.exact.changes.worth import worth
from sketchloft.exact.fit.climb import climb
from sketchloft.exact.fit.fit_density import fit_density
from sketchloft.exact.fit.likelihood import beside_walls
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.exact.model.soundness import sound
from sketchloft.exact.start.direction import Candidate
from sketchloft.exact.start.first_stack import first_stack
from sketchloft.exact.start.seen import Seen, in_frame, sampled, seen_along
from sketchloft.exact.start.segments import SegmentsParams, segments
from sketchloft.frame import Frame, frame_along
from sketchloft.wall.revolved import Revolved
from sketchloft.wall.swept import Swept
from sketchloft.workers import ALONE, Workers

__all__ = ["BESIDE", "Start", "plain", "start_along"]

START = 0.006
"""Noise that the search begins with, as a share of the size."""
BESIDE = 8.0
"""Noise deviations beside the walls within which points are fitted."""
HOLLOW = 0.4
"""Share of a closed region that is empty inside from which on it is a skin."""


@dataclass(frozen=True, eq=False)
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
    fine : bool
        Whether heights are cut as finely as independent points would allow.
    rough : bool
        Whether it knows a few kinds of sections only.
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
    fine: bool = False
    rough: bool = False

    @property
    def direction(self) -> Floats:
        """The direction (3,) after settling, in the axes of all points."""
        axis: Floats = (self.settling.T @ self.frame.axes)[2]
        return axis

    @property
    def value(self) -> float:
        """What the merged stack is worth."""
        return worth(self.sample, self.merged, self.together, len(self.sample))

    @property
    def plain(self) -> bool:
        """Whether the merged stack is."""
        return plain(self.merged)


def start_along(
    points: Floats,
    vector: Floats,
    candidates: tuple[Candidate, ...],
    params: SegmentsParams,
    *,
    seen: Seen | None = None,
    fine: bool = False,
    rough: bool = False,
    workers: Workers = ALONE,
) -> Start:
    """First stack along a direction.

    Parameters
    ----------
    points : (n, 3) float array
        About 1 across, about their middle.
    vector : (3,) float array
    candidates : tuple of Candidate
        Directions that were compared; where there are none, the direction is given and does not move.
    params : SegmentsParams
    seen : Seen, optional
        Along this direction, where the points were looked at before.
    fine : bool
        Whether heights are cut as finely as independent points would allow.
    rough : bool
        Whether a few kinds of sections will do.
    workers : Workers, optional

    Raises
    ------
    StageError
        If no section is found, or the points are on a skin.

    Notes
    -----
    Sections found at the ends of a thing that leans may make no solid with the others, so that nothing can be
    fitted; those that are left when it is merged are fitted then.
    """
    frame = frame_along(vector, points)
    local = in_frame(points, frame)
    seen = seen or seen_along(points, vector, params)
    if seen.hollow > HOLLOW:
        raise StageError(
            "the points lie on the skin of the thing only, and this method needs points inside; "
            "draw the inside too, or use the paper's method",
            stage="runs",
        )
    together = seen.together
    cuts = segments(seen.kept, params, clump(together)) if fine else seen.cuts
    first = first_stack(
        seen.kept,
        cuts,
        seen.blur,
        sigma=START,
        together=together,
        density=seen.density,
        space=seen.space,
        rough=rough,
        workers=workers,
    )
    if first is None:
        raise StageError("found no section that the points fill; draw more of the inside", stage="runs")
    settled, sample, settling = _settled(sampled(local), first, tilt=bool(candidates))
    lean = merged(sample, settled, together, workers)
    if not sound(settled) and sound(lean):
        settled, sample, rotation = _settled(sample, lean, tilt=bool(candidates))
        lean, settling = merged(sample, settled, together, workers), settling @ rotation
    return Start(
        candidates, frame, local, sample, cuts, together, first, settled, lean, settling, fine, rough
    )


def plain(model: ExactModel) -> bool:
    """Whether there is one run, and all its sections are the same: nothing simpler can be found."""
    return len(model.stack.runs) == 1 and all(
        isinstance(wall, Revolved) or (isinstance(wall, Swept) and not wall.free)
        for wall in model.stack.walls
    )


def _settled(points: Floats, model: ExactModel, *, tilt: bool) -> tuple[ExactModel, Floats, Floats]:
    """The first stack fitted, the points turned with its direction, and the rotation."""
    turn = np.eye(3)
    for noise in (False, True):
        model = fit_density(points, model, 2)
        near = points[beside_walls(points, model, BESIDE * model.sigma)]
        model, _, rotation = climb(near, model, 8, tilt=tilt, noise=noise, most=MOST_NOISE)
        points, turn = points @ rotation, turn @ rotation
    return model, points, turn
