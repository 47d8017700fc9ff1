"""Pieces: a contour cut into lines and arcs, as few as its noise allows."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from sketchloft.cloud import Floats, Ints
from sketchloft.intervals import cheapest_chain
from sketchloft.shapes.spline import resampled

__all__ = ["line_arc_pieces"]

SAMPLES = 120
FINE = 360
"""Samples of a contour that has many pieces at any price."""
MANY = 16
LINE_PRICE = 6.0
ARC_PRICE = 9.0
WIDEST = 6.0
"""Sweep of an arc at most, in radians: next to none is left of a circle for other pieces."""


def line_arc_pieces(
    ring: Floats, noise: float, rounding: float, prices: Sequence[float]
) -> list[tuple[Floats, Floats]]:
    """Cut a closed contour into lines and arcs, and into lines alone.

    Parameters
    ----------
    ring : (m, 2) float array
        Counter-clockwise.
    noise : float
        Standard deviation of the contour about the true outline.
    rounding : float
        Length beside a corner within which the contour is rounded off.
    prices : sequence of float
        What each piece costs, relative to the usual: larger values give fewer pieces.

    Returns
    -------
    list of (k, 2) and (k,) float arrays
        Vertices and bulges, 0 on lines; for each price lines and arcs, then for each price lines alone.

    Notes
    -----
    Dynamic programming over the samples of the contour, started where it turns most. What lies within
    `rounding` of a piece's ends does not count against it.
    """
    found = _cut(resampled(ring, SAMPLES), noise, rounding, prices)
    if min(len(vertices) for vertices, _ in found) <= MANY:
        return found
    return _cut(resampled(ring, FINE), noise, rounding, prices)


def _cut(
    points: Floats, noise: float, rounding: float, prices: Sequence[float]
) -> list[tuple[Floats, Floats]]:
    """Cut evenly spread samples (m, 2) of the contour."""
    step = float(np.linalg.norm(np.roll(points, -1, axis=0) - points, axis=1).mean())
    trim = int(np.clip(np.rint(rounding / step), 0, len(points) // 16))
    points = np.roll(points, -_sharpest(points, max(trim, 2)), axis=0)
    closed = np.concatenate([points, points[:1]])
    line, arc, bulge = _costs(closed, noise, trim)
    found = []
    for curved in (arc, np.full_like(arc, np.inf)):
        for price in prices:
            cuts, _ = cheapest_chain(np.minimum(line + LINE_PRICE * price, curved + ARC_PRICE * price))
            i, j = np.array(cuts[:-1]), np.array(cuts[1:])
            straight = line[i, j] + LINE_PRICE * price <= curved[i, j] + ARC_PRICE * price
            found.append((_corners(closed, i, j, straight, trim), np.where(straight, 0.0, bulge[i, j])))
    return found


def _sharpest(points: Floats, reach: int) -> int:
    before, after = np.roll(points, reach, axis=0) - points, np.roll(points, -reach, axis=0) - points
    turn = after[:, 0] * before[:, 1] - after[:, 1] * before[:, 0]
    flat = -np.einsum("ij,ij->i", before, after)
    return int(np.argmax(np.abs(np.arctan2(turn, flat))))


def _costs(closed: Floats, noise: float, trim: int) -> tuple[Floats, Floats, Floats]:
    """Cost of a line and of an arc over samples i to j, inf where there are too few; and the arc's bulge."""
    m = len(closed)
    line, arc, bulge = np.full((m, m), np.inf), np.full((m, m), np.inf), np.zeros((m, m))
    for i in range(m - 3):
        ends = np.arange(i + 2 * trim + 3, m)
        if not len(ends):
            continue
        inner = np.arange(i + trim, m - trim)
        p = closed[inner] - closed[i + trim]
        x, y = p.T
        s = x * x + y * y
        sums = np.cumsum(
            np.stack([np.ones(len(x)), x, y, s, x * x, x * y, y * y, x * s, y * s, s * s]), axis=1
        )[:, ends - trim - i - trim]
        n, sx, sy, ss, sxx, sxy, syy, sxs, sys_, sss = sums
        cxx, cxy, cyy = sxx - sx * sx / n, sxy - sx * sy / n, syy - sy * sy / n
        half, diff = (cxx + cyy) / 2, (cxx - cyy) / 2
        line[i, ends] = np.maximum(half - np.hypot(diff, cxy), 0) / (2 * noise**2)
        cxs, cys, css = sxs - sx * ss / n, sys_ - sy * ss / n, sss - ss * ss / n
        det = np.maximum(cxx * cyy - cxy**2, 1e-18 + 1e-9 * (cxx + cyy) ** 2)
        a, b = (cyy * cxs - cxy * cys) / det, (cxx * cys - cxy * cxs) / det
        radius = np.sqrt(np.maximum((ss - a * sx - b * sy) / n + (a * a + b * b) / 4, 1e-18))
        left = np.maximum(css - a * cxs - b * cys, 0) / (4 * radius**2)
        arc[i, ends] = left / (2 * noise**2)
        centre = np.column_stack([a, b]) / 2 + closed[i + trim]
        bulge[i, ends] = _bulge(closed[i], closed[ends], closed[(i + ends) // 2], centre)
    return line, arc, bulge


def _bulge(start: Floats, ends: Floats, middles: Floats, centres: Floats) -> Floats:
    """tan(sweep / 4) of arcs about centres from a start to ends, over the side where the middles are."""

    def angle(points: Floats) -> Floats:
        spoke = points - centres
        return np.arctan2(spoke[:, 1], spoke[:, 0])

    first = angle(np.broadcast_to(start, ends.shape))
    whole = np.mod(angle(ends) - first, 2 * np.pi)
    half = np.mod(angle(middles) - first, 2 * np.pi)
    sweep = np.where(half <= whole, whole, whole - 2 * np.pi)
    return np.tan(np.clip(sweep, -WIDEST, WIDEST) / 4)


def _corners(closed: Floats, i: Ints, j: Ints, straight: np.ndarray, trim: int) -> Floats:
    """Vertices: where neighbouring lines meet; else the contour's own point."""
    corners = closed[i].copy()
    for k in range(len(i)):
        before = k - 1
        if len(i) > 1 and straight[k] and straight[before]:
            meet = _meeting(
                closed[i[before] + trim : j[before] - trim + 1], closed[i[k] + trim : j[k] - trim + 1]
            )
            if meet is not None and np.linalg.norm(meet - corners[k]) < 0.25 * np.ptp(closed, axis=0).max():
                corners[k] = meet
    return corners


def _meeting(first: Floats, second: Floats) -> Floats | None:
    """Where the best lines through two sets of points meet."""
    lines = []
    for points in (first, second):
        mean = points.mean(axis=0)
        _, _, axes = np.linalg.svd(points - mean, full_matrices=False)
        lines.append((axes[1], axes[1] @ mean))
    matrix = np.array([lines[0][0], lines[1][0]])
    if abs(float(np.linalg.det(matrix))) < 0.05:
        return None
    return np.asarray(np.linalg.solve(matrix, np.array([lines[0][1], lines[1][1]])))
