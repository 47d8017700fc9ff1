"""Findings: noise, strays and density of a body, in words and figures."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Unit
from sketchloft.exact.body import ExactBody
from sketchloft.exact.fit.expected import mass_nodes, wall_nodes
from sketchloft.report.precision import Precision
from sketchloft.report.words import counted, number

__all__ = ["density_words", "noise_words", "size_of", "stray_count", "stray_words"]

EXTREMES = (0.02, 0.98)
"""Shares of the points between which the density is said to range."""


def size_of(body: ExactBody) -> float:
    """Diagonal of the solid's bounding box."""
    return float(np.linalg.norm(body.facts.bounds[1] - body.facts.bounds[0]))


def noise_words(body: ExactBody, errors: Precision) -> str:
    """Standard deviation of the points' noise; only a bound where the points lie too wide apart to tell."""
    known = "" if body.model.sigma > errors.gap else "under "
    return known + number(max(body.model.sigma, errors.gap) * body.scale, 2)


def stray_count(body: ExactBody) -> float:
    """About how many points are strays; less than one is none."""
    count = body.model.stray * body.model.space
    return count if count >= 1 else 0.0


def stray_words(body: ExactBody) -> str:
    """Number and share of strays."""
    count = stray_count(body)
    if not count:
        return "none"
    return f"about {counted(round(count), 'point')}, {number(100 * count / len(body.points), 2)} %"


def density_words(body: ExactBody, unit: Unit) -> str:
    """How densely the inside was drawn, and how evenly."""
    density = body.model.density
    at, volumes = mass_nodes(body.model, wall_nodes(body.model))
    mean = float(density.at(at) @ volumes) / float(volumes.sum()) / body.scale**3
    typical = f"{number(mean, 3)} points per {unit}³"
    if len(density.coefficients) == 1:
        return f"even, {typical}"
    least, most = np.quantile(density.at(body.points), EXTREMES).tolist()
    return f"graded by a factor of {number(most / least, 2)}, on average {typical}"
