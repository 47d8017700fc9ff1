"""Exact start: the first stack, segment by segment."""

from __future__ import annotations

import itertools

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.dispersion import clump
from sketchloft.exact.model.density import Density
from sketchloft.exact.model.exact_model import ExactModel, model_of
from sketchloft.exact.section.section_contours import plan_view
from sketchloft.exact.section.segment_walls import segment_run
from sketchloft.exact.section.twist import seems_to_turn, sharpest_twist
from sketchloft.stack import Run, Stack
from sketchloft.workers import ALONE, Workers

__all__ = ["FEWEST", "first_stack", "sketchy"]

FEWEST = 60
"""Points that a segment needs to have a section of its own."""
FEW = 80
"""Points that do not go together, in a segment, that tell a few kinds of sections apart only."""


def first_stack(
    points: Floats,
    cuts: Floats,
    blur: float,
    *,
    sigma: float,
    together: float,
    density: Density,
    space: float,
    rough: bool = False,
    workers: Workers = ALONE,
) -> ExactModel | None:
    """Model of the segments between cuts (k + 1,), from points (n, 3) without strays.

    Segments too thin or too empty for a section of their own are left to their neighbours. None where
    no segment has a section. A rough one knows few kinds of sections, and so do segments of few points.
    """
    turn = _turn(points, together)
    segments, parts = [], []
    for low, high in itertools.pairwise(cuts.tolist()):
        margin = min(blur, (high - low) / 5)
        inner = points[(points[:, 2] > low + margin) & (points[:, 2] < high - margin)]
        if high - low >= blur and len(inner) >= FEWEST:
            segments.append((low, high))
            parts.append((inner, (low + margin, high - margin)))

    def run_of(inner: Floats, ends: tuple[float, float], *, workers: Workers) -> Run | None:
        few = rough or sketchy(inner, together)
        return segment_run(inner, ends, sigma, together, density, rough=few, turn=turn, workers=workers)

    runs: list[Run] = []
    breaks: list[float] = []
    last = float(cuts[0])
    found = workers.beside(run_of, parts)
    for (low, high), run in zip(segments, found, strict=True):
        if run is not None:
            runs.append(run)
            breaks.append((low + last) / 2)
            last = high
    if not runs:
        return None
    breaks[0] = float(cuts[0])
    stack = Stack(np.array([*breaks, float(cuts[-1])]), tuple(runs))
    return model_of(stack, sigma, density, 1.0 / space, space)


def sketchy(points: Floats, together: float) -> bool:
    """Whether points (n, 3) of a segment, of which so many go together, tell a few kinds of sections only."""
    return len(points) < FEW * together


def _turn(points: Floats, together: float) -> float:
    """Turn per height that all sections seem to have, as one; 0 where they have none."""
    in_row = clump(together)
    plan = plan_view(points, in_row)
    heights = points[:, 2] - plan.height
    return sharpest_twist(plan, heights, in_row) if seems_to_turn(plan, heights, in_row) else 0.0
