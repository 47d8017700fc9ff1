"""Camera: where a thing is looked at from, in parallel projection."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.errors import UsageError

__all__ = ["ABOVE", "BEHIND", "FRONT", "SIDE", "Camera", "axes", "project"]


@dataclass(frozen=True)
class Camera:
    """A parallel view.

    Parameters
    ----------
    direction : (x, y, z)
        From the thing towards the eye, of any length.
    up : (x, y, z)
        What is up in the picture; not along `direction`.
    """

    direction: tuple[float, float, float] = (0.55, -1.0, 0.5)
    up: tuple[float, float, float] = (0.0, 0.0, 1.0)


FRONT = Camera()
"""From the front, a little from the right and from above."""
BEHIND = Camera((-0.55, 1.0, -0.4))
"""From behind and a little from below: shows every side that `FRONT` does not."""
SIDE = Camera((0.0, -1.0, 0.0))
"""Along +y: x runs to the right, z up."""
ABOVE = Camera((0.0, 0.0, 1.0), (0.0, 1.0, 0.0))
"""Along -z: x runs to the right, y up."""


def axes(camera: Camera) -> Floats:
    """(3, 3) unit rows: to the right, up in the picture, and towards the eye.

    Raises
    ------
    UsageError
        If the camera looks along its own up.
    """
    towards = np.array(camera.direction, dtype=float)
    right = np.cross(camera.up, towards)
    if np.linalg.norm(right) <= 1e-9 * np.linalg.norm(towards) * np.linalg.norm(camera.up):
        raise UsageError(
            f"camera: found direction {camera.direction} along up {camera.up}, expected two different "
            "directions; choose another up"
        )
    right /= np.linalg.norm(right)
    towards /= np.linalg.norm(towards)
    return np.stack([right, np.cross(towards, right), towards])


def project(camera: Camera, points: Floats) -> Floats:
    """Turn points (..., 3) into the picture: x to the right, y up, z towards the eye, in the same unit."""
    return np.asarray(points @ axes(camera).T)
