"""Ball, frustum and prism: the parts of goal solids, known in closed form."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sketchloft.cloud import Floats

__all__ = ["Ball", "Frustum", "Part", "Prism", "bounds", "in_polygon", "inside"]


@dataclass(frozen=True)
class Ball:
    """A ball.

    Parameters
    ----------
    centre : (x, y, z)
    radius : float
    """

    centre: tuple[float, float, float]
    radius: float


@dataclass(frozen=True)
class Frustum:
    """A cone's frustum about an axis along +z: a cylinder if both radii are equal, a cone if one is 0.

    Parameters
    ----------
    centre : (x, y, z)
        Centre of the base.
    bottom_radius, top_radius : float
        Radius at the base and at `height` above it.
    height : float
    """

    centre: tuple[float, float, float]
    bottom_radius: float
    top_radius: float
    height: float


@dataclass(frozen=True)
class Prism:
    """A polygon swept along +z.

    Parameters
    ----------
    outline : tuple of (x, y)
        Corners of a simple polygon, counter-clockwise seen from +z.
    z0 : float
        Level of the base.
    height : float
    """

    outline: tuple[tuple[float, float], ...]
    z0: float
    height: float


Part = Ball | Frustum | Prism


def bounds(part: Part) -> tuple[Floats, Floats]:
    """Lower and upper corner of a part's bounding box, both of shape (3,)."""
    match part:
        case Ball(centre, radius):
            return np.array(centre) - radius, np.array(centre) + radius
        case Frustum(centre, bottom, top, height):
            reach = np.array([max(bottom, top)] * 2 + [0.0])
            return np.array(centre) - reach, np.array(centre) + reach + (0.0, 0.0, height)
        case Prism(outline, z0, height):
            corners = np.array(outline)
            return np.append(corners.min(axis=0), z0), np.append(corners.max(axis=0), z0 + height)


def inside(part: Part, points: Floats) -> NDArray[np.bool_]:
    """(n,) whether each of (n, 3) points lies in a part; on its very surface the answer is either."""
    found: NDArray[np.bool_]
    match part:
        case Ball(centre, radius):
            found = ((points - np.array(centre)) ** 2).sum(axis=1) <= radius**2
        case Frustum(centre, bottom, top, height):
            x, y, z = (points - np.array(centre)).T
            radius_there = bottom + (top - bottom) * (z / height)
            found = (z >= 0) & (z <= height) & (x * x + y * y <= radius_there**2)
        case Prism(outline, z0, height):
            z = points[:, 2]
            found = (z >= z0) & (z <= z0 + height) & in_polygon(outline, points[:, 0], points[:, 1])
    return found


def in_polygon(outline: tuple[tuple[float, float], ...], x: Floats, y: Floats) -> NDArray[np.bool_]:
    """(n,) whether each point (x, y) lies in a polygon: its ray towards +x crosses an odd number of sides."""
    odd = np.zeros(len(x), dtype=bool)
    for (x0, y0), (x1, y1) in zip(outline, outline[1:] + outline[:1], strict=True):
        if y0 != y1:
            odd ^= ((y0 > y) != (y1 > y)) & (x < x0 + (y - y0) * ((x1 - x0) / (y1 - y0)))
    return odd
