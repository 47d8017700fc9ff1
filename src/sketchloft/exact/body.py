"""Exact: the method that models a body as runs of exact walls, fitted to all its points at once."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.direction import Axis
from sketchloft.dispersion import clump, dispersion
from sketchloft.errors import ModelError, StageError
from sketchloft.exact.coaxial import coaxial
from sketchloft.exact.direction import Candidate, exact_direction
from sketchloft.exact.evidence import improved, without_slivers
from sketchloft.exact.first_stack import first_stack
from sketchloft.exact.fit import climb, fit_density
from sketchloft.exact.flush import flush
from sketchloft.exact.inside_density import inside_density
from sketchloft.exact.inward_gap import without_gap
from sketchloft.exact.joins import natural_joins
from sketchloft.exact.level_set import LevelSet, hollow_share, level_set, on_grid
from sketchloft.exact.likelihood import beside_walls
from sketchloft.exact.model import ExactModel, thicker
from sketchloft.exact.segments import SegmentsParams, segments
from sketchloft.exact.sharpen import least_noise, sharpened
from sketchloft.exact.trial import MOST_NOISE
from sketchloft.exact.upright import upright
from sketchloft.frame import Frame, frame_along, principal_frame
from sketchloft.robust_size import middle_and_size
from sketchloft.wall.lofted import Lofted

if TYPE_CHECKING:
    from sketchloft.brep.facts import SolidFacts
    from sketchloft.brep.solid import Solid

__all__ = ["EXACT_STAGES", "ExactBody", "ExactParams", "exact_body"]

EXACT_STAGES = ("input", "bodies", "direction", "runs", "evidence", "fit", "solid")
START = 0.006
"""Noise that the search begins with, as a share of the size."""
AT_LEAST = 0.004
"""Noise that the evidence is judged with at least: sharper walls would trap the search."""
ROOM = 1.25
SEARCH_POINTS = 12_000
"""The search looks at no more points; the fit looks at all."""
DIGITS = 6
"""Of coordinates: what a unit, an origin or a turn leaves in the last digits must not change the model."""
SLIVER = 0.01
"""Runs shorter than this are looked at again once the noise is known."""
BESIDE = 8.0
HOLLOW = 0.4
"""Share of a closed region that is empty inside from which on it is a skin."""


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
    unit = (points - middle) / scale
    if axis == "auto":
        candidates = _candidates(unit, params)
        vector = candidates[0].vector
    else:
        candidates, vector = (), np.asarray(axis, dtype=float)
    frame = frame_along(vector, unit)
    local = np.round(frame.to_local(unit), DIGITS)
    progress("runs")
    sample = _sample(local)
    cuts, first, together = _start(sample, params)
    progress("evidence")
    tilt = axis == "auto"
    settled, sample, settling = _settled(sample, first, tilt=tilt)
    local = local @ settling
    for lofts in (True, False):
        model, points, turn = _fitted(
            sample, local, settled, together, tilt=tilt, lofts=lofts, progress=progress
        )
        found = Frame((settling @ turn).T @ frame.axes)
        progress("solid")
        try:
            solid, facts = built_stack(model.stack, origin + middle, found.axes, scale)
            break
        except ModelError:
            if not any(isinstance(wall, Lofted) for run in model.stack.runs for wall in run.walls):
                raise
    return ExactBody(
        name, points, found.direction, candidates, found, middle, scale, cuts, first, model, solid, facts
    )


def _fitted(
    sample: Floats,
    points: Floats,
    model: ExactModel,
    together: float,
    *,
    tilt: bool,
    lofts: bool,
    progress: Callable[[str], None],
) -> tuple[ExactModel, Floats, Floats]:
    """Find the runs on a sample and fit them to all points; those turned with the direction; the rotation."""
    model = natural_joins(replace(natural_joins(model), sigma=max(model.sigma, AT_LEAST)))
    model, _, _ = climb(sample[beside_walls(sample, model, BESIDE * model.sigma)], model, 8)
    turn = np.eye(3)
    if tilt:
        model, turn = upright(sample, model, together)
    model = improved(sample @ turn, model, together, lofts=lofts)
    if tilt:
        model, rotation = upright(sample @ turn, model, together)
        turn = turn @ rotation
    model, _, rotation = coaxial(sample @ turn, model, together, tilt=tilt)
    turn = turn @ rotation
    progress("fit")
    every = len(points) / len(sample)
    model = thicker(model, every)
    model, points, rotation = sharpened(points @ turn, model, tilt=tilt)
    turn = turn @ rotation
    model = without_slivers(sample @ turn, thicker(model, 1 / every), together, SLIVER)
    model = thicker(model, every)
    model = thicker(without_gap(model, least_noise(model, len(points))), 1 / every)
    model = flush(sample @ turn, model, together)
    return thicker(model, every), points, turn


def _candidates(points: Floats, params: ExactParams) -> tuple[Candidate, ...]:
    """Directions, found in the frame of the principal axes so that they turn with the cloud."""
    frame = principal_frame(points)
    grid, together, kept = _seen(_sample(np.round(frame.to_local(points), DIGITS)))
    mean = kept.mean(axis=0)
    grid = replace(grid, origin=grid.origin - mean)
    found = exact_direction(kept - mean, grid, params.segments, clump(together))
    return tuple(replace(candidate, vector=frame.to_world(candidate.vector)) for candidate in found)


def _start(points: Floats, params: ExactParams) -> tuple[Floats, ExactModel, float]:
    """Cuts, the first stack, and how many points go together."""
    grid, together, kept = _seen(points)
    if hollow_share(grid) > HOLLOW:
        raise StageError(
            "the points lie on the skin of the thing only, and this method needs points inside; "
            "draw the inside too, or use the paper's method",
            stage="runs",
        )
    density = inside_density(points, grid, together)
    cuts = segments(kept, params.segments, clump(together))
    space = ROOM * float(np.prod(np.ptp(points, axis=0)))
    first = first_stack(kept, cuts, grid.blur, sigma=START, together=together, density=density, space=space)
    if first is None:
        raise StageError("found no section that the points fill; draw more of the inside", stage="runs")
    return cuts, first, together


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
