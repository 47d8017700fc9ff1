"""Pose: where the coordinates of a body, along its slicing direction, lie in those of the cloud."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from sketchloft.cloud import Floats, Unit
from sketchloft.exact.body import ExactBody
from sketchloft.frame import Frame
from sketchloft.pipeline import BodyModel, Reconstruction
from sketchloft.report.camera import Camera, axes, project
from sketchloft.report.words import axis_name, place

__all__ = ["Pose", "pose_of"]


@dataclass(frozen=True)
class Pose:
    """From a body's frame to what is drawn.

    Parameters
    ----------
    frame : Frame
        With z along the slicing direction.
    centre : (3,) float array
        Origin of the body's coordinates in those of the cloud.
    scale : float
        Length of the body's unit in that of the cloud.
    """

    frame: Frame
    centre: Floats
    scale: float = 1.0

    @property
    def plan(self) -> Camera:
        """Camera that looks against the slicing direction, with axes of the cloud to the right and up."""
        direction = self.frame.direction
        along = int(np.argmax(np.abs(direction)))
        up = (along + 2) % 3 if direction[along] > 0 else (along + 1) % 3
        x, y, z = np.eye(3)[up].tolist()
        dx, dy, dz = direction.tolist()
        return Camera((dx, dy, dz), (x, y, z))

    def in_space(self, points: Floats) -> Floats:
        """Points (..., 3) of the body in the axes and unit of the cloud, still about their own origin."""
        return self.scale * self.frame.to_world(points)

    def in_plan(self, points: Floats) -> Floats:
        """Points (m, 2) on a slice plane as the plan shows them, (m, 2) in the coordinates of the cloud."""
        there = self.in_space(np.c_[points, np.zeros(len(points))]) + self.centre
        return project(self.plan, there)[:, :2]

    def height(self, heights: Floats) -> Floats:
        """Heights (...) in the body as coordinates of the cloud along the slicing direction."""
        return np.asarray(self.scale * heights + self.centre @ self.frame.direction)

    def height_words(self, height: float, body: BodyModel) -> str:
        """One height, as exact as the body is large."""
        low, high = body.planes.heights[[0, -1]]
        return place(height + float(self.centre @ self.frame.direction), float(high - low))

    def labels(self, unit: Unit) -> tuple[str, str, str]:
        """Axis labels: to the right and up in the plan, and along the slicing direction."""
        name = axis_name(self.frame.direction)
        if not name:
            return f"across [{unit}]", f"across [{unit}]", f"height along the slicing direction [{unit}]"
        right, up, _ = axes(self.plan)
        return f"{axis_name(right)} [{unit}]", f"{axis_name(up)} [{unit}]", f"{name} [{unit}]"


def pose_of(result: Reconstruction, body: ExactBody | BodyModel) -> Pose:
    """Pose of one body of a reconstruction."""
    if isinstance(body, ExactBody):
        return Pose(body.frame, result.cloud.centre + body.centre, body.scale)
    return Pose(body.frame, result.cloud.centre)
