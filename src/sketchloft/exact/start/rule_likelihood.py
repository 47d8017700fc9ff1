"""Rule likelihood: how well a direction explains the points, before any shape is recognised.

Along the right direction, each segment's points fall on one sharp section once they are moved along the
segment's rule (`plan_view`). The density of a point is then that of its height times that of its place in
the section. A section that turns is turned back. Seen along a wrong direction the sections smear, and the
likelihood drops.
"""

from __future__ import annotations

import itertools

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.section.section_contours import plan_view
from sketchloft.exact.section.sharpness import place_density
from sketchloft.exact.section.twist import seems_to_turn, sharpest_twist, untwisted
from sketchloft.exact.start.segments import SegmentsParams, cut

__all__ = ["rule_likelihood"]

FEWEST = 40
PER_SEGMENT = 14.0
"""Parameters of a segment's rule, as they are priced."""


def rule_likelihood(points: Floats, params: SegmentsParams, together: float) -> float:
    """Log likelihood per point of points (n, 3) along z, each left out of the density that judges it."""
    cuts, _ = cut(points, params, together)
    low, high = cuts[0], cuts[-1]
    heights = points[:, 2]
    total = 0.0
    count = len(points)
    for start, stop in itertools.pairwise(cuts):
        inner = points[(heights >= start) & ((heights < stop) | (stop == high))]
        if len(inner) < FEWEST:
            total += len(inner) * -np.log((high - low) * 1.0) if len(inner) else 0.0
            continue
        plan = plan_view(inner, together)
        place = inner[:, 2] - plan.height
        if seems_to_turn(plan, place, together):
            plan = untwisted(plan, place, sharpest_twist(plan, place, together))
        along = _heights(inner[:, 2], float(start), float(stop))
        across = place_density(plan.points)
        total += float((np.log(along) + np.log(across) - 2 * np.log(plan.scale)).sum()) + len(inner) * np.log(
            len(inner) / count
        )
    price = PER_SEGMENT * (len(cuts) - 1) * np.log(count)
    return float(total - price) / count


def _heights(z: Floats, low: float, high: float) -> Floats:
    """Density (n,) of heights: a parabola, as areas are."""
    t = (z - (low + high) / 2) / ((high - low) / 2)
    moments = np.array([1.0, t.mean(), (t * t).mean()])
    # Legendre polynomials: the coefficients are the means of the polynomials themselves.
    density = 0.5 + 1.5 * moments[1] * t + 2.5 * (1.5 * moments[2] - 0.5) * (1.5 * t * t - 0.5)
    return np.maximum(density, 0.05) / ((high - low) / 2)
