"""Revolved: a wall with circular sections about one axis; its profile is a line, an arc or a spline."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.gauss import gauss
from sketchloft.surface import basis_matrix, spline_at
from sketchloft.wall.foot import WallBoundary, WallFoot, spread
from sketchloft.wall.profile import ArcProfile, LineProfile, Profile, SplineProfile

__all__ = ["Revolved", "radius_at", "sizes"]

GAUSS = gauss(8)
SPAN_GAUSS = gauss(4)
TINY = 1e-12


@dataclass(frozen=True)
class Revolved:
    """A wall of revolution about an axis along z.

    Parameters
    ----------
    centre : (2,) float array
        Where the axis is.
    profile : Profile
    """

    centre: Floats
    profile: Profile

    @property
    def kind(self) -> str:
        """Cylinder, cone, sphere, torus or spline revolve."""
        match self.profile:
            case LineProfile(slope=None):
                return "cylinder"
            case LineProfile():
                return "cone"
            case ArcProfile(offset=None):
                return "sphere"
            case ArcProfile():
                return "torus"
            case _:
                return "spline revolve"

    @property
    def vector(self) -> Floats:
        """Centre, then the profile's parameters."""
        return np.concatenate((self.centre, _profile_vector(self.profile)))

    def moved(self, vector: Floats) -> Self:
        """Return the wall with other parameters."""
        return replace(self, centre=vector[:2].copy(), profile=_profile_moved(self.profile, vector[2:]))

    def area(self, heights: Floats) -> Floats:
        """Area of the sections at heights (m,)."""
        return np.pi * radius_at(self.profile, heights)[0] ** 2

    def foot(self, points: Floats) -> WallFoot:
        """Signed distance of points (n, 3), and its derivatives."""
        x, y, z = points.T
        x, y = x - self.centre[0], y - self.centre[1]
        r = np.maximum(np.hypot(x, y), 1e-12)
        distance, n_r, n_z, slopes, bend = _profile_foot(self.profile, r, z)
        flat = n_r / r
        normal = np.array([x * flat, y * flat, n_z]).T
        return WallFoot(distance, normal, lambda: np.vstack([-normal.T[:2], *slopes()]).T, bend + flat)

    def boundary(self, low: float, high: float, count: int) -> WallBoundary:
        """About `count` points on the wall between two heights."""
        z, weights = _heights(low, high, self.profile)
        around = max(12, count // len(z))
        angle = 2 * np.pi * (np.arange(around) + 0.5) / around
        r, slope = radius_at(self.profile, z)
        steep = np.hypot(1.0, slope)
        e = np.array([np.cos(angle), np.sin(angle)]).T
        areas = weights * r * steep * 2 * np.pi / around
        return spread(self.centre + r[:, None, None] * e, z, e, -slope[:, None], areas[:, None])


def radius_at(profile: Profile, heights: Floats) -> tuple[Floats, Floats]:
    """Radius and slope dr/dz of a profile at heights (m,); 0 and a steep slope beyond a sphere's poles."""
    match profile:
        case LineProfile(height, radius, slope):
            g = slope or 0.0
            return np.maximum(radius + g * (heights - height), 0.0), np.full(len(heights), g)
        case ArcProfile(height, offset, radius, side):
            dz = heights - height
            half = np.sqrt(np.maximum(radius**2 - dz**2, 0.0))
            lean = -side * dz / np.maximum(half, max(1e-9 * radius, TINY))
            return np.maximum((offset or 0.0) + side * half, 0.0), lean
        case SplineProfile(knots, radii):
            values, rise = spline_at(knots, SplineProfile.degree, radii, heights)
            return np.maximum(values, 0.0), rise


def _heights(low: float, high: float, profile: Profile) -> tuple[Floats, Floats]:
    """Gauss points and weights along z: of each knot span; on an arc in its angle, for its poles' sake."""
    if isinstance(profile, SplineProfile):
        ends = np.unique(np.clip(profile.knots, low, high))
        x, w = SPAN_GAUSS
        half = np.diff(ends)[:, None] / 2
        return ((ends[:-1, None] + ends[1:, None]) / 2 + half * x).ravel(), (half * w).ravel()
    x, w = GAUSS
    if isinstance(profile, ArcProfile):
        span = np.arcsin(np.clip((np.array([low, high]) - profile.height) / profile.radius, -1, 1))
        half_angle = (span[1] - span[0]) / 2
        angle = span.mean() + half_angle * x
        return profile.height + profile.radius * np.sin(angle), w * half_angle * profile.radius * np.cos(
            angle
        )
    return (low + high) / 2 + (high - low) / 2 * x, w * (high - low) / 2


def sizes(profile: Profile) -> int:
    """Number of a profile's parameters."""
    return len(_profile_vector(profile))


def _profile_vector(profile: Profile) -> Floats:
    match profile:
        case LineProfile(_, radius, slope):
            return np.array([radius] if slope is None else [radius, slope])
        case ArcProfile(height, offset, radius):
            return np.array([height, radius] if offset is None else [height, radius, offset])
        case SplineProfile(_, radii):
            return radii


def _profile_moved(profile: Profile, vector: Floats) -> Profile:
    match profile:
        case LineProfile(slope=None):
            return replace(profile, radius=float(vector[0]))
        case LineProfile():
            return replace(profile, radius=float(vector[0]), slope=float(vector[1]))
        case ArcProfile(offset=None):
            return replace(profile, height=float(vector[0]), radius=float(vector[1]))
        case ArcProfile():
            return replace(profile, height=float(vector[0]), radius=float(vector[1]), offset=float(vector[2]))
        case SplineProfile():
            return replace(profile, radii=vector.copy())


def _profile_foot(
    profile: Profile, r: Floats, z: Floats
) -> tuple[Floats, Floats, Floats, Callable[[], list[Floats]], Floats]:
    """Signed distance in the half plane, its gradient by r, by z and by the parameters, and the bend."""
    match profile:
        case LineProfile(_, radius, None):
            one, none = np.ones(len(r)), np.zeros(len(r))
            return r - radius, one, none, lambda: [-one], none
        case LineProfile(height, radius, slope):
            g = slope or 0.0
            c = 1 / np.hypot(1.0, g)
            s = c * (r - radius - g * (z - height))
            one = np.ones(len(r))

            def by_line() -> list[Floats]:
                return [-c * one, -c * (z - height) - s * g * c**2]

            return s, c * one, -g * c * one, by_line, 0 * one
        case ArcProfile(height, offset, radius, side):
            w_r, w_z = r - (offset or 0.0), z - height
            if offset is not None:  # on the far side of the arc's own axis the arc is not the wall
                w_r = side * np.maximum(side * w_r, 1e-12)
            length = np.maximum(np.hypot(w_r, w_z), 1e-12)
            n_r, n_z = side * w_r / length, side * w_z / length

            def by_arc() -> list[Floats]:
                return [-n_z, np.full(len(r), -float(side))] + ([] if offset is None else [-n_r])

            return side * (length - radius), n_r, n_z, by_arc, side / length
        case SplineProfile(knots, radii):
            values, rise = spline_at(knots, SplineProfile.degree, radii, z)
            c = 1 / np.hypot(1.0, rise)

            def by_spline() -> list[Floats]:
                return list(-c * basis_matrix(knots, SplineProfile.degree, z).T)

            return c * (r - values), c, -rise * c, by_spline, np.zeros(len(r))
