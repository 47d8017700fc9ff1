"""Frame: the coordinate system of a body, with z along the slicing direction."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from sketchloft.cloud import Floats

__all__ = ["Frame", "frame_along", "principal_axes", "principal_frame"]


@dataclass(frozen=True)
class Frame:
    """A right-handed orthonormal system.

    Parameters
    ----------
    axes : (3, 3) float array
        Unit vectors x, y, z in rows; z is the slicing direction.
    """

    axes: Floats

    @property
    def direction(self) -> Floats:
        """(3,) unit vector of the slicing direction."""
        return self.axes[2]

    def to_local(self, points: Floats) -> Floats:
        """Coordinates (..., 3) in this frame."""
        local: Floats = points @ self.axes.T
        return local

    def to_world(self, points: Floats) -> Floats:
        """Coordinates (..., 3) in the frame that this one is described in."""
        world: Floats = points @ self.axes
        return world


def frame_along(direction: Floats, points: Floats) -> Frame:
    """Turn z into the slicing direction (paper, section 4.4, step 1).

    The two axes across are the principal axes of the points seen along the direction, so that they
    turn with the cloud and nothing that follows depends on how the cloud was turned.

    Parameters
    ----------
    direction : (3,) float array
        Not zero.
    points : (n, 3) float array
        About their centre.
    """
    z = direction / np.linalg.norm(direction)
    helper = np.eye(3)[np.argmin(np.abs(z))]
    x = np.cross(helper, z)
    x /= np.linalg.norm(x)
    across = np.stack([x, np.cross(z, x)])
    flat = points @ across.T
    _, vectors = np.linalg.eigh(flat.T @ flat)
    x = vectors[:, 1] @ across
    # An axis has no sign of its own; its third moment gives it one that turns with the cloud.
    if ((points @ x) ** 3).sum() < 0:
        x = -x
    return Frame(np.stack([x, np.cross(z, x), z]))


def principal_axes(points: Floats) -> Floats:
    """Principal axes (3, 3) of points (n, 3) about their centre, in rows, the shortest first.

    An axis has no sign of its own; its third moment gives it one that turns with the cloud.
    """
    _, vectors = np.linalg.eigh(points.T @ points)
    signs = np.where(((points @ vectors) ** 3).sum(axis=0) < 0, -1.0, 1.0)
    return np.asarray(vectors.T * signs[:, None])


def principal_frame(points: Floats) -> Frame:
    """Right-handed frame of the principal axes of points (n, 3) about their centre, the longest first."""
    _, second, first = principal_axes(points)
    return Frame(np.stack([first, second, np.cross(first, second)]))
