"""Twist: whether the section of a segment turns with the height, from the moments of the raw points."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.section.section_contours import PlanView
from sketchloft.exact.section.sharpness import place_density

__all__ = ["seems_to_turn", "sharpest_twist", "twist_of", "untwisted"]

FOLDS = range(2, 8)
MOST_TURN = 2.5
"""Largest turn of a segment that is looked for, in radians."""
TURNS = 101
CLEAR = 8.0
"""Standard deviations above chance that a turning moment must have."""
GAIN = 30.0
"""Squared deviations by which it must be above the moment that does not turn."""
SHARPER = 60.0
"""Log likelihood that a turn must gain by sharpness: turns of round bars gain up to 45 by chance."""
LOOKS = 8
"""Turns that are looked at, up to the largest; between them, a parabola tells."""
STRIDE = 3
"""The one of these at which either way is looked at."""
SLABS = 128
"""Stretches along the height, over which no section turns by much."""
SEEN = 4.0
"""Standard deviations by which the ends must be turned against each other for a segment to seem to turn."""


def seems_to_turn(plan: PlanView, heights: Floats, together: float = 1.0) -> bool:
    """Whether the lower and the upper third of a segment are turned against each other, at a glance.

    Parameters
    ----------
    plan : PlanView
    heights : (n,) float array
        Of its points, relative to the plan's.
    together : float
        How many of the points go together.
    """
    spokes = (plan.points - plan.centre) @ np.array([1, 1j])
    third = float(np.ptp(heights)) / 6
    ends = spokes[heights < -third], spokes[heights > third]
    for fold in FOLDS:
        powers = [end**fold for end in ends]
        moments = [complex(power.sum()) for power in powers]
        chances = [together * float((np.abs(power) ** 2).sum()) for power in powers]
        clear = [
            abs(moment) ** 2 / max(chance, 1e-300) for moment, chance in zip(moments, chances, strict=True)
        ]
        turn = abs(float(np.angle(moments[1] * np.conj(moments[0]))))
        if min(clear) > CLEAR and turn > SEEN * float(np.sqrt(0.5 / clear[0] + 0.5 / clear[1])):
            return True
    return False


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
    spokes = (plan.points - plan.centre) @ np.array([1, 1j])
    low, length = float(heights.min()), float(np.ptp(heights))
    slab = np.minimum((SLABS * (heights - low) / length).astype(int), SLABS - 1)
    z = low + length * (np.arange(SLABS) + 0.5) / SLABS
    turns = np.linspace(-MOST_TURN, MOST_TURN, TURNS) / length
    back = np.exp(-1j * turns[:, None] * z)
    clear = CLEAR * float(np.sqrt(together))
    best, still, twist = clear, 0.0, 0.0
    for fold in FOLDS:
        power = spokes**fold
        real, imaginary = (np.bincount(slab, part, SLABS) for part in (power.real, power.imag))
        chance = float(np.sqrt((np.abs(power) ** 2).sum()))
        peaks = np.abs(back**fold @ (real + 1j * imaginary)) / chance
        top = int(np.argmax(peaks))
        if peaks[top] > best:
            best, still, twist = float(peaks[top]), float(peaks[TURNS // 2]), float(turns[top])
    return twist if best > clear and best**2 - still**2 > GAIN * together else 0.0


def sharpest_twist(plan: PlanView, heights: Floats, together: float = 1.0) -> float:
    """Turn per height, in radians, at which the section is sharpest by the density of its points.

    Parameters
    ----------
    plan : PlanView
    heights : (n,) float array
        Of its points, relative to the plan's.
    together : float
        How many of the points go together.

    Returns
    -------
    float
        0 where the log likelihood gains little.

    Notes
    -----
    Strokes fill a section so unevenly that its moments turn otherwise than its outline does, by as much as
    half. The outline is what makes points dense: their likelihood has one broad peak at its turn.
    """

    def sharp(twist: float) -> float:
        return float(np.log(place_density(untwisted(plan, heights, twist).points)).sum())

    step = MOST_TURN / float(np.ptp(heights)) / LOOKS
    way = max((STRIDE * step, -STRIDE * step), key=sharp) / STRIDE
    looks = [sharp(k * way) for k in range(LOOKS + 1)]
    top = min(max(int(np.argmax(looks)), 1), LOOKS - 1)
    before, here, after = looks[top - 1 : top + 2]
    bend = 2 * here - before - after
    found = way * (top + (float(np.clip((after - before) / (2 * bend), -1, 1)) if bend > 0 else 0.0))
    return found if sharp(found) - looks[0] > SHARPER * together else 0.0


def untwisted(plan: PlanView, heights: Floats, twist: float) -> PlanView:
    """Plan with its points turned back."""
    spokes = (plan.points - plan.centre) @ np.array([1, 1j]) * np.exp(-1j * twist * heights)
    return replace(plan, points=plan.centre + np.column_stack([spokes.real, spokes.imag]))
