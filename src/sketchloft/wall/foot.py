"""What points see of a wall, and points spread over it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from sketchloft.cloud import Floats

__all__ = ["WallBoundary", "WallFoot"]


@dataclass(frozen=True)
class WallFoot:
    """Signed distance of points from a wall, first order exact near it.

    Parameters
    ----------
    distance : (n,) float array
        Positive outside of what the wall encloses.
    normal : (n, 3) float array
        Unit gradient of the distance.
    slopes : callable
        Finds the gradient, which many who ask for the distance have no use for.
    curvature : (n,) float array
        Sum of the principal curvatures, positive where the wall is convex.
    by_ends : (n, 2) float array, optional
        Derivative of the distance by the heights of the breaks, where the wall ends with them.
    """

    distance: Floats
    normal: Floats
    slopes: Callable[[], Floats]
    curvature: Floats
    by_ends: Floats | None = None

    @cached_property
    def gradient(self) -> Floats:
        """Derivative (n, p) of the distance by the wall's parameters."""
        return self.slopes()


@dataclass(frozen=True)
class WallBoundary:
    """Points over a wall between two heights, to integrate with.

    Parameters
    ----------
    points : (m, 3) float array
    normals : (m, 3) float array
        Outward unit normals.
    areas : (m,) float array
        Area that each point stands for.
    """

    points: Floats
    normals: Floats
    areas: Floats

    @property
    def centre(self) -> Floats:
        """Mean (2,) of the points seen along z, by the areas."""
        return np.asarray(self.areas @ self.points[:, :2] / max(float(self.areas.sum()), 1e-300))
