"""Motion: which parameters of a model move in a climb."""

from __future__ import annotations

from typing import TypedDict

import numpy as np
from numpy.typing import NDArray

from sketchloft.exact.model.exact_model import ExactModel

__all__ = ["LAST", "Bools", "Motion", "free_parameters"]

Bools = NDArray[np.bool_]

LAST = 4
"""Parameters that come last: tilt, log sigma and log stray."""


class Motion(TypedDict, total=False):
    """What moves, and how far, in a climb.

    Parameters
    ----------
    tilt, noise, strays : bool
        Whether the direction, sigma and the density of strays move, too; the last only where all strays
        are among the points.
    least, most : float
        Smallest and largest sigma.
    enough : float
        Gain of a step, in log likelihood, below which it is the last.
    runs : range
        The runs whose walls, and the breaks between them, move; the ends of the stack move with them.
    """

    tilt: bool
    noise: bool
    strays: bool
    least: float
    most: float
    enough: float
    runs: range


def free_parameters(model: ExactModel, motion: Motion) -> Bools:
    """Which parameters move."""
    steps = [join == "step" for join in model.joins]
    tilt, noise, strays = (motion.get(name, False) for name in ("tilt", "noise", "strays"))
    free = np.array([*[True] * model.size, *steps, tilt, tilt, noise, strays])
    return free & _of_runs(model, motion["runs"]) if "runs" in motion else free


def _of_runs(model: ExactModel, runs: range) -> Bools:
    """Parameters of some runs' walls that no other run shares, the breaks within, and the last ones."""
    mine = np.zeros(model.size + len(model.stack.breaks) + LAST, dtype=bool)
    mine[-LAST:] = True
    others = np.zeros(model.size, dtype=bool)
    for j, row in enumerate(model.slots):
        for slot in row:
            (mine if j in runs else others)[slot] = True
    mine[: model.size] &= ~others
    last = len(model.slots)
    low = runs.start if runs.start == 0 else runs.start + 1
    high = runs.stop if runs.stop == last else runs.stop - 1
    mine[model.size + low : model.size + high + 1] = True
    return mine
