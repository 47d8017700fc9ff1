"""The profile of a body along its axis: which of its extrema and jumps are more than chance (paper, 4.4)."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats, Ints

__all__ = ["chance_tolerance", "local_extrema", "on_ledge", "profile_steps"]

LEVEL = 0.02
"""Differences of the profile below this share of its greatest value are no extrema."""
JUMP = 3.0


def chance_tolerance(profile: Floats) -> float:
    """Difference that chance alone makes between two bins, judged by the third differences.

    A smooth profile has hardly any; for white noise their standard deviation is the root of 20 as large.
    """
    sigma = 1.4826 * float(np.median(np.abs(np.diff(profile, 3)))) / np.sqrt(20)
    return max(5 * sigma, LEVEL * float(profile.max()))


def local_extrema(profile: Floats, tolerance: float) -> Ints:
    """Indices of the inner extrema whose neighbours all differ by more than the tolerance."""
    slope = np.sign(np.diff(profile))
    turning = np.flatnonzero(slope[1:] * slope[:-1] < 0) + 1
    chain = np.r_[0, turning, len(profile) - 1]
    while len(chain) > 2:
        step = np.abs(np.diff(profile[chain]))
        weakest = int(np.argmin(step))
        if step[weakest] > tolerance:
            break
        # An inner pair goes together, so that highs and lows still alternate; at the ends one goes.
        drop = [weakest, weakest + 1]
        chain = np.delete(chain, [i for i in drop if 0 < i < len(chain) - 1])
    return chain[1:-1]


def profile_steps(profile: Floats, tolerance: float) -> list[tuple[int, int]]:
    """Pairs of bins, neighbours or next but one, between which the profile jumps.

    A jump is three times what the profile changes on either side of it, over as many bins.
    """
    found: list[tuple[float, int, int]] = []
    for width in (1, 2):
        change = np.abs(profile[width:] - profile[:-width])
        unknown = np.full(width, -np.inf)
        padded = np.r_[unknown, change, unknown]
        beside = np.maximum(padded[: len(change)], padded[2 * width :])
        # At an end only one side shows how steep the profile is anyway, so that it has to show it twice.
        at_end = np.isinf(padded[: len(change)]) | np.isinf(padded[2 * width :])
        jumps = np.flatnonzero((change > 2 * tolerance) & (change > JUMP * (1 + at_end) * beside))
        found += [(-float(change[i]) / width, int(i), int(i) + width) for i in jumps]
    steps: list[tuple[int, int]] = []
    for _, low, high in sorted(found):
        if all(high <= a or low >= b for a, b in steps):
            steps.append((low, high))
    return steps


def on_ledge(extremum: int, steps: list[tuple[int, int]], profile: Floats, tolerance: float) -> bool:
    """Whether the profile is level from an extremum to a step, whose planes then stand for it."""
    for low, high in steps:
        ledge = high if extremum >= high else low
        between = profile[min(extremum, ledge) : max(extremum, ledge) + 1]
        if np.ptp(between) <= tolerance:
            return True
    return False
