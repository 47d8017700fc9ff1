"""DividedCircle: a circle cut into arcs, as where straight lines lead to it from the corners of a polygon."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar, Self

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.outline.chain_outline import ChainOutline

__all__ = ["DividedCircle"]


@dataclass(frozen=True)
class DividedCircle(ChainOutline):
    """A circle of arcs that are even, or long and short by turns.

    Parameters
    ----------
    centre : (2,) float array
    radius : float
        Positive.
    angle : float
        Of the first cut from x, in radians, were all arcs even.
    stagger : float
        By how much the first and every second cut are turned on from that, and the others back.
    arcs : int
        How many; fixed. Of four the stagger is a parameter.
    """

    kind: ClassVar[str] = "divided circle"

    centre: Floats
    radius: float
    angle: float
    stagger: float
    arcs: int

    @property
    def vector(self) -> Floats:
        """Centre, radius, angle, and of four arcs the stagger."""
        free = [self.stagger] if self.arcs == 4 else []
        return np.array([*self.centre, self.radius, self.angle, *free])

    def moved(self, vector: Floats) -> Self:
        """Return the circle with other parameters; of the radius the size counts."""
        radius, angle, *free = vector[2:].tolist()
        most = 0.9 * np.pi / self.arcs
        stagger = float(np.clip(free[0], -most, most)) if free else self.stagger
        return replace(self, centre=vector[:2].copy(), radius=abs(radius), angle=angle, stagger=stagger)

    def chain(self) -> tuple[Floats, Floats]:
        """Cuts, and the bulges of the arcs."""
        return self.centre + self.radius * self._spokes, np.tan(self._sweeps / 4)

    def by_vector(self, gradient: Floats) -> Floats:
        """Apply the derivative of the cuts and the bulges."""
        spokes, sign = self._spokes, self._signs
        around = self.radius * np.column_stack([-spokes[:, 1], spokes[:, 0]])
        count = self.arcs
        moves = np.zeros((3 * count, len(self.vector)))
        columns = [np.broadcast_to(axis, spokes.shape) for axis in np.eye(2)]
        columns += [spokes, around, *([sign[:, None] * around] if count == 4 else [])]
        moves[: 2 * count] = np.stack(columns, axis=2).reshape(2 * count, -1)
        if count == 4:
            moves[2 * count :, 4] = -sign / 2 / np.cos(self._sweeps / 4) ** 2
        return gradient @ moves

    @property
    def _signs(self) -> Floats:
        return np.where(np.arange(self.arcs) % 2 == 0, 1.0, -1.0)

    @property
    def _spokes(self) -> Floats:
        turn = self.angle + 2 * np.pi * np.arange(self.arcs) / self.arcs + self.stagger * self._signs
        return np.column_stack([np.cos(turn), np.sin(turn)])

    @property
    def _sweeps(self) -> Floats:
        return 2 * np.pi / self.arcs - 2 * self.stagger * self._signs
