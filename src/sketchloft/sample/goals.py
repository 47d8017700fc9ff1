"""Goals: unions of parts, solids of known geometry that clouds are drawn from."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sketchloft.cloud import Floats
from sketchloft.sample import primitives
from sketchloft.sample.primitives import Ball, Frustum, Part, Prism
from sketchloft.sample.surface_samples import area, surface_samples

__all__ = ["GOALS", "Goal", "bounds", "inside", "on_surface"]

PROBE = 1e-7
"""How far beside a surface its two sides are looked at, in diagonals of the goal's box."""


@dataclass(frozen=True)
class Goal:
    """A solid of known geometry.

    Parameters
    ----------
    name : str
        What the command line calls it.
    parts : tuple of Part
        The solid is their union.
    description : str
        One line for the help text.
    """

    name: str
    parts: tuple[Part, ...]
    description: str


def bounds(goal: Goal) -> tuple[Floats, Floats]:
    """Lower and upper corner of a goal's bounding box, both of shape (3,)."""
    lows, highs = zip(*(primitives.bounds(part) for part in goal.parts), strict=True)
    return np.min(lows, axis=0), np.max(highs, axis=0)


def inside(goal: Goal, points: Floats) -> NDArray[np.bool_]:
    """(n,) whether each of (n, 3) points lies in a goal; on its very surface the answer is either."""
    found = primitives.inside(goal.parts[0], points)
    for part in goal.parts[1:]:
        found |= primitives.inside(part, points)
    return found


def on_surface(goal: Goal, n: int, rng: np.random.Generator) -> Floats:
    """(n, 3) points on a goal's surface, uniform by area.

    Notes
    -----
    Each part's surface is sampled by its area. A point belongs to the union's surface if no
    other part lies just outside it. Where two parts share a face, the first one's points count.
    """
    areas = np.array([area(part) for part in goal.parts])
    low, high = bounds(goal)
    probe = PROBE * float(np.linalg.norm(high - low))
    found, kept = 0, [np.empty((0, 3))]
    while found < n:
        counts = rng.multinomial(2 * (n - found) + 16, areas / areas.sum())
        batch = np.concatenate([_exposed(goal, i, m, probe, rng) for i, m in enumerate(counts)])
        kept.append(batch[rng.permutation(len(batch))])
        found += len(batch)
    return np.concatenate(kept)[:n]


def _exposed(goal: Goal, index: int, n: int, probe: float, rng: np.random.Generator) -> Floats:
    """Draw n points on one part's surface and keep those that lie on the union's."""
    points, normals = surface_samples(goal.parts[index], n, rng)
    hidden = np.zeros(n, dtype=bool)
    for other, part in enumerate(goal.parts):
        if other != index:
            hidden |= primitives.inside(part, points + probe * normals)
        if other < index:
            hidden |= primitives.inside(part, points - probe * normals)
    return points[~hidden]


def _block(half_x: float, half_y: float, z0: float, z1: float) -> Prism:
    x, y = half_x, half_y
    return Prism(((-x, -y), (x, -y), (x, y), (-x, y)), z0, z1 - z0)


def _shaft(radius: float, z0: float, z1: float) -> Frustum:
    return Frustum((0.0, 0.0, z0), radius, radius, z1 - z0)


_GOALS = (
    Goal(
        "three-spheres",
        (Ball((0.0, 0.0, 0.0), 4.0), Ball((0.0, 0.0, 5.0), 3.0), Ball((0.0, 0.0, 8.5), 2.0)),
        "three overlapping spheres of radius 4, 3 and 2 (paper, figures 11 and 14)",
    ),
    Goal("sphere", (Ball((0.0, 0.0, 0.0), 3.0),), "a sphere of radius 3 (paper, figure 12)"),
    Goal(
        "l-shape",
        (Prism(((0.0, 0.0), (10.0, 0.0), (10.0, 4.0), (4.0, 4.0), (4.0, 10.0), (0.0, 10.0)), 0.0, 4.0),),
        "an L of two legs, 10 x 10, 4 wide and 4 thick (paper, figures 4 and 13)",
    ),
    Goal(
        "lamp",
        (
            _shaft(5.0, 0.0, 1.5),
            _block(1.0, 0.75, 0.5, 12.5),
            Frustum((0.0, 0.0, 12.0), 6.0, 3.0, 6.0),
        ),
        "a lamp: round base, rectangular stand, conical shade (paper, figure 15)",
    ),
    Goal("cylinder", (_shaft(2.0, 0.0, 8.0),), "a cylinder of radius 2, 8 high"),
    Goal("box", (_block(3.0, 2.0, 0.0, 7.0),), "a box, 6 x 4 x 7"),
    Goal("cone", (Frustum((0.0, 0.0, 0.0), 4.0, 1.0, 7.0),), "a frustum of a cone, radius 4 to 1, 7 high"),
    Goal(
        "stepped-shaft",
        # Each thin piece ends within the thick one beside it, so that only its outside is a face.
        (_shaft(3.0, 0.0, 2.0), _shaft(1.5, 1.0, 7.5), _shaft(2.5, 7.0, 9.0), _shaft(1.0, 8.0, 12.0)),
        "a shaft of radius 3, 1.5, 2.5 and 1, with steps at 2, 7 and 9, 12 long",
    ),
)

GOALS: dict[str, Goal] = {goal.name: goal for goal in _GOALS}
"""Every goal by its name."""
