"""Recognise the shape of every section (paper, section 4.7)."""

from __future__ import annotations

import functools
from collections.abc import Callable, Sequence

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.edge_points import EdgePoints
from sketchloft.errors import StageError
from sketchloft.ring import ring_area, ring_is_simple, ring_length
from sketchloft.shapes.choice import ShapesParams, choices
from sketchloft.shapes.circle import Circle, fit_circle
from sketchloft.shapes.ellipse import Ellipse, fit_ellipse
from sketchloft.shapes.rectangle import Rectangle, fit_rectangle
from sketchloft.shapes.spline import ClosedSpline, fit_spline

__all__ = ["Shape", "recognise", "simpler"]

Shape = Circle | Ellipse | Rectangle | ClosedSpline

STAGE = "shapes"
FITS: dict[str, Callable[[Floats], Shape]] = {
    "circle": fit_circle,
    "ellipse": fit_ellipse,
    "rectangle": fit_rectangle,
}
POLES = (8, 12, 16, 24, 32, 48)
"""Numbers of control points that a closed spline may have."""
PRICE = 2.0
"""What a parameter costs where kinds are compared, in units of the criterion's log n."""
SAMPLES = 512
"""Points around a shape that its length and area are taken from."""


def recognise(edges: Sequence[EdgePoints], keys: Floats, params: ShapesParams) -> tuple[Shape, ...]:
    """Fit a shape to the edge points of every slice.

    Parameters
    ----------
    edges : sequence of EdgePoints
        By rising height.
    keys : (e,) float array
        Rising heights between which neighbouring sections have the same kind.
    params : ShapesParams

    Returns
    -------
    tuple of Shape

    Raises
    ------
    UsageError
        If a shape is asked for that is not known.
    StageError
        If the contour of a slice crosses itself however few control points it has.

    Notes
    -----
    The automatic choice takes, for all slices between two key heights together, the kind with the least
    Bayesian information criterion: n log of the mean squared residual plus log n for every parameter, which
    counts double here because neighbouring edge points are not independent. The number of control points of
    a spline is chosen slice by slice, with the single price. Every shape is then
    moved outwards evenly until it encloses the area that the points of its slice account for.
    """
    asked = choices(params.shapes, len(edges))
    run = np.searchsorted(keys[1:-1], [edge.height for edge in edges], side="right")
    points = [edge.points for edge in edges]

    @functools.cache
    def fit(index: int, kind: str) -> Shape:
        return FITS[kind](points[index]) if kind in FITS else _spline(points[index])

    found: list[Shape] = []
    for number in np.unique(run):
        members = np.flatnonzero(run == number).tolist()
        automatic = [i for i in members if asked[i] == "auto"]
        evidence = {
            kind: sum(_information(points[i], fit(i, kind), PRICE) for i in automatic)
            for kind in (*FITS, "off")
        }
        best = min(evidence, key=lambda kind: evidence[kind])
        found += [_settled(fit(i, best if asked[i] == "auto" else asked[i]), edges[i], i) for i in members]
    return tuple(found)


def _information(points: Floats, shape: Shape, price: float = 1.0) -> float:
    """Bayesian information criterion of a shape, but for a constant.

    An even offset is no fault of the shape: it is settled by area afterwards.
    """
    residual = shape.distance(points)
    spread = float(np.var(residual)) + 1e-12 * ring_length(points) ** 2
    return len(points) * np.log(spread) + price * shape.parameters * np.log(len(points))


def _spline(points: Floats) -> ClosedSpline:
    """Closed spline with the number of control points that has the most evidence."""
    fits = [fit_spline(points, count) for count in POLES if count <= max(POLES[0], len(points))]
    return min(fits, key=lambda fit: _information(points, fit))


def simpler(shape: Shape, edge: EdgePoints) -> Shape | None:
    """Spline through the same edge points with the next smaller number of control points, if there is one."""
    fewer = [count for count in POLES if count < shape.parameters]
    if shape.kind != "spline" or not fewer:
        return None
    return _grown(fit_spline(edge.points, fewer[-1]), edge.area)


def _settled(shape: Shape, edge: EdgePoints, index: int) -> Shape:
    """Shape that encloses the area of its slice; a spline that then crosses itself gets fewer poles."""
    settled: Shape | None = _grown(shape, edge.area)
    while settled is not None and not ring_is_simple(_ring(settled)):
        settled = simpler(settled, edge)
    if settled is None:
        raise StageError(
            f"the {shape.kind} through {len(edge.points)} edge points crosses itself; use a larger probe "
            "radius or more points per slice",
            stage=STAGE,
            slice_index=index,
        )
    return settled


def _grown(shape: Shape, area: float) -> Shape:
    """Shape moved outwards until it encloses the area."""
    for _ in range(3):
        ring = _ring(shape)
        shape = shape.grown((area - ring_area(ring)) / ring_length(ring))
    return shape


def _ring(shape: Shape) -> Floats:
    return shape.evaluate(np.arange(SAMPLES) / SAMPLES)
