"""Meridian: the profile of coaxial revolved walls as a chain of exactly joined pieces in the half plane."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TypeGuard

import numpy as np

from sketchloft.brep.greville import greville
from sketchloft.cloud import Floats
from sketchloft.surface import basis_matrix
from sketchloft.wall.profile import ArcProfile, LineProfile, Profile, SplineProfile
from sketchloft.wall.revolved import radius_at

__all__ = ["MEET", "Piece", "Straight", "meridian"]

MEET = 1e-6
"""Difference of radius, as a share of the size, up to which neighbouring walls meet without a ledge."""
REACH = 10 * MEET
"""How far from a break, as a share of the size, walls may truly cross, or come down to the axis."""

TURN = 1e-12
"""Distance from the height where an arc turns back, as a share of its radius, that is none."""


@dataclass(frozen=True)
class Straight:
    """A straight profile whose ends say all: along the axis where there is no hole, or a ledge."""


@dataclass(frozen=True)
class Piece:
    """Part of a profile that passes exactly through its ends.

    Parameters
    ----------
    profile : Profile or Straight
        A line goes straight from start to end, whatever its own numbers are.
    start, end : (2,) float array
        Radius and height.
    """

    profile: Profile | Straight
    start: Floats
    end: Floats

    def reversed(self) -> Piece:
        """The piece walked the other way."""
        return replace(self, start=self.end, end=self.start)


def meridian(profiles: Sequence[Profile | Straight], breaks: Floats, size: float) -> list[Piece]:
    """Join the profiles of runs one upon another.

    Parameters
    ----------
    profiles : sequence of k Profile or Straight
    breaks : (k + 1,) float array
    size : float
        Of the whole solid.

    Returns
    -------
    list of Piece
        Rising. Two share a point where they cross, if that is within `REACH` of the break, or if their
        radii differ by no more than `MEET`: then on the cylinder if one of them is one, else half-way between
        them. Elsewhere there is a ledge.

    Notes
    -----
    An arc or a straight wall that comes down to the axis at the end of all, or where a hole ends, does so
    at the height that it says; the break moves there.
    """
    profiles, breaks = _without_idle_breaks(profiles, breaks, size)
    starts = [_on(profile, z) for profile, z in zip(profiles, breaks[:-1], strict=True)]
    ends = [_on(profile, z) for profile, z in zip(profiles, breaks[1:], strict=True)]
    inside = (breaks[:-1] + breaks[1:]) / 2
    for i, (below, above) in enumerate(pairwise(profiles)):
        joint = _joint(below, above, (ends[i], starts[i + 1]), inside[i : i + 2], size)
        if joint is not None:
            ends[i] = starts[i + 1] = joint
    starts[0] = _tip(profiles[0], starts[0], float(inside[0]), size)
    ends[-1] = _tip(profiles[-1], ends[-1], float(inside[-1]), size)
    return [
        Piece(_through(profile, start, end), start, end)
        for profile, start, end in zip(profiles, starts, ends, strict=True)
    ]


def _without_idle_breaks(
    profiles: Sequence[Profile | Straight], breaks: Floats, size: float
) -> tuple[list[Profile | Straight], Floats]:
    """Take neighbours that are one cylinder, or equal, as one."""
    kept, heights = [profiles[0]], [float(breaks[0])]
    for profile, z in zip(profiles[1:], breaks[1:-1].tolist(), strict=True):
        last = kept[-1]
        if _is_same(last, profile):
            continue
        if isinstance(last, LineProfile) and isinstance(profile, LineProfile):
            gap = abs(last.radius - profile.radius)
            if not last.slope and not profile.slope and gap <= MEET * size:
                kept[-1] = replace(last, radius=(last.radius + profile.radius) / 2)
                continue
        kept.append(profile)
        heights.append(z)
    return kept, np.array([*heights, breaks[-1]])


def _is_same(one: Profile | Straight, other: Profile | Straight) -> bool:
    if isinstance(one, SplineProfile) and isinstance(other, SplineProfile):
        return np.array_equal(one.knots, other.knots) and np.array_equal(one.radii, other.radii)
    return type(one) is type(other) and not isinstance(one, SplineProfile) and one == other


def _radius(profile: Profile | Straight, z: float) -> float:
    if isinstance(profile, Straight):
        return 0.0
    return float(radius_at(profile, np.array([z]))[0][0])


def _on(profile: Profile | Straight, z: float) -> Floats:
    return np.array([profile.offset if _turns_back(profile, z) else _radius(profile, z), z])


def _turns_back(profile: Profile | Straight, z: float) -> TypeGuard[ArcProfile]:
    """Whether an arc is level at a height: rounding is magnified there, and the other half may begin."""
    if not isinstance(profile, ArcProfile) or profile.offset is None:
        return False
    return abs(abs(z - profile.height) - profile.radius) < TURN * profile.radius


def _joint(
    below: Profile | Straight,
    above: Profile | Straight,
    ends: tuple[Floats, Floats],
    inside: Floats,
    size: float,
) -> Floats | None:
    """Where two profiles meet at a break; None where there is a ledge."""
    (r_below, z), (r_above, _) = ends
    if isinstance(below, Straight) or isinstance(above, Straight):  # a hole begins or ends
        hole, end, at = (
            (above, ends[1], inside[1]) if isinstance(below, Straight) else (below, ends[0], inside[0])
        )
        tip = _tip(hole, end, float(at), size)
        return tip if tip[0] == 0 else None
    crossing = _crossing(below, above, float(z), REACH * size)
    if crossing is not None or abs(r_below - r_above) > MEET * size:
        return crossing
    for profile, end in ((below, ends[0]), (above, ends[1])):
        if isinstance(profile, LineProfile) and not profile.slope:
            return end
    return (ends[0] + ends[1]) / 2


def _crossing(below: Profile, above: Profile, z: float, reach: float) -> Floats | None:
    def gap(at: float) -> float:
        return _radius(below, at) - _radius(above, at)

    low, high = z - reach, z + reach
    at_low = gap(low)
    if at_low * gap(high) >= 0:
        return None
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if gap(middle) * at_low > 0 else (low, middle)
    return _on(below, (low + high) / 2)


def _tip(profile: Profile | Straight, end: Floats, inside: float, size: float) -> Floats:
    """Where a profile reaches the axis at its end or just before or after it; else the end as it is."""
    side = np.sign(end[1] - inside)
    match profile:
        case ArcProfile(height, offset, radius, 1) if (offset or 0.0) < radius:
            tip = height + side * np.sqrt(radius**2 - (offset or 0.0) ** 2)
        case LineProfile(height, radius, slope) if slope and slope * side < 0:
            tip = height - radius / slope
        case _:
            return end if end[0] > MEET * size else np.array([0.0, end[1]])
    is_there = side * (tip - end[1]) <= REACH * size or end[0] <= MEET * size
    return np.array([0.0, tip]) if is_there else end


def _through(profile: Profile | Straight, start: Floats, end: Floats) -> Profile | Straight:
    """The profile bent by no more than its ends were moved, so that it passes through them."""
    match profile:
        case ArcProfile():
            return _arc_through(profile, start, end)
        case SplineProfile(knots, radii):
            p = SplineProfile.degree
            inner = knots[(knots > start[1] + 1e-9) & (knots < end[1] - 1e-9)]
            cut = np.concatenate([np.full(p + 1, start[1]), inner, np.full(p + 1, end[1])])
            sites = greville(cut, p)
            # The part of a spline is one on the cut knots: as many values as poles give it back exactly.
            back = np.linalg.inv(basis_matrix(cut, p, sites))
            part: Floats = back @ basis_matrix(knots, p, sites) @ radii
            part[[0, -1]] = start[0], end[0]
            return SplineProfile(cut, part)
    return profile


def _arc_through(arc: ArcProfile, start: Floats, end: Floats) -> ArcProfile:
    centre = np.array([arc.offset or 0.0, arc.height])
    away = np.linalg.norm([start - centre, end - centre], axis=1) - arc.radius
    if np.abs(away).max() < 1e-12 * arc.radius:
        return arc
    if arc.offset is None:
        height = (end @ end - start @ start) / (2 * (end[1] - start[1]))
        return replace(arc, height=float(height), radius=float(np.hypot(start[0], start[1] - height)))
    chord = (end - start) / np.linalg.norm(end - start)
    centre = centre - chord * ((centre - (start + end) / 2) @ chord)
    return replace(
        arc,
        offset=float(centre[0]),
        height=float(centre[1]),
        radius=float(np.linalg.norm(start - centre)),
    )
