"""Seen: what the points show along a direction before any wall is fitted."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.dispersion import clump, dispersion
from sketchloft.exact.model.density import Density
from sketchloft.exact.section.level_set import LevelSet, hollow_share, level_set, on_grid
from sketchloft.exact.start.inside_density import inside_density
from sketchloft.exact.start.segments import SegmentsParams, segments
from sketchloft.exact.start.stray_space import stray_space
from sketchloft.frame import Frame, frame_along

__all__ = ["SEARCH_POINTS", "Seen", "in_frame", "sampled", "seen_along", "without_strays"]

SEARCH_POINTS = 12_000
"""The search looks at no more points; the fit looks at all."""
DIGITS = 6
"""Of coordinates: what a unit, an origin or a turn leaves in the last digits must not change the model."""


@dataclass(frozen=True, eq=False)
class Seen:
    """What the points show along a direction.

    Parameters
    ----------
    together : float
        How many points go together.
    blur : float
        Of the level set that they were looked at with.
    hollow : float
        Share of a closed region that is empty inside.
    kept : (m, 3) float array
        Those of the sample that are no strays.
    density : Density
        Inside.
    space : float
        Volume that strays come from.
    cuts : (k + 1,) float array
        Where the moments of the points say that the sections change.
    """

    together: float
    blur: float
    hollow: float
    kept: Floats
    density: Density
    space: float
    cuts: Floats


def in_frame(points: Floats, frame: Frame) -> Floats:
    """Points (n, 3) in a frame, without the digits that mean nothing."""
    return np.round(frame.to_local(points), DIGITS)


def sampled(points: Floats) -> Floats:
    """Every so many points, as many as the search looks at."""
    return points[:: len(points) // SEARCH_POINTS + 1]


def without_strays(points: Floats) -> tuple[LevelSet, float, Floats]:
    """The level set of points, how many of them go together, and those that are no strays."""
    together = dispersion(points)
    grid = level_set(points, clump(together))
    return grid, together, points[on_grid(grid, points, 2 * grid.blur)]


def seen_along(points: Floats, vector: Floats, params: SegmentsParams) -> Seen:
    """Look at points along a direction.

    Parameters
    ----------
    points : (n, 3) float array
        About 1 across, about their middle.
    vector : (3,) float array
    params : SegmentsParams
    """
    sample = sampled(in_frame(points, frame_along(vector, points)))
    grid, together, kept = without_strays(sample)
    return Seen(
        together,
        grid.blur,
        hollow_share(grid),
        kept,
        inside_density(sample, grid, together),
        stray_space(sample, together),
        segments(kept, params, together),
    )
