"""Measure: how far a model's surface lies from the goal's (paper, section 5.1)."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from functools import cached_property
from typing import Any

import numpy as np

from sketchloft.closed_mesh import closed_mesh
from sketchloft.cloud import Floats
from sketchloft.errors import UsageError
from sketchloft.mesh import Mesh
from sketchloft.signed_distance import signed_distance
from sketchloft.subdivide import subdivide

__all__ = ["ErrorFigures", "Measurement", "measure", "vertex_errors"]

ERROR_MAP_EDGE = 1 / 60
"""Longest edge of the mesh that carries an error map, in diagonals of the model."""


@dataclass(frozen=True)
class ErrorFigures:
    """Signed normal distances in four figures, all in one unit of length.

    Parameters
    ----------
    rms : float
        Root of the mean square.
    mean : float
        Signed: positive if the surface lies outside on the whole.
    p95 : float
        95 % of the distances are no larger than this, signs left aside.
    max : float
        The largest, sign left aside.
    """

    rms: float
    mean: float
    p95: float
    max: float

    @classmethod
    def of(cls, distances: Floats, unit: float = 1.0) -> ErrorFigures:
        """Summarise signed distances (n,), divided by the length `unit`."""
        d = distances / unit
        size = np.abs(d)
        return cls(
            float(np.sqrt((d * d).mean())), float(d.mean()), float(np.quantile(size, 0.95)), float(size.max())
        )


@dataclass(frozen=True)
class Measurement:
    """A model measured against a goal. Lengths are in the unit of the meshes.

    Parameters
    ----------
    model, goal : Mesh
        Welded and turned outwards.
    points : (n, 3) float array
        Points uniform on the model's surface.
    distances : (n,) float array
        Their normal distance from the goal's surface, + outside the goal, - inside it.
    back_points : (n, 3) float array
        Points uniform on the goal's surface.
    back_distances : (n,) float array
        Their normal distance from the model's surface, + outside the model, that is where the
        model misses a part of the goal, - inside it.
    """

    model: Mesh
    goal: Mesh
    points: Floats
    distances: Floats
    back_points: Floats
    back_distances: Floats

    @property
    def thousandth(self) -> float:
        """A thousandth of the diagonal of the goal's bounding box, the scale-free unit of errors."""
        return self.goal.size / 1000

    @cached_property
    def errors(self) -> ErrorFigures:
        """From the model's surface to the goal's."""
        return ErrorFigures.of(self.distances)

    @cached_property
    def back_errors(self) -> ErrorFigures:
        """From the goal's surface to the model's."""
        return ErrorFigures.of(self.back_distances)

    @cached_property
    def errors_in_thousandths(self) -> ErrorFigures:
        """`errors` in thousandths of the goal's diagonal."""
        return ErrorFigures.of(self.distances, self.thousandth)

    @cached_property
    def back_errors_in_thousandths(self) -> ErrorFigures:
        """`back_errors` in thousandths of the goal's diagonal."""
        return ErrorFigures.of(self.back_distances, self.thousandth)

    @cached_property
    def volume_error(self) -> float:
        """Share by which the model's volume exceeds the goal's."""
        return self.model.volume / self.goal.volume - 1

    @property
    def summary(self) -> dict[str, Any]:
        """The figures as plain numbers, for JSON."""
        return {
            "samples": len(self.distances),
            "goal_diagonal": self.goal.size,
            "model_to_goal": asdict(self.errors),
            "goal_to_model": asdict(self.back_errors),
            "thousandths": {
                "model_to_goal": asdict(self.errors_in_thousandths),
                "goal_to_model": asdict(self.back_errors_in_thousandths),
            },
            "model_volume": self.model.volume,
            "goal_volume": self.goal.volume,
            "volume_error": self.volume_error,
        }


def measure(model: Mesh, goal: Mesh, *, n: int = 20_000, seed: int = 0) -> Measurement:
    """Measure a model's surface against a goal's, both ways.

    Parameters
    ----------
    model, goal : Mesh
        Closed, in the same unit.
    n : int
        How many points are drawn on each surface.
    seed : int
        Of the points.

    Returns
    -------
    Measurement

    Raises
    ------
    ModelError
        If one of the meshes is not closed.
    UsageError
        If n is less than 1.

    Notes
    -----
    The paper's error is the normal distance between the resulting surface and the goal surface,
    positive outside (section 5.1). Taken from the model alone it does not see what the model
    misses, hence the way back.
    """
    if n < 1:
        raise UsageError(f"found n = {n}, a measurement needs at least 1 point on each surface")
    model, goal = closed_mesh(model, "model"), closed_mesh(goal, "goal")
    rng = np.random.default_rng(seed)
    points, back_points = _on_surface(model, n, rng), _on_surface(goal, n, rng)
    return Measurement(
        model, goal, points, signed_distance(points, goal), back_points, signed_distance(back_points, model)
    )


def vertex_errors(measurement: Measurement, longest: float = ERROR_MAP_EDGE) -> tuple[Mesh, Floats]:
    """Refine the model's mesh and measure its vertices, for a colour map.

    Parameters
    ----------
    measurement : Measurement
    longest : float
        Edges longer than this, in diagonals of the model, are cut.

    Returns
    -------
    mesh : Mesh
        The model's surface with (m, 3) vertices.
    distances : (m,) float array
        Signed distance of each vertex from the goal's surface, in the unit of the meshes.
    """
    mesh = subdivide(measurement.model, longest * measurement.model.size)
    return mesh, signed_distance(mesh.vertices, measurement.goal)


def _on_surface(mesh: Mesh, n: int, rng: np.random.Generator) -> Floats:
    """(n, 3) points uniform by area, one in each of n strips of equal area, so that they spread evenly."""
    edges = np.cumsum(mesh.areas)
    chosen = np.searchsorted(edges, (np.arange(n) + rng.random(n)) * (edges[-1] / n), side="right")
    a, b, c = np.moveaxis(mesh.corners[np.minimum(chosen, len(edges) - 1)], 1, 0)
    u, v = np.sqrt(rng.random((n, 1))), rng.random((n, 1))
    return np.asarray((1 - u) * a + u * (1 - v) * b + u * v * c)
