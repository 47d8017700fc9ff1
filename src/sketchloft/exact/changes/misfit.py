"""Misfit: how far a run's walls are from where the points end, in waves over them, as a likelihood."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from sketchloft.cloud import Floats, Ints
from sketchloft.exact.fit.motion import Bools
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.stack import THIN, Wall, section_boundary

__all__ = ["HOPE", "misfit"]

HOPE = 6.0
"""How much more other walls may gain than the misfit shows, which counts points where walls weigh them."""

AROUND = 16
ALONG = 8
NODES = 600
WAVES = 6
"""Waves around that are looked at; finer ones are chance more often than shape."""
BOWS = 4
"""Cosines along that are looked at."""
CHANCE = 2.0
"""Standard deviations of the misfit of right walls that are left out of account."""
BANDS = (2.0, 4.0)
"""Half the widths of the bands that are counted, in noise deviations."""
WIDEST = 0.1
"""Half the width of a band at most, as a share of the size of the section."""
FEWEST = 0.5
"""Points that a patch expects at least."""


def misfit(points: Floats, model: ExactModel, runs: range, together: float) -> float:
    """Log likelihood that free walls would gain at least in the place of the walls of some runs, about.

    Parameters
    ----------
    points : (n, 3) float array
    model : ExactModel
    runs : range
    together : float
        How many of the points go together.

    Notes
    -----
    Of a band around the right wall one half is filled, whatever the noise. The lack or excess of points in
    each patch of the band, over the root of its expectation, varies by 1 by chance, and so does each wave
    that the patches are a sum of. What the slow waves vary by beyond chance tells of walls that are wrong;
    the band that shows most counts. Their mean does not count: more noise than there is moves walls inwards.
    Nor do places where two walls of a run come together, as the halves of a ring do.
    """
    breaks = model.stack.breaks
    total = np.zeros(len(BANDS))
    for j in runs:
        low, high = float(breaks[j]), float(breaks[j + 1])
        inner = points[(points[:, 2] > low) & (points[:, 2] < high)]
        for wall in model.stack.runs[j].walls:
            size = float(np.sqrt(np.abs(wall.area(np.linspace(low, high, 5))).min()))
            widths = np.minimum(np.array(BANDS) * model.sigma, WIDEST * size)
            others = [other for other in model.stack.runs[j].walls if other is not wall]
            patches = _patches(wall, low, high)
            per_width = np.zeros(AROUND * ALONG)
            for bottom, top in pairwise(np.linspace(low, high, ALONG + 1).tolist()):
                nodes = wall.boundary(bottom, top, NODES)
                alone = _apart(nodes.points, others, float(widths.max()))
                points_there = model.density.at(nodes.points) * nodes.areas * alone
                per_width += np.bincount(patches.of(nodes.points), points_there, AROUND * ALONG)
            alone = _apart(inner, others, float(widths.max()))
            away = np.abs(wall.foot(inner[alone]).distance)
            patch = patches.of(inner[alone])
            for k, width in enumerate(widths):
                found = np.bincount(patch[away < width], minlength=AROUND * ALONG)
                expected = np.maximum(per_width * width, FEWEST)
                total[k] += _beyond_chance((found - expected) / np.sqrt(expected * together))
    return max(float(total.max()), 0.0)


def _apart(places: Floats, others: list[Wall], width: float) -> Bools:
    """Whether a band of a wall around places (n, 3) has nothing to do with that of another wall."""
    found = np.ones(len(places), dtype=bool)
    for other in others:
        found &= np.abs(other.foot(places).distance) > 2 * width
    return found


def _beyond_chance(patches: Floats) -> float:
    """Log likelihood that the slow waves of patches gain, whose deviations are 1 by chance."""
    table = patches.reshape(ALONG, AROUND)
    middles = (np.arange(ALONG) + 0.5) * np.pi / ALONG
    cosines = np.cos(np.arange(BOWS)[:, None] * middles) * np.sqrt(2 / ALONG)
    cosines[0] /= np.sqrt(2)
    waves = np.abs(np.fft.rfft(cosines @ table, norm="ortho")[:, : WAVES + 1]) ** 2
    count = BOWS * (1 + 2 * WAVES) - 1
    power = float(waves[1:, 0].sum() + 2 * waves[:, 1:].sum())
    return (power - count - CHANCE * np.sqrt(2 * count)) / 2


@dataclass(frozen=True)
class _Patches:
    """Patches of a wall between two heights, about the line between its middles at both."""

    low: float
    high: float
    first: Floats
    last: Floats

    def of(self, points: Floats) -> Ints:
        """Which patch (n,) points (n, 3) belong to: by height, and by the angle about the middle."""
        share = np.clip((points[:, 2] - self.low) / (self.high - self.low), 0, 1 - 1e-9)
        spoke = points[:, :2] - self.first - share[:, None] * (self.last - self.first)
        turn = np.arctan2(spoke[:, 1], spoke[:, 0]) / (2 * np.pi) % 1.0
        around = np.minimum((turn * AROUND).astype(np.intp), AROUND - 1)
        return (share * ALONG).astype(np.intp) * AROUND + around


def _patches(wall: Wall, low: float, high: float) -> _Patches:
    ends = (section_boundary(wall, z, 64).centre for z in (low + THIN, high - THIN))
    return _Patches(low, high, *ends)
