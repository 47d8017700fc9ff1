"""Filleted walls: a prism with rounded ends for a chain of runs, where it explains the points better."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.changes.change import Change
from sketchloft.exact.changes.free_trial import tried_free
from sketchloft.exact.fit.likelihood import value_of
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.exact.model.surgery import with_runs
from sketchloft.outline.candidates import rectangle_of
from sketchloft.outline.placed_polygons import Rectangle, RoundedRectangle
from sketchloft.outline.stadium import Stadium
from sketchloft.stack import Run, Wall
from sketchloft.wall.filleted import ENDS, Filleted
from sketchloft.wall.swept import Swept

__all__ = ["filleted", "fillets"]

START = 0.12
"""Fillet that is tried first, in shares of the short side."""
SLIGHT = 0.04
"""Fillet that a run must be better with as it is, for more to be tried, in shares of the short side."""
SURE = 40.0
"""Gain of fillets on more edges after which those on fewer are not tried."""
NARROWEST, WIDEST = 0.6, 1.05
"""Sizes of a section beyond a break that may belong to a fillet, in that of the section before it."""
AROUND = 96
FILLED = 0.9
"""Share of the rectangle around an outline that it fills where it could be one with rounded corners."""
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
    for chain, outline in _chains(model):
        before = value_of(points, model)
        best: tuple[float, ExactModel] | None = None
        for slight, wall in zip(*fillets(outline), strict=True):
            sharp = len(chain) == 1 and _straight(model.stack.runs[chain.start].walls[0])
            if sharp and value_of(points, _with(model, chain, slight)) <= before:
                continue
            change = Change(_with(model, chain, wall), range(chain.start, chain.start + 1), GAIN)
            found, gain = tried_free(points, model, change, together)
            if found is not None and (best is None or gain > best[0]):
                best = gain, found
            if gain > SURE:
                break
        if best is not None:
            return filleted(points, best[1], together)
    return model


def fillets(outline: Rectangle | RoundedRectangle) -> tuple[Iterator[Filleted], Iterator[Filleted]]:
    """Prisms over an outline with fillets on all edges or on those of an end, with slight and larger ones."""
    return _starts(outline, SLIGHT), _starts(outline, START)


def _with(model: ExactModel, chain: range, wall: Filleted) -> ExactModel:
    return with_runs(model, chain.start, chain.stop - 1, Run((wall,)))


def _starts(outline: Rectangle | RoundedRectangle, share: float) -> Iterator[Filleted]:
    """The prism with fillets on all edges or on those of an end, a share of the short side."""
    sides = (outline.centre, outline.width, outline.height, outline.angle)
    short = min(outline.width, outline.height)
    for ends in ENDS:
        yield Filleted(RoundedRectangle(*sides, share * short), None, ends)
        yield Filleted(Rectangle(*sides), share * short, ends)


def _straight(wall: Wall) -> bool:
    """Whether a wall is a prism with sharp edges, which slight fillets tell something of."""
    return isinstance(wall, Swept) and isinstance(wall.outline, Rectangle) and not wall.free


def _chains(model: ExactModel) -> Iterator[tuple[range, Rectangle | RoundedRectangle]]:
    """Runs that go straight up over a rectangle, about, alone and with what narrows beyond their ends."""
    for j, run in enumerate(model.stack.runs):
        wall = run.walls[0]
        if len(run.walls) > 1 or not isinstance(wall, Swept):
            continue
        outline = wall.outline.rounded if isinstance(wall.outline, Stadium) else wall.outline
        if not isinstance(outline, (Rectangle, RoundedRectangle)):
            rectangle = rectangle_of(outline.boundary(AROUND).points)
            if outline.area < FILLED * rectangle.area:
                continue
            outline = rectangle
        low, high = j, j + 1
        while low > 0 and _narrows(model, low, low - 1):
            low -= 1
        while high < len(model.stack.runs) and _narrows(model, high, high):
            high += 1
        if high - low > 1:
            yield range(low, high), outline
        yield range(j, j + 1), outline


def _narrows(model: ExactModel, k: int, beyond: int) -> bool:
    """Whether the section of the run beyond a break is that before it, about, or a little less."""
    runs, at = model.stack.runs, np.array([model.stack.breaks[k]])
    before = runs[k - 1] if beyond == k else runs[k]
    if len(runs[beyond].walls) > 1 or isinstance(runs[beyond].walls[0], Filleted):
        return False
    share = float(np.sqrt(runs[beyond].area(at)[0] / before.area(at)[0]))
    return NARROWEST < share < WIDEST
