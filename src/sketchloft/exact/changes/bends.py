"""Bends: prisms, straight or tapered, whose ends taper otherwise, as a chamfer or a roof does."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from sketchloft.exact.changes.change import Change
from sketchloft.exact.changes.simpler_walls import both_ways
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.exact.model.kinks import kink, sole_wall
from sketchloft.exact.model.set_upon import moved_off, set_upon_each_other, with_bend
from sketchloft.exact.model.surgery import with_split
from sketchloft.stack import Run
from sketchloft.wall.swept import Swept

__all__ = ["bends"]

SHARES = (0.12, 0.3)
"""Heights of an end, in that of its run, that are tried."""
THINNEST = 0.01
"""Height of an end, in sizes of the cloud, below which it is not looked for."""
TAPER = 0.1
"""Share by which an end is smaller than without, at first: which way it tapers is for the points to say."""


def bends(model: ExactModel) -> Iterator[Change]:
    """Neighbours that have the same outline at their break, and ends of runs that taper otherwise."""
    yield from _upon_each_other(model)
    for j, (run, low, high) in enumerate(model.stack.slabs()):
        wall = sole_wall(run)
        if not isinstance(wall, Swept) or {*wall.free} - {"taper"}:
            continue
        for side, share in ((side, share) for side in (1, -1) for share in SHARES):
            long = share * (high - low)
            if long < THINNEST:
                continue
            height = high - long if side > 0 else low + long
            size = float(wall.scale(np.array([height]))[0])
            tapering = replace(wall, taper=wall.taper - side * TAPER / long * size, free=("taper",))
            end = moved_off(tapering, wall, height)
            walls = (wall, end) if side > 0 else (end, wall)
            if kink(*(Run((one,)) for one in walls)) is not None:
                yield Change(with_split(model, j, [height], walls), range(j, j + 2))


def _upon_each_other(model: ExactModel) -> Iterator[Change]:
    """Walls of neighbouring runs, one of them from the outline of the other one."""
    for k in range(1, len(model.stack.runs)):
        for j, moved in set_upon_each_other(model, k):
            low, high = model.stack.breaks[j : j + 2].tolist()
            for wall in (moved, *both_ways(moved, low, high)):
                bent = with_bend(model, k, j, wall)
                if bent is not None:
                    yield Change(bent, range(j, j + 1))
