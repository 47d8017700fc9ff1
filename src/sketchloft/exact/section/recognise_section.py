"""Recognise section: the outline of every loop of a segment's section, chosen by evidence."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.dispersion import thinned
from sketchloft.exact.fit.climb import climb, fit_density
from sketchloft.exact.fit.schwarz import evidence
from sketchloft.exact.model.density import Density
from sketchloft.exact.model.exact_model import ExactModel, model_of
from sketchloft.exact.section.further_outlines import (
    STIFF,
    Tried,
    attempt_corners,
    attempt_splines,
    likeliest,
    nearly_free,
)
from sketchloft.exact.section.rarity import rarity
from sketchloft.exact.section.section_contours import contours
from sketchloft.outline.candidates import circle_of, ellipse_of, rectangle_like, rectangle_of, spline_of
from sketchloft.outline.outline import Outline
from sketchloft.ring import ring_length
from sketchloft.shapes.spline import resampled
from sketchloft.stack import Run, Stack
from sketchloft.wall.swept import Swept

__all__ = ["SectionShape", "recognise_section"]

MOST_POINTS = 3000
BESIDE = 4.0
"""Blurs beside a contour within which points tell where the outline is."""
CROWDED = 1.5
"""An outline that leaves the points so many times denser than its contour did has lost them."""
LOST = 0.01
"""Share of the places whose points are not looked at that an outline may leave on the wrong side."""
HOPELESS = 150.0, 25.0
"""An outline that is so much worse than another before the noise is fitted, in log likelihood and at least in
evidence, is given up."""
ENOUGH = 0.05
"""Evidence that a step gains for there to be another."""
LATTICE = 40
WAVES = np.arange(2, 13)
EVEN = 4.0
"""Power of a wave around a circle that chance exceeds once in exp(4) times."""
TELLING = 12.0
"""Independent points beside a circle at least, for their evenness to tell anything."""


@dataclass(frozen=True)
class SectionShape:
    """The outlines that bound a section.

    Parameters
    ----------
    outlines : tuple of Outline
        Those of pieces, then those of holes.
    holes : int
    """

    outlines: tuple[Outline, ...]
    holes: int


def recognise_section(points: Floats, together: float, *, rough: bool = False) -> SectionShape | None:
    """Find the outlines of a section filled by points (n, 2); None where there is no section.

    Parameters
    ----------
    points : (n, 2) float array
    together : float
        How many of the points go together; evidence counts that much less.
    rough : bool
        Whether a few kinds of outlines will do.
    """
    outer, holes, blur = contours(points, together)
    if not outer:
        return None
    outlines = [_best(points, ring, blur, together, hole=False, rough=rough) for ring in outer]
    outlines += [_best(points, ring, blur, together, hole=True, rough=rough) for ring in holes]
    return SectionShape(tuple(outlines), len(holes))


def _best(points: Floats, ring: Floats, blur: float, together: float, *, hole: bool, rough: bool) -> Outline:
    """Find the best outline for one loop from the points beside it."""
    near, core, area = _beside(points, ring, BESIDE * blur, hole=hole)
    every = len(near) // MOST_POINTS + 1
    near, together = near[::every], thinned(together, every)
    tried: Tried = []
    seen = [-np.inf]
    hopeless = max(HOPELESS[0] / together, HOPELESS[1])

    def attempt(outline: Outline) -> float:
        start = _model(near, core, area, outline, 0.5 * blur, hole=hole)
        at = np.column_stack([near, np.zeros(len(near))])
        model, value = _settled(at, start, together)
        seen.append(value)
        if value > max(seen) - hopeless:
            model, value = _sharpened(at, model, start, together)
            value -= rarity(outline)
        wall = model.stack.runs[0].walls[0]
        if isinstance(wall, Swept):
            value = value if _holds(wall.outline, core[:, :2], hole=hole) else -np.inf
            tried.append((value, wall.outline))
        return value

    free = attempt(spline_of(ring, STIFF))
    circle = attempt(circle_of(ring))
    ellipse = attempt(ellipse_of(ring))
    if circle > max(free, ellipse) and _even(near, tried[1][1], blur, together):
        # Strokes fill the corners of a rectangle less evenly than the rest.
        squares = [] if together == 1 else [rectangle_of(ring), rectangle_like(ellipse_of(ring))]
        if circle > max(map(attempt, squares), default=-np.inf):
            return tried[1][1]
    if rough:
        attempt(rectangle_of(ring))
        return likeliest(tried)
    attempt_corners(attempt, tried, ring, blur)
    if nearly_free(tried):
        attempt_splines(attempt, tried, ring)
    return likeliest(tried)


def _holds(outline: Outline, places: Floats, *, hole: bool) -> bool:
    """Whether an outline leaves the places (m, 2), whose points are not looked at, on their side."""
    depth = outline.foot(places).distance * (1 if hole else -1)
    return not len(places) or bool((depth < 0).mean() <= LOST)


def _even(near: Floats, outline: Outline, blur: float, together: float) -> bool:
    """Whether points just inside and outside an outline lie evenly around it, as around a circle.

    Notes
    -----
    Corners and flats show in the angles of the points beside the outline, whose Fourier coefficients
    have unit variance by chance (Rayleigh's test); of points that go together, that much more.
    """
    foot = outline.foot(near)
    arms = near[np.abs(foot.distance) < blur] - outline.boundary(24).points.mean(axis=0)
    angles = np.arctan2(arms[:, 1], arms[:, 0])
    powers = np.abs(np.exp(1j * WAVES[:, None] * angles).sum(axis=1)) ** 2 / max(len(angles), 1)
    return len(angles) > TELLING * together and bool((powers < EVEN * together).all())


def _beside(points: Floats, ring: Floats, width: float, *, hole: bool) -> tuple[Floats, Floats, float]:
    """Points within a width of a ring; the area inside left out; that taken."""
    from scipy.spatial import cKDTree  # noqa: PLC0415
    from shapely import Polygon as Region  # noqa: PLC0415
    from shapely import contains_xy  # noqa: PLC0415

    dense = resampled(ring, int(np.ceil(4 * ring_length(ring) / width)))
    away, _ = cKDTree(dense).query(points, distance_upper_bound=width)
    near = points[np.isfinite(away)]
    region = Region(dense)
    sign = -1 if hole else 1
    rest = region.buffer(sign * -width)
    low, high = dense.min(axis=0) - width, dense.max(axis=0) + width
    cells = np.stack(np.meshgrid(*[np.linspace(a, b, LATTICE) for a, b in zip(low, high, strict=True)]), -1)
    places = cells.reshape(-1, 2)
    places = places[contains_xy(rest, places)]
    share = np.full(len(places), sign * float(rest.area) / max(len(places), 1))
    core = np.column_stack([places, np.zeros(len(places)), share])
    return near, core, sign * float(region.area - rest.area)


def _model(
    near: Floats, core: Floats, area: float, outline: Outline, sigma: float, *, hole: bool
) -> ExactModel:
    wall = Swept(outline, 0.0, np.zeros(2), np.zeros(2))
    space = float(np.prod(np.ptp(near, axis=0)))
    return replace(
        model_of(
            Stack(np.array([-0.5, 0.5]), (Run((wall,), int(hole)),)),
            sigma,
            Density(np.array([np.log(len(near) / area), 0.0, 0.0, 0.0])),
            1.0 / space,
            space,
        ),
        core=core,
    )


def _settled(points: Floats, model: ExactModel, together: float) -> tuple[ExactModel, float]:
    """Fit at the noise that all outlines begin with, and the evidence."""
    model, _, _ = climb(points, model, 5, caps=False, enough=ENOUGH * together)
    model = fit_density(points, model, 1, caps=False)
    return model, evidence(points, model, together)


def _sharpened(
    points: Floats, model: ExactModel, start: ExactModel, together: float
) -> tuple[ExactModel, float]:
    """Fit the noise, too, and the evidence; none for an outline that gave up most of the points."""
    enough = ENOUGH * together
    model, _, _ = climb(points, model, 8, noise=True, caps=False, most=model.sigma, enough=enough)
    model = fit_density(points, model, 1, caps=False)
    crowded = model.density.coefficients[0] - start.density.coefficients[0] > np.log(CROWDED)
    return model, -np.inf if crowded else evidence(points, model, together)
