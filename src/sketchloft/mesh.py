"""Mesh: triangles as arrays, the form in which models are measured and drawn."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from sketchloft.cloud import Floats, Ints

__all__ = ["Mesh", "concatenated"]


@dataclass(frozen=True)
class Mesh:
    """Triangles.

    Parameters
    ----------
    vertices : (m, 3) float array
    triangles : (t, 3) int array
        Rows of `vertices`, counter-clockwise seen from outside.
    """

    vertices: Floats
    triangles: Ints

    @property
    def corners(self) -> Floats:
        """(t, 3, 3) corner coordinates of every triangle."""
        return self.vertices[self.triangles]

    @property
    def areas(self) -> Floats:
        """(t,) area of every triangle."""
        a, b, c = np.moveaxis(self.corners, 1, 0)
        return np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2

    @property
    def volume(self) -> float:
        """Enclosed volume, by the divergence theorem; positive when the normals point outwards."""
        a, b, c = np.moveaxis(self.corners - self.vertices.mean(axis=0), 1, 0)
        return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)

    @property
    def size(self) -> float:
        """Diagonal of the bounding box."""
        return float(np.linalg.norm(np.ptp(self.vertices, axis=0)))


def concatenated(meshes: Sequence[Mesh]) -> Mesh:
    """One mesh of several, at least one."""
    sizes = [len(mesh.vertices) for mesh in meshes]
    starts = np.cumsum([0, *sizes[:-1]])
    triangles = [mesh.triangles + start for mesh, start in zip(meshes, starts, strict=True)]
    return Mesh(np.concatenate([mesh.vertices for mesh in meshes]), np.concatenate(triangles))
