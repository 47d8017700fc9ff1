"""Intervals: the cheapest chain of them from one end to the other."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats

__all__ = ["cheapest_chain"]


def cheapest_chain(cost: Floats) -> tuple[list[int], float]:
    """Places at which the intervals of the cheapest chain begin and end.

    Parameters
    ----------
    cost : (m, m) float array
        Of the interval from place i to place j > i; inf where there is none.

    Returns
    -------
    list of int
        From 0 to m - 1.
    float
        The cost of the chain.

    Notes
    -----
    Dynamic programming: the best chain to a place ends in the best of all intervals that end there.
    """
    best, back = np.full(len(cost), np.inf), np.zeros(len(cost), dtype=int)
    best[0] = 0.0
    for j in range(1, len(cost)):
        options = best[:j] + cost[:j, j]
        back[j] = int(np.argmin(options))
        best[j] = options[back[j]]
    chain = [len(cost) - 1]
    while chain[-1] > 0:
        chain.append(int(back[chain[-1]]))
    return chain[::-1], float(best[-1])
