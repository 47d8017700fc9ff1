"""Filleted walls: a prism with rounded ends for a chain of runs, where it explains the points better."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.free_walls import smooth_chains
from sketchloft.exact.likelihood import value_of
from sketchloft.exact.model import ExactModel
from sketchloft.exact.surgery import with_runs
from sketchloft.exact.trial import Change, tried_free
from sketchloft.outline.outline import Outline
from sketchloft.outline.placed_polygons import Rectangle, RoundedRectangle
from sketchloft.stack import Run
from sketchloft.wall.filleted import ENDS, Filleted
from sketchloft.wall.swept import Swept

__all__ = ["filleted"]

START = 0.12
"""Fillet that is tried first, in shares of the short side."""
SLIGHT = 0.04
"""Fillet that a run must be better with as it is, for more to be tried, in shares of the short side."""
GAIN = 15.0
"""What fillets must gain beside their price: a small one takes away next to nothing."""


def filleted(points: Floats, model: ExactModel, together: float) -> ExactModel:
    """One prism with rounded ends for a chain of runs, or for one run, where it pays.

    Parameters
    ----------
    points : (n, 3) float array
    model : ExactModel
        Fitted.
    together : float
        How many of the points go together.
    """
    for chain in smooth_chains(model):
        outline = _outline(model, chain)
        if outline is None:
            continue
        before = value_of(points, model)
        best: tuple[float, ExactModel] | None = None
        for slight, wall in zip(_starts(outline, SLIGHT), _starts(outline, START), strict=True):
            sharp = len(chain) == 1 and isinstance(outline, Rectangle)
            if sharp and value_of(points, _with(model, chain, slight)) <= before:
                continue
            change = Change(_with(model, chain, wall), range(chain.start, chain.start + 1), GAIN)
            found, gain = tried_free(points, model, change, together)
            if found is not None and (best is None or gain > best[0]):
                best = gain, found
        if best is not None:
            return filleted(points, best[1], together)
    return model


def _with(model: ExactModel, chain: range, wall: Filleted) -> ExactModel:
    return with_runs(model, chain.start, chain.stop - 1, Run((wall,)))


def _starts(outline: Rectangle | RoundedRectangle, share: float) -> Iterator[Filleted]:
    """The prism with fillets on all edges or on those of an end, a share of the short side."""
    sides = (outline.centre, outline.width, outline.height, outline.angle)
    short = min(outline.width, outline.height)
    for ends in ENDS:
        yield Filleted(RoundedRectangle(*sides, share * short), None, ends)
        yield Filleted(Rectangle(*sides), share * short, ends)


def _outline(model: ExactModel, chain: range) -> Rectangle | RoundedRectangle | None:
    """The largest rectangle that goes straight up in a chain of runs, if that has a rounded one or none."""
    found: tuple[float, Rectangle | RoundedRectangle] | None = None
    for j in chain:
        (wall,) = model.stack.runs[j].walls
        if isinstance(wall, Filleted):
            return None
        length = float(np.diff(model.stack.breaks)[j])
        outline: Outline | None = wall.outline if isinstance(wall, Swept) else None
        if isinstance(outline, (Rectangle, RoundedRectangle)) and (found is None or length > found[0]):
            found = length, outline
    return None if found is None else found[1]
