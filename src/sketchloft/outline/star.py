"""Star: a polygon whose corners lie on two circles in turn, evenly spread."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar, Self

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.outline.chain_outline import ChainOutline
from sketchloft.outline.placed_polygons import moves_of, placed
from sketchloft.ring import ring_centre

__all__ = ["Star", "star_in", "star_of"]

FEWEST = 6
"""Corners of a star at least."""
ASTRAY = 0.15
"""Distance of a polygon's corner from the star's, in the radius, up to which it may be meant for it."""
TIPS = range(3, 13)
"""How many tips are looked for in a contour."""
AROUND = 240
CONCAVE = 0.9
"""Inner radius of a star at most, in that of the regular polygon with corners at its tips."""


@dataclass(frozen=True)
class Star(ChainOutline):
    """A star of equal tips.

    Parameters
    ----------
    centre : (2,) float array
    radius, inner_radius : float
        From the centre to the tips and to the corners between them, positive.
    angle : float
        Of the first tip from x, in radians.
    tips : int
        How many; fixed.
    """

    kind: ClassVar[str] = "star"

    centre: Floats
    radius: float
    inner_radius: float
    angle: float
    tips: int

    @property
    def vector(self) -> Floats:
        """Centre, both radii, angle: (5,)."""
        return np.array([*self.centre, self.radius, self.inner_radius, self.angle])

    def moved(self, vector: Floats) -> Self:
        """Return the star with other parameters; of the radii the sizes count."""
        radius, inner, angle = vector[2:].tolist()
        return replace(
            self, centre=vector[:2].copy(), radius=abs(radius), inner_radius=abs(inner), angle=angle
        )

    def chain(self) -> tuple[Floats, Floats]:
        """Tips and the corners between them, and bulges of 0."""
        return placed(self.centre, self.angle, self._local), np.zeros(2 * self.tips)

    def by_vector(self, gradient: Floats) -> Floats:
        """Apply the derivative of the corners."""
        return gradient[:, : 4 * self.tips] @ moves_of(self.angle, self._local, *self._spokes)

    @property
    def _local(self) -> Floats:
        outer, inner = self._spokes
        return self.radius * outer + self.inner_radius * inner

    @property
    def _spokes(self) -> tuple[Floats, Floats]:
        """Unit vectors (2 tips, 2) to the tips, and to the corners between them, 0 for the others."""
        turn = np.pi * np.arange(2 * self.tips) / self.tips
        spokes = np.column_stack([np.cos(turn), np.sin(turn)])
        is_tip = (np.arange(2 * self.tips) % 2 == 0)[:, None]
        return np.where(is_tip, spokes, 0.0), np.where(is_tip, 0.0, spokes)


def star_of(vertices: Floats) -> Star | None:
    """Star that a polygon's corners (m, 2), counter-clockwise, are about; None if they are far from one."""
    count = len(vertices)
    if count < FEWEST or count % 2:
        return None
    centre = vertices.mean(axis=0)
    spokes = (vertices - centre) @ [1, 1j] * np.exp(-2j * np.pi * np.arange(count) / count)
    first, second = spokes[::2], spokes[1::2]
    turn = float(np.angle(spokes.sum()))
    radii = [float((half * np.exp(-1j * turn)).real.mean()) for half in (first, second)]
    if min(radii) <= 0:
        return None
    outer = int(np.argmax(radii))
    star = Star(centre, radii[outer], radii[1 - outer], turn + outer * 2 * np.pi / count, count // 2)
    astray = np.abs(np.roll(star.chain()[0], outer, axis=0) - vertices).max()
    return star if astray < ASTRAY * star.radius else None


def star_in(ring: Floats) -> Star | None:
    """Star with as many tips as the radius of a contour (m, 2) has waves; None if these are too low."""
    centre = ring_centre(ring)
    spokes = (ring - centre) @ [1, 1j]
    order = np.argsort(np.angle(spokes))
    angles, radii = np.angle(spokes)[order], np.abs(spokes)[order]
    around = 2 * np.pi * np.arange(AROUND) / AROUND

    def radius(at: Floats) -> Floats:
        return np.interp(at, angles, radii, period=2 * np.pi)

    waves = np.fft.rfft(radius(around))
    tips = TIPS[int(np.argmax(np.abs(waves[TIPS.start : TIPS.stop])))]
    first = -float(np.angle(waves[tips])) / tips
    turn = first + 2 * np.pi * np.arange(tips) / tips
    outer, inner = float(radius(turn).mean()), float(radius(turn + np.pi / tips).mean())
    concave = inner < CONCAVE * outer * np.cos(np.pi / tips)
    return Star(centre, outer, inner, first, tips) if concave else None
