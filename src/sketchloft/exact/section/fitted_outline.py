"""Fitted outline: one outline for a loop of a section, fitted to the points beside it, and its evidence."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.dispersion import thinned
from sketchloft.exact.fit.climb import climb, climbed
from sketchloft.exact.fit.fit_density import fit_density
from sketchloft.exact.fit.likelihood import Evaluation, evaluate
from sketchloft.exact.fit.schwarz import evidence
from sketchloft.exact.model.density import Density
from sketchloft.exact.model.exact_model import ExactModel, model_of
from sketchloft.exact.section.rarity import rarity
from sketchloft.outline.outline import Outline
from sketchloft.ring import ring_length
from sketchloft.shapes.spline import resampled
from sketchloft.stack import Run, Stack
from sketchloft.wall.swept import Swept

__all__ = ["FittedOutline", "Loop", "fitted_outline", "loop_beside", "section_model"]

MOST_POINTS = 3000
BESIDE = 4.0
"""Blurs beside a contour within which points tell where the outline is."""
CROWDED = 1.5
"""An outline that leaves the points so many times denser than its contour did has lost them."""
LOST = 0.01
"""Share of the places whose points are not looked at that an outline may leave on the wrong side."""
ENOUGH = 0.05
"""Evidence that a step gains for there to be another."""
LATTICE = 40


@dataclass(frozen=True)
class Loop:
    """What is beside a loop of a section.

    Parameters
    ----------
    near : (n, 2) float array
        Points that tell where it is.
    core : (m, 4) float array
        Places inside whose points are not looked at, and the areas that they stand for, as in `ExactModel`;
        for a hole, those in and around it, with areas that are taken away.
    beyond : (k, 2) float array
        Places of the section whose points are not looked at.
    area : float
        Inside, where the points are looked at.
    blur : float
        Standard deviation of the blur that it was found with.
    together : float
        How many of the points go together.
    hole : bool
        Whether it bounds a hole.
    """

    near: Floats
    core: Floats
    beyond: Floats
    area: float
    blur: float
    together: float
    hole: bool


@dataclass(frozen=True)
class FittedOutline:
    """An outline, and the evidence for it.

    Parameters
    ----------
    outline : Outline
    settled : float
        At the noise that all begin with.
    value : float
        At its own; minus infinity for one that has lost its points.
    """

    outline: Outline
    settled: float
    value: float


def loop_beside(points: Floats, ring: Floats, blur: float, together: float, *, hole: bool) -> Loop:
    """Look at what is beside a loop.

    Parameters
    ----------
    points : (n, 2) float array
        Of the section.
    ring : (m, 2) float array
        The loop, roughly.
    blur : float
        Standard deviation of the blur that it was found with.
    together : float
        How many of the points go together.
    hole : bool
        Whether it bounds a hole.
    """
    from scipy.spatial import cKDTree  # noqa: PLC0415
    from shapely import Polygon as Region  # noqa: PLC0415
    from shapely import contains_xy  # noqa: PLC0415

    width = BESIDE * blur
    dense = resampled(ring, int(np.ceil(4 * ring_length(ring) / width)))
    away, _ = cKDTree(dense).query(points, distance_upper_bound=width)
    near = points[np.isfinite(away)]
    region = Region(dense)
    sign = -1 if hole else 1
    rest = region.buffer(sign * -width)
    low, high = dense.min(axis=0) - width, dense.max(axis=0) + width
    cells = np.stack(np.meshgrid(*[np.linspace(a, b, LATTICE) for a, b in zip(low, high, strict=True)]), -1)
    cells = cells.reshape(-1, 2)
    among = contains_xy(rest, cells)
    places, beyond = cells[among], cells[among != hole]
    share = np.full(len(places), sign * float(rest.area) / max(len(places), 1))
    core = np.column_stack([places, np.zeros(len(places)), share])
    every = len(near) // MOST_POINTS + 1
    area = sign * float(region.area - rest.area)
    return Loop(near[::every], core, beyond, area, blur, thinned(together, every), hole)


def fitted_outline(loop: Loop, outline: Outline, least: float) -> FittedOutline:
    """Fit an outline.

    Parameters
    ----------
    loop : Loop
    outline : Outline
        Near the loop.
    least : float
        Evidence at the noise that all begin with below which the noise is not fitted.
    """
    points = np.column_stack([loop.near, np.zeros(len(loop.near))])
    start = section_model(loop, outline)
    now = _settled(points, start, loop.together)
    value = settled = evidence(now, loop.together)
    if settled > least:
        now, value = _sharpened(now, start, loop.together)
        value -= rarity(outline)
    wall = now.model.stack.runs[0].walls[0]
    if isinstance(wall, Swept):
        outline = wall.outline
    return FittedOutline(outline, settled, value if _holds(loop, outline) else -np.inf)


def _holds(loop: Loop, outline: Outline) -> bool:
    """Whether an outline leaves the places whose points are not looked at on their side."""
    depth = outline.foot(loop.beyond).distance * (1 if loop.hole else -1)
    return bool((depth < 0).sum() <= LOST * len(loop.core))


def section_model(loop: Loop, outline: Outline) -> ExactModel:
    """Model of a section with one outline, and the points and the noise of its loop."""
    wall = Swept(outline, 0.0, np.zeros(2), np.zeros(2))
    stack = Stack(np.array([-0.5, 0.5]), (Run((wall,), int(loop.hole)),))
    density = Density(np.array([np.log(len(loop.near) / loop.area), 0.0, 0.0, 0.0]))
    space = float(np.prod(np.ptp(loop.near, axis=0)))
    return replace(model_of(stack, 0.5 * loop.blur, density, 1.0 / space, space), core=loop.core)


def _settled(points: Floats, model: ExactModel, together: float) -> Evaluation:
    """Fit at the noise that all outlines begin with."""
    model, _, _ = climb(points, model, 5, caps=False, enough=ENOUGH * together)
    return evaluate(points, fit_density(points, model, 1, caps=False), caps=False)


def _sharpened(now: Evaluation, start: ExactModel, together: float) -> tuple[Evaluation, float]:
    """Fit the noise, too, and the evidence; none for an outline that gave up most of the points."""
    end, _ = climbed(now, 8, noise=True, most=now.model.sigma, enough=ENOUGH * together)
    model = fit_density(now.points, end.model, 1, caps=False)
    now = evaluate(now.points, model, caps=False)
    crowded = model.density.coefficients[0] - start.density.coefficients[0] > np.log(CROWDED)
    return now, -np.inf if crowded else evidence(now, together)
