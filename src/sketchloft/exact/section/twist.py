"""Twist: whether the section of a segment turns with the height, from the moments of the raw points."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.section.section_contours import PlanView

__all__ = ["twist_of", "untwisted"]

FOLDS = range(2, 8)
MOST_TURN = 2.5
"""Largest turn of a segment that is looked for, in radians."""
TURNS = 101
CLEAR = 8.0
"""Standard deviations above chance that a turning moment must have."""
GAIN = 60.0
"""Squared deviations by which it must be above the moment that does not turn."""
MOST_POINTS = 3000


def twist_of(plan: PlanView, heights: Floats, together: float = 1.0) -> float:
    """Turn per height, in radians, at which the section's outline is sharpest; 0 where it does not turn.

    Parameters
    ----------
    plan : PlanView
    heights : (n,) float array
        Of its points, relative to the plan's.
    together : float
        How many of the points go together.

    Notes
    -----
    The moment of order k, the mean of ``(x + iy)**k``, turns k times as fast as the section. Among k = 2
    to 7 the one that stands out most from chance, once turned back, decides: its peak over the turn is
    a periodogram's.
    """
    step = len(heights) // MOST_POINTS + 1
    spokes = (plan.points[::step] - plan.centre) @ np.array([1, 1j])
    z = heights[::step]
    length = float(np.ptp(z))
    turns = np.linspace(-MOST_TURN, MOST_TURN, TURNS) / length
    together = max(together / step, 1.0)
    clear = CLEAR * float(np.sqrt(together))
    best, still, twist = clear, 0.0, 0.0
    for fold in FOLDS:
        power = spokes**fold
        chance = float(np.sqrt((np.abs(power) ** 2).sum()))
        peaks = np.abs(np.exp(-1j * fold * turns[:, None] * z) @ power) / chance
        top = int(np.argmax(peaks))
        if peaks[top] > best:
            best, still, twist = float(peaks[top]), float(peaks[TURNS // 2]), float(turns[top])
    return twist if best > clear and best**2 - still**2 > GAIN * together else 0.0


def untwisted(plan: PlanView, heights: Floats, twist: float) -> PlanView:
    """Plan with its points turned back."""
    spokes = (plan.points - plan.centre) @ np.array([1, 1j]) * np.exp(-1j * twist * heights)
    return replace(plan, points=plan.centre + np.column_stack([spokes.real, spokes.imag]))
