"""What points see of a wall, and points spread over it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from sketchloft.cloud import Floats

__all__ = ["WallBoundary", "WallFoot", "spread"]


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


def spread(at: Floats, z: Floats, flat: Floats, slope: Floats, areas: Floats) -> WallBoundary:
    """Points over a wall, ring by ring.

    Parameters
    ----------
    at : (m, k, 2) float array
        Where they are seen along z; of one ring (k, 2) where all are alike.
    z : (m,) float array
        Heights of the rings.
    flat : (m, k, 2) float array
        Outward unit normals of the rings; of one (k, 2) where all are alike.
    slope : (m, k) float array
        Rise of the normals by their flat length; with axes of length 1 where it is the same along them.
    areas : (m, k) float array
        Area that each point stands for; as `slope`.
    """
    shape = np.broadcast_shapes(at.shape[:-1], (len(z), 1))
    points, normals, steep = np.empty((*shape, 3)), np.empty((*shape, 3)), np.hypot(1.0, slope)
    points[..., :2], points[..., 2] = at, z[:, None]
    normals[..., :2], normals[..., 2] = flat / steep[..., None], slope / steep
    return WallBoundary(points.reshape(-1, 3), normals.reshape(-1, 3), np.broadcast_to(areas, shape).ravel())
