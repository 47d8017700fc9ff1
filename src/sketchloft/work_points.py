"""Stage 4: work the points onto the slice planes (paper, section 4.5)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from sketchloft.cloud import Floats, Ints
from sketchloft.errors import StageError

__all__ = ["WorkPointsParams", "WorkedSlice", "follow_slope", "work_points"]

Working = Literal["along-slope", "parallel"]

MIN_POINTS = 8
"""A contour cannot be found in fewer points than these."""
MOST = 2.0
"""Largest factor that a point is moved by along a slope."""
LEDGE = 0.1
"""Planes closer than this share of the median distance bracket a step; the section does not slope there."""


@dataclass(frozen=True)
class WorkPointsParams:
    """How the points are worked.

    Parameters
    ----------
    working : {"along-slope", "parallel"}
        "parallel" moves points along the slicing direction, as the paper does; where the wall slopes the
        widest part of the slice then becomes its contour. "along-slope" works the points once more, along
        the slope that the first contours show, which takes most of that error away.
    """

    working: Working = "along-slope"


@dataclass(frozen=True)
class WorkedSlice:
    """The points that belong to one slice plane, moved onto it.

    Parameters
    ----------
    height : float
        Position of the plane along the slicing direction.
    points : (m, 2) float array
        The worked points in the plane.
    """

    height: float
    points: Floats


def work_points(points: Floats, heights: Floats) -> tuple[WorkedSlice, ...]:
    """Allocate every point to the nearest slice plane and move it there along the slicing direction.

    A slice holds the points on both sides of its plane, half-way to the neighbouring planes.

    Parameters
    ----------
    points : (n, 3) float array
        In the frame of the slicing direction: z is the height.
    heights : (k,) float array
        Rising heights of the planes.

    Returns
    -------
    tuple of WorkedSlice

    Raises
    ------
    StageError
        If a slice holds too few points for a contour.
    """
    slice_of = _slice_of(points, heights)
    order = np.argsort(slice_of, kind="stable")
    worked = np.split(points[order, :2], np.searchsorted(slice_of[order], np.arange(1, len(heights))))
    fewest = int(np.argmin([len(part) for part in worked]))
    if len(worked[fewest]) < MIN_POINTS:
        raise StageError(
            f"found {len(worked[fewest])} points near height {heights[fewest]:.6g}, a contour needs "
            f"{MIN_POINTS}; use more points per slice, or look whether these are separate bodies",
            stage="work points",
            slice_index=fewest,
        )
    return tuple(WorkedSlice(float(h), part) for h, part in zip(heights, worked, strict=True))


def follow_slope(points: Floats, heights: Floats, centres: Floats, areas: Floats) -> Floats:
    """Move points across so that parallel working takes them along the slope of the wall.

    Between two planes the section's centre and the square root of its area are taken to change
    evenly. Every point is scaled about the centre at its own height to the section of its plane.

    Parameters
    ----------
    points : (n, 3) float array
    heights : (k,) float array
    centres : (k, 2) float array
        Centres of the contours that parallel working gave.
    areas : (k,) float array
        Their areas.

    Returns
    -------
    (n, 3) float array

    Notes
    -----
    This is the remedy for the error that the paper describes in section 5.1 where spheres meet.
    """
    own = _slice_of(points, heights)
    rise = points[:, 2] - heights[own]
    other = np.clip(own + np.where(rise > 0, 1, -1), 0, len(heights) - 1)
    gap = np.abs(heights[other] - heights[own])
    slopes = gap > LEDGE * np.median(np.diff(heights))
    share = np.divide(np.abs(rise), gap, out=np.zeros_like(gap), where=slopes)
    reach = np.sqrt(areas)
    at = reach[own] + share * (reach[other] - reach[own])
    centre = centres[own] + share[:, None] * (centres[other] - centres[own])
    across = centres[own] + (points[:, :2] - centre) * np.clip(reach[own] / at, 1 / MOST, MOST)[:, None]
    return np.c_[across, points[:, 2]]


def _slice_of(points: Floats, heights: Floats) -> Ints:
    """Index of the plane that each point is nearest to."""
    return np.searchsorted((heights[1:] + heights[:-1]) / 2, points[:, 2])
