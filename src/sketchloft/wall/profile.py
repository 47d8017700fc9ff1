"""Profile: the radius of a revolved wall as a function of height: a line, an arc or a spline."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from sketchloft.cloud import Floats

__all__ = ["ArcProfile", "LineProfile", "Profile", "SplineProfile", "ends_of"]


@dataclass(frozen=True)
class LineProfile:
    """A cylinder (slope 0) or a cone: `radius + slope * (z - height)`.

    Parameters
    ----------
    height, radius, slope : float
        The height is fixed; slope None is a cylinder by choice, with no slope to fit.
    """

    height: float
    radius: float
    slope: float | None


@dataclass(frozen=True)
class ArcProfile:
    """A sphere or a torus: `offset + side * sqrt(radius**2 - (z - height)**2)`.

    Parameters
    ----------
    height : float
        Of the arc's centre.
    offset : float or None
        Distance of the arc's centre from the axis; None for a sphere.
    radius : float
    side : {1, -1}
        1: the arc bulges outwards; -1: inwards (a waist; a torus only).
    """

    height: float
    offset: float | None
    radius: float
    side: int = 1


@dataclass(frozen=True)
class SplineProfile:
    """A cubic spline r(z).

    Parameters
    ----------
    knots : (k + 4,) float array
        Clamped knots, in heights; they span at least the run.
    radii : (k,) float array
        Control values at the knots' Greville heights: the curve's poles are (radius, Greville height).
    """

    degree: ClassVar[int] = 3

    knots: Floats
    radii: Floats


Profile = LineProfile | ArcProfile | SplineProfile


def ends_of(profile: Profile) -> tuple[float, float]:
    """Heights between which a profile is given; infinite for lines."""
    if isinstance(profile, SplineProfile):
        return float(profile.knots[0]), float(profile.knots[-1])
    if isinstance(profile, ArcProfile):
        return profile.height - profile.radius, profile.height + profile.radius
    return -math.inf, math.inf
