"""Through sphere: the direction from the centre of a ball to what is beside it."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.fit.likelihood import share_of
from sketchloft.exact.start.start import Start
from sketchloft.wall.profile import ArcProfile
from sketchloft.wall.revolved import Revolved

__all__ = ["through_sphere"]

FEWEST = 60
"""Points beside a ball that tell where the rest of the thing is."""
CLEAR = 3.0
"""Noise deviations from the ball from which on points are beside it."""


def through_sphere(start: Start) -> Floats | None:
    """Direction (3,) from the centre of the largest sphere of a first stack to the points outside it.

    Notes
    -----
    A ball looks the same from everywhere, so that it does not tell the direction, and what is beside it may
    be too little to. But if the thing is revolved as a whole, the axis goes through both. None where there is
    no sphere, or nothing beside it.
    """
    model = start.merged
    spheres = [
        (wall.profile.radius, np.array([*wall.centre, wall.profile.height]))
        for run in model.stack.runs
        for wall in run.walls
        if isinstance(wall, Revolved) and isinstance(wall.profile, ArcProfile) and wall.kind == "sphere"
    ]
    if not spheres or len(model.stack.runs) == 1:
        return None
    radius, centre = max(spheres, key=lambda sphere: sphere[0])
    away = np.linalg.norm(start.sample - centre, axis=1) > radius + CLEAR * model.sigma
    beside = start.sample[away & (share_of(start.sample, model) > 0.5)]
    if len(beside) < FEWEST:
        return None
    arm = beside.mean(axis=0) - centre
    direction: Floats = arm / np.linalg.norm(arm) @ (start.settling.T @ start.frame.axes)
    return direction
