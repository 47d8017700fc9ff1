"""Search: from a first stack to the model that explains the points best, fitted to all of them."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from sketchloft.exact.changes.evidence import improved
from sketchloft.exact.changes.worth import worth
from sketchloft.exact.fit.likelihood import rising
from sketchloft.exact.search.explained import explained
from sketchloft.exact.search.finished import finished
from sketchloft.exact.search.found import Found
from sketchloft.exact.start.start import Start
from sketchloft.workers import ALONE, Workers

__all__ = ["search"]


def search(
    start: Start,
    *,
    tilt: bool,
    lofts: bool = True,
    progress: Callable[[str], None],
    workers: Workers = ALONE,
) -> Found:
    """Find the runs on a sample and fit them to all points.

    Parameters
    ----------
    start : Start
    tilt : bool
        Whether the direction moves, too.
    lofts : bool
        Whether free lofts are tried.
    progress : callable
        Called with "fit" when the runs are found.
    workers : Workers, optional

    Notes
    -----
    The evidence is judged with a noise that may hide what a wall is. Where the first stack of an even cloud
    is worth more than the end, it is changed as long as that pays with its own noise, too.
    """
    model, turn = explained(start, tilt=tilt, lofts=lofts, workers=workers)
    found = finished(start, model, turn, tilt=tilt, lofts=lofts, progress=progress, workers=workers)
    first, count = start.merged, len(start.sample)
    if start.together > 1 or worth(rising(start.sample), first, start.together, count) < found.value:
        return found
    sharp = improved(start.sample, first, start.together, lofts=lofts, workers=workers)
    other = finished(start, sharp, np.eye(3), tilt=tilt, lofts=lofts, progress=_unsaid, workers=workers)
    return max(found, other, key=lambda end: end.value)


def _unsaid(_: str) -> None:
    """Tell no stage: the fit has been told of."""
