"""Coaxial: one axis for all revolved walls, and one radius for what runs into each other."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.changes.simpler_walls import as_revolved
from sketchloft.exact.changes.worth import worth
from sketchloft.exact.fit.climb import climb
from sketchloft.exact.fit.likelihood import beside_walls
from sketchloft.exact.fit.tilt import onto_z
from sketchloft.exact.model.exact_model import ExactModel, Tie, halves, tied
from sketchloft.exact.model.joins import natural_joins
from sketchloft.exact.model.surgery import RADIUS
from sketchloft.stack import Wall
from sketchloft.wall.profile import ArcProfile
from sketchloft.wall.revolved import Revolved
from sketchloft.wall.swept import Swept

__all__ = ["coaxial"]

BESIDE = 12.0
"""Noise deviations from the walls within which points decide."""
STEEPEST = 0.5
"""Largest slope of the line through the centres that is taken for a common axis seen askew."""


def coaxial(
    points: Floats, model: ExactModel, together: float, *, tilt: bool
) -> tuple[ExactModel, Floats, Floats]:
    """Let all revolved walls have one axis, if it pays.

    Returns
    -------
    ExactModel
    (n, 3) float array
        The points, turned so that the axis is along z where the tilt is free.
    (3, 3) float array
        The rotation: new points = old points @ rotation.
    """
    # Circles that go straight up are cylinders; their parameters are the same.
    model = replace(model, stack=model.stack.with_walls(_as_cylinder))
    places = [
        (j, i)
        for j, run in enumerate(model.stack.runs)
        for i, wall in enumerate(run.walls)
        if isinstance(wall, Revolved)
    ]
    still = model, points, np.eye(3)
    if len(places) < 2:
        return still
    turn = _through_centres(model, places) if tilt else np.eye(3)
    turned = points @ turn
    straight = replace(model, stack=model.stack.with_walls(lambda wall: _sphere_turned(wall, turn)))
    pairs = [((*places[0], k), (*place, k)) for place in places[1:] for k in (0, 1)] + _tangents(model)
    near = turned[beside_walls(turned, straight, BESIDE * model.sigma)]
    rings = _rings(model)
    start = natural_joins(tied(straight, pairs + rings)) if rings else tied(straight, pairs)
    change, _, rotation = climb(near, start, 12, tilt=tilt)
    change = natural_joins(change)
    tangents = _tangents(change)
    if {*tangents} - {*pairs}:  # on one axis walls may run into each other that crossed before
        change, _, more = climb(near @ rotation, tied(change, tangents), 12, tilt=tilt)
        change, rotation = natural_joins(change), rotation @ more
    turned, count = turned @ rotation, len(points)
    pays = worth(turned, change, together, count) > worth(points, model, together, count)
    return (change, turned, turn @ rotation) if pays else still


def _as_cylinder(wall: Wall) -> Wall:
    return as_revolved(wall) if isinstance(wall, Swept) and not wall.free else wall


def _sphere_turned(wall: Wall, turn: Floats) -> Wall:
    """A sphere with its centre where it is after a turn of the points; any other wall as it is."""
    if not isinstance(wall, Revolved) or wall.kind != "sphere" or not isinstance(wall.profile, ArcProfile):
        return wall
    x, y, height = (np.array([*wall.centre, wall.profile.height]) @ turn).tolist()
    return Revolved(np.array([x, y]), replace(wall.profile, height=height))


def _tangents(model: ExactModel) -> list[Tie]:
    """Radii of spheres and of the cylinders they run into."""
    radius = [(j, 0, RADIUS.get(run.walls[0].kind, 0)) for j, run in enumerate(model.stack.runs)]
    return [(radius[k - 1], radius[k]) for k, join in enumerate(model.joins) if join == "tangent"]


def _rings(model: ExactModel) -> list[Tie]:
    """What the two walls of a run have in common that may be the halves of one torus."""
    return [
        tie
        for j, run in enumerate(model.stack.runs)
        if run.holes == 1 and run.kinds == ["torus", "torus"]
        for tie in halves(j)
    ]


def _through_centres(model: ExactModel, places: list[tuple[int, int]]) -> Floats:
    """Rotation that brings the line through the walls' centres along z."""
    breaks = model.stack.breaks
    at, weights = [], []
    for j, i in places:
        wall = model.stack.runs[j].walls[i]
        if isinstance(wall, Revolved):
            height = (breaks[j] + breaks[j + 1]) / 2
            if isinstance(wall.profile, ArcProfile) and wall.profile.offset is None:
                height = wall.profile.height
            at.append([*wall.centre, height])
            weights.append(breaks[j + 1] - breaks[j])
    z = np.array(at)[:, 2]
    if np.ptp(z) < 1e-3:
        return np.eye(3)
    slope = np.polyfit(z, np.array(at)[:, :2], 1, w=np.sqrt(weights))[0]
    return np.eye(3) if np.hypot(*slope) > STEEPEST else onto_z(slope)
