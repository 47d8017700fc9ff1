"""Surgery: models with a run taken out, put in, or changed; ties that walls show stay."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from sketchloft.exact.model.exact_model import ExactModel, Tie, halves, model_of, tied
from sketchloft.exact.model.joins import natural_joins, sole_profile
from sketchloft.exact.model.kinks import kink_ties, squared_ties, without_loose_heights
from sketchloft.stack import Run, Stack, Wall

__all__ = ["RADIUS", "with_run", "with_runs", "with_split", "with_wall", "without_run"]

RADIUS = {"cylinder": 2, "sphere": 3}
"""Where the radius is among the parameters of a wall."""


def with_runs(model: ExactModel, first: int, last: int, run: Run) -> ExactModel:
    """Replace runs first to last (included) by one."""
    breaks = np.delete(model.stack.breaks, slice(first + 1, last + 1))
    runs = (*model.stack.runs[:first], run, *model.stack.runs[last + 1 :])
    return _rebuilt(model, Stack(breaks, runs))


def with_run(model: ExactModel, index: int, run: Run) -> ExactModel:
    """Replace one run."""
    return with_runs(model, index, index, run)


def with_wall(model: ExactModel, index: int, place: int, wall: Wall) -> ExactModel:
    """Replace one wall of a run."""
    run = model.stack.runs[index]
    return with_run(model, index, Run((*run.walls[:place], wall, *run.walls[place + 1 :]), run.holes))


def with_split(model: ExactModel, index: int, heights: Sequence[float], walls: Sequence[Wall]) -> ExactModel:
    """Replace one run by several of one wall each, with breaks at heights between them."""
    breaks = np.insert(model.stack.breaks, index + 1, heights)
    split = tuple(Run((wall,)) for wall in walls)
    return _rebuilt(model, Stack(breaks, (*model.stack.runs[:index], *split, *model.stack.runs[index + 1 :])))


def without_run(model: ExactModel, index: int, heir: int | None) -> ExactModel:
    """Take a run out; a neighbour takes over its heights, or nobody where it is the first or last."""
    if heir is not None:
        return with_runs(model, min(index, heir), max(index, heir), model.stack.runs[heir])
    breaks = np.delete(model.stack.breaks, 0 if index == 0 else len(model.stack.breaks) - 1)
    runs = tuple(run for j, run in enumerate(model.stack.runs) if j != index)
    return _rebuilt(model, Stack(breaks, runs))


def _rebuilt(model: ExactModel, stack: Stack) -> ExactModel:
    stack = replace(stack, runs=without_loose_heights(stack.runs))
    fresh = model_of(stack, model.sigma, model.density, model.stray, model.space)
    ties = [tie for j, run in enumerate(stack.runs) if run.torus is not None for tie in halves(j)]
    ties += [tie for j, run in enumerate(stack.runs) for tie in squared_ties(run, j)]
    for j in range(1, len(stack.runs)):
        below, above = stack.runs[j - 1 : j + 1]
        ties += _round_end(below, above, j) + kink_ties(below, above, j)
    return natural_joins(replace(tied(fresh, ties) if ties else fresh, core=model.core))


def _round_end(below: Run, above: Run, j: int) -> list[Tie]:
    """What a cylinder and a sphere of exactly the same axis and radius have in common."""
    first, second = sole_profile(below), sole_profile(above)
    if first is None or second is None or {first.kind, second.kind} != set(RADIUS):
        return []
    places = [
        ((j - 1, 0, k), (j, 0, m)) for k, m in ((0, 0), (1, 1), (RADIUS[first.kind], RADIUS[second.kind]))
    ]
    same = all(first.vector[one[2]] == second.vector[other[2]] for one, other in places)
    return places if same else []
