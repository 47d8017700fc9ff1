"""Comparison: the figures of several methods and probe radii for one cloud (paper, section 5.3)."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from typing import Any, Literal, get_args

from sketchloft.cloud import CleanCloud
from sketchloft.compare.surface_facts import SurfaceFacts
from sketchloft.measurement import ErrorFigures
from sketchloft.mesh import Mesh

__all__ = ["METHODS", "Comparison", "Method", "Row"]

Method = Literal["slice and loft", "3D alpha shape", "octree"]
METHODS: tuple[Method, ...] = get_args(Method)


@dataclass(frozen=True)
class Row:
    """A method's figures for one probe radius. Lengths are in the unit of the cloud.

    Parameters
    ----------
    method : {"slice and loft", "3D alpha shape", "octree"}
    probe_radius : float, optional
        None for the octree, which has none.
    seconds : float
        Time to make the model. The alpha shapes share one triangulation; each is charged all of it.
    remark : str
        What else there is to know; why there is no model, where there is none.
    faces : int, optional
        Faces that the surface is described by: CAD faces of slice-and-loft, triangles of the alpha
        shape, squares of the octree. This and what follows is None where the method gave no model.
    triangles : int, optional
        Triangles that were measured and drawn.
    surface : SurfaceFacts, optional
        Whether the surface is closed, a manifold, and of how many shells.
    volume : float, optional
        What the surface encloses.
    voids_inside : int, optional
        Void cubes that the octree finds inside; None for the other methods.
    errors, missed : ErrorFigures, optional
        Signed normal distance from the model to the goal and from the goal to the model. This and what
        follows is also None where there is no goal.
    rms_thousandths : float, optional
        The root mean square of `errors` in thousandths of the goal's diagonal.
    volume_error : float, optional
        Share by which the volume exceeds the goal's.
    """

    method: Method
    probe_radius: float | None
    seconds: float
    remark: str
    faces: int | None = None
    triangles: int | None = None
    surface: SurfaceFacts | None = None
    volume: float | None = None
    voids_inside: int | None = None
    errors: ErrorFigures | None = None
    missed: ErrorFigures | None = None
    rms_thousandths: float | None = None
    volume_error: float | None = None

    @property
    def summary(self) -> dict[str, Any]:
        """The row as plain values for JSON; an infinite radius is "inf"."""
        infinite = self.probe_radius is not None and math.isinf(self.probe_radius)
        return asdict(self) | ({"probe_radius": "inf"} if infinite else {})


@dataclass(frozen=True)
class Comparison:
    """The methods side by side.

    Parameters
    ----------
    cloud : CleanCloud
    radii : tuple of float
    goal : Mesh, optional
    rows : tuple of Row
        Slice-and-loft for each radius, the alpha shape for each radius, the octree.
    meshes : tuple of Mesh or None
        The model of each row, where the cloud is; None where the method gave none.
    """

    cloud: CleanCloud
    radii: tuple[float, ...]
    goal: Mesh | None
    rows: tuple[Row, ...]
    meshes: tuple[Mesh | None, ...]

    @property
    def summary(self) -> dict[str, Any]:
        """The table as plain values for JSON."""
        goal = None if self.goal is None else {"diagonal": self.goal.size, "volume": self.goal.volume}
        return {"points": len(self.cloud), "goal": goal, "rows": [row.summary for row in self.rows]}
