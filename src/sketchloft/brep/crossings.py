"""Crossings: where the rims of two level sections meet."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from sketchloft.brep.section_rims import Feet, Section
from sketchloft.cloud import Floats, Ints

__all__ = ["Crossing", "crossings"]

PER_TURN = 96
"""Places on a full turn of a rim that are looked at."""
ROUNDS = 5
"""How often the places around a nearest approach are halved, to see whether it is two crossings."""
STEEP = 1000.0
"""Rims that are within the tolerance of each other for a shorter way than so many tolerances just cross."""
MAX_STEPS = 40
ZERO = 1e-13


@dataclass(frozen=True)
class Crossing:
    """A place on a rim of one section and on one of another, each with the parameter on its curve."""

    rim: int
    at: float
    other_rim: int
    other_at: float


def crossings(section: Section, other: Section, tolerance: float) -> Iterator[Crossing]:
    """Find where the rims of a section meet those of another.

    Parameters
    ----------
    section, other : Section
    tolerance : float
        Distance up to which rims are taken for one.

    Yields
    ------
    Crossing
        Where rims cross steeply, one; where they run together for a while, where that begins and ends.

    Notes
    -----
    They are zeros of the distance of the one section's rims from the other, which is well behaved even
    where two free curves run almost together.
    """
    found = _looked_at(section, other, tolerance)
    d, levels = found.feet.distance, np.array([-tolerance, tolerance])[:, None]
    same = found.rim[:-1] == found.rim[1:]
    level, i = np.nonzero(same & ((d[:-1] - levels) * (d[1:] - levels) < 0))
    goal = levels[level, 0]
    brackets = _Brackets(found.rim[i], found.t[i], found.t[i + 1], d[i] - goal, d[i + 1] - goal, goal)
    places = _merged_places(section, brackets, _roots(section, brackets, other), STEEP * tolerance)
    if not places:
        return
    rim, t = np.array([place[0] for place in places]), np.array([place[1] for place in places])
    feet = other.feet(section.at(rim, t))
    for found_rim, at, other_rim, other_at in zip(rim, t, feet.rim, feet.at, strict=True):
        yield Crossing(int(found_rim), float(at), int(other_rim), float(other_at))


@dataclass(frozen=True)
class _Samples:
    """Places on rims, rim by rim in the sense of their curves, and their distance from another section."""

    rim: Ints
    t: Floats
    feet: Feet


def _sampled(section: Section, rim: Ints, t: Floats, other: Section) -> _Samples:
    return _Samples(rim, t, other.feet(section.at(rim, t)))


def _looked_at(section: Section, other: Section, tolerance: float) -> _Samples:
    """Places on all rims, denser where they come near to the other section without crossing it."""
    spread = [rim.curve.spread(PER_TURN) for rim in section.rims]
    rim = np.repeat(np.arange(len(spread)), [len(t) for t in spread])
    found = _sampled(section, rim, np.concatenate(spread), other)
    for _ in range(ROUNDS):
        away = np.abs(found.feet.distance)
        pair = found.rim[:-1] == found.rim[1:]
        inner = np.flatnonzero(pair[:-1] & pair[1:]) + 1
        points = section.at(found.rim, found.t)
        chord = np.hypot(*(points[inner + 1] - points[inner]).T)
        least = (away[inner] <= away[inner - 1]) & (away[inner] <= away[inner + 1])
        least &= (away[inner] < chord) & (away[inner] > tolerance)
        same = np.sign(found.feet.distance[inner - 1]) == np.sign(found.feet.distance[inner + 1])
        at = np.unique(np.concatenate([inner[least & same] - 1, inner[least & same]]))
        if not len(at):
            break
        more = _sampled(section, found.rim[at], (found.t[at] + found.t[at + 1]) / 2, other)
        found = _merged(found, more)
    return found


def _merged(one: _Samples, other: _Samples) -> _Samples:
    rim, t = np.concatenate([one.rim, other.rim]), np.concatenate([one.t, other.t])
    order = np.lexsort((t, rim))
    joined = (
        np.concatenate([getattr(one.feet, name), getattr(other.feet, name)])[order]
        for name in ("distance", "rim", "at")
    )
    return _Samples(rim[order], t[order], Feet(*joined))


@dataclass(frozen=True)
class _Brackets:
    """Parameters on rims between which the distance passes a goal, and by how much it differs at both."""

    rim: Ints
    low: Floats
    high: Floats
    at_low: Floats
    at_high: Floats
    goal: Floats


def _merged_places(section: Section, brackets: _Brackets, t: Floats, steep: float) -> list[tuple[int, float]]:
    """Places on rims where the distance passes the tolerance, two of a steep crossing taken as one."""
    order = np.lexsort((t, brackets.rim))
    events = [(int(brackets.rim[k]), float(t[k]), float(brackets.goal[k])) for k in order]
    places: list[tuple[int, float]] = []
    while events:
        rim, at, goal = events.pop(0)
        if events and events[0][0] == rim and section.rims[rim].curve.length(at, events[0][1]) < steep:
            _, next_at, next_goal = events.pop(0)
            if next_goal != goal:
                places.append((rim, (at + next_at) / 2))
        else:
            places.append((rim, at))
    return places


def _roots(section: Section, brackets: _Brackets, other: Section) -> Floats:
    """Where in the brackets the distance is the goal, by the Illinois method."""
    a, b, fa, fb = brackets.low, brackets.high, brackets.at_low, brackets.at_high
    for _ in range(MAX_STEPS):
        moves = np.abs(fb) >= ZERO
        if not moves.any():
            break
        t = np.where(moves, (a * fb - b * fa) / np.where(moves, fb - fa, 1.0), b)
        f = other.feet(section.at(brackets.rim, t)).distance - brackets.goal
        stays = (f * fb > 0) | ~moves
        a, fa = np.where(stays, a, b), np.where(stays, fa / 2, fb)
        b, fb = t, f
    return b
