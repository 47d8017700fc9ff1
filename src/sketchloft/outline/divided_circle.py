"""DividedCircle: a circle cut into arcs, as where straight lines lead to it from the corners of a polygon."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar, Self

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.outline.chain_outline import ChainOutline

__all__ = ["DividedCircle"]


QUARTERS = np.pi / 2 * np.arange(4)
SIGNS = np.array([1.0, -1.0, 1.0, -1.0])
MOST = 0.9 * np.pi / 4
"""Largest stagger: at a quarter of pi two cuts would meet."""


@dataclass(frozen=True)
class DividedCircle(ChainOutline):
    """A circle of four arcs, long and short by turns.

    Parameters
    ----------
    centre : (2,) float array
    radius : float
        Positive.
    angle : float
        Of the first cut from x, in radians, were all arcs even.
    stagger : float
        By how much the first and the third cut are turned on from that, and the others back.
    """

    kind: ClassVar[str] = "divided circle"

    centre: Floats
    radius: float
    angle: float
    stagger: float

    @property
    def vector(self) -> Floats:
        """Centre, radius, angle, stagger: (5,)."""
        return np.array([*self.centre, self.radius, self.angle, self.stagger])

    def moved(self, vector: Floats) -> Self:
        """Return the circle with other parameters; of the radius the size counts."""
        radius, angle, stagger = vector[2:].tolist()
        stagger = float(np.clip(stagger, -MOST, MOST))
        return replace(self, centre=vector[:2].copy(), radius=abs(radius), angle=angle, stagger=stagger)

    def chain(self) -> tuple[Floats, Floats]:
        """Cuts, and the bulges of the arcs."""
        return self.centre + self.radius * self._spokes, np.tan(self._sweeps / 4)

    def by_vector(self, gradient: Floats) -> Floats:
        """Apply the derivative of the cuts and the bulges."""
        spokes = self._spokes
        around = self.radius * np.column_stack([-spokes[:, 1], spokes[:, 0]])
        x, y = (np.broadcast_to(axis, spokes.shape) for axis in np.eye(2))
        cuts = np.stack([x, y, spokes, around, SIGNS[:, None] * around], axis=2).reshape(8, 5)
        bulges = np.zeros((4, 5))
        bulges[:, 4] = -SIGNS / 2 / np.cos(self._sweeps / 4) ** 2
        return gradient @ np.concatenate([cuts, bulges])

    @property
    def _spokes(self) -> Floats:
        turn = self.angle + QUARTERS + self.stagger * SIGNS
        return np.column_stack([np.cos(turn), np.sin(turn)])

    @property
    def _sweeps(self) -> Floats:
        return np.pi / 2 - 2 * self.stagger * SIGNS
