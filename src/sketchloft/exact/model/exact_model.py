"""ExactModel: a stack of walls and what the cloud is like around it, under one vector of parameters."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal

import numpy as np

from sketchloft.cloud import Floats, Ints
from sketchloft.exact.model.density import Density
from sketchloft.stack import Run, Stack, spanned

__all__ = ["ExactModel", "Join", "Tie", "halves", "model_of", "thicker", "tied"]

Slots = tuple[tuple[Ints, ...], ...]
Join = Literal["step", "cross", "tangent", "pole"]
Tie = tuple[tuple[int, int, int], tuple[int, int, int]]
"""Two parameters that are one, each given as run, wall and place in the wall's vector."""


@dataclass(frozen=True)
class ExactModel:
    """A stack, the noise, and the densities inside and of strays.

    Parameters
    ----------
    stack : Stack
    slots : tuple of tuple of int arrays
        For each wall of each run, which entries of the common vector its own parameters are; walls that
        share entries are tied.
    sigma : float
        Standard deviation of the points' noise.
    density : Density
    stray : float
        Stray points per volume.
    space : float
        Volume that strays are spread over.
    joins : tuple of {"step", "cross", "tangent", "pole"}
        What each break is: a free plane; where the walls cross; where an arc ends tangent to a line; or
        where an arc meets the axis or the other half of a torus.
    core : (m, 4) float array or None
        Places inside that no point is given for, as when only those near the walls are looked at, and the
        volumes that they stand for.
    """

    stack: Stack
    slots: Slots
    sigma: float
    density: Density
    stray: float
    space: float
    joins: tuple[Join, ...]
    core: Floats | None = None

    @cached_property
    def vector(self) -> Floats:
        """Every wall's parameters, each tied one once."""
        out = np.empty(self.size)
        for run, slots in zip(self.stack.runs, self.slots, strict=True):
            for wall, slot in zip(run.walls, slots, strict=True):
                out[slot] = wall.vector
        out.setflags(write=False)
        return out

    @cached_property
    def size(self) -> int:
        """Number of walls' parameters."""
        return 1 + max((int(slot.max()) for slots in self.slots for slot in slots), default=-1)

    @property
    def parameters(self) -> int:
        """Number of free parameters of the shape: the walls' and the breaks."""
        return self.size + sum(join == "step" for join in self.joins)

    def moved(self, vector: Floats, breaks: Floats) -> ExactModel:
        """Return the model with other parameters of walls and breaks."""
        runs = tuple(
            Run(
                tuple(wall.moved(vector[slot]) for wall, slot in zip(run.walls, slots, strict=True)),
                run.holes,
            )
            for run, slots in zip(self.stack.runs, self.slots, strict=True)
        )
        return replace(self, stack=spanned(Stack(breaks, runs)))

    def between(self, breaks: Floats) -> ExactModel:
        """Return the model with other breaks."""
        return replace(self, stack=spanned(replace(self.stack, breaks=breaks)))


def thicker(model: ExactModel, factor: float) -> ExactModel:
    """Return the model of a cloud with so many times as many points."""
    return replace(model, density=model.density.times(factor), stray=model.stray * factor)


def model_of(stack: Stack, sigma: float, density: Density, stray: float, space: float) -> ExactModel:
    """Make a model in which nothing is tied and every break is a step."""
    slots, at = [], 0
    stack = spanned(stack)
    for run in stack.runs:
        row = []
        for wall in run.walls:
            count = len(wall.vector)
            row.append(np.arange(at, at + count))
            at += count
        slots.append(tuple(row))
    joins: tuple[Join, ...] = tuple("step" for _ in stack.breaks)
    return ExactModel(stack, tuple(slots), sigma, density, stray, space, joins)


def halves(run: int) -> list[Tie]:
    """Give the parameters that the two walls of a run have in common where they are the halves of a torus."""
    return [((run, 0, k), (run, 1, k)) for k in range(5)]


def tied(model: ExactModel, pairs: list[Tie]) -> ExactModel:
    """Tie pairs of parameters."""
    owner = np.arange(model.size)
    for (r0, w0, k0), (r1, w1, k1) in pairs:
        first, second = owner[model.slots[r0][w0][k0]], owner[model.slots[r1][w1][k1]]
        owner[owner == max(first, second)] = min(first, second)
    _, index = np.unique(owner, return_inverse=True)
    slots = tuple(tuple(index[slot] for slot in row) for row in model.slots)
    mean = np.zeros(index.max() + 1)
    np.add.at(mean, index, model.vector)
    mean /= np.bincount(index)
    return replace(model, slots=slots).moved(mean, model.stack.breaks)
