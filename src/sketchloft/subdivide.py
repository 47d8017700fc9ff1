"""Subdivide: halve the long edges of a mesh until none is longer than a length."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from sketchloft.cloud import Ints
from sketchloft.mesh import Mesh

__all__ = ["subdivide"]


def subdivide(mesh: Mesh, longest: float) -> Mesh:
    """Halve edges longer than `longest` until none is left; the surface stays what it is.

    Parameters
    ----------
    mesh : Mesh
        With shared vertices, so that both triangles at an edge are cut at the same point.
    longest : float
        In the unit of the mesh.

    Returns
    -------
    Mesh
        The vertices of `mesh` come first.

    Notes
    -----
    Only long edges are cut (a triangle into two, three or four), so that thin triangles become
    more regular and neighbours still fit.
    """
    while True:
        finer = _halved(mesh, longest)
        if finer is mesh:
            return mesh
        mesh = finer


def _halved(mesh: Mesh, longest: float) -> Mesh:
    ends = mesh.triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
    keys, edge = np.unique(ends.min(axis=1) * len(mesh.vertices) + ends.max(axis=1), return_inverse=True)
    start, end = (mesh.vertices[i] for i in divmod(keys, len(mesh.vertices)))
    long = np.linalg.norm(end - start, axis=1) > longest
    if not long.any():
        return mesh
    middle = np.where(long, len(mesh.vertices) + np.cumsum(long) - 1, -1)[edge].reshape(-1, 3)
    vertices = np.concatenate([mesh.vertices, (start + end)[long] / 2])
    return Mesh(vertices, _cut(mesh.triangles, middle))


def _cut(triangles: Ints, middle: Ints) -> Ints:
    """Cut triangles (t, 3) at the new vertices on their edges (t, 3), -1 where an edge is not cut."""
    cuts = (middle >= 0).sum(axis=1)
    # Turn each triangle so that its cut edges come first: with one cut it is edge 0, with two 0 and 1.
    first = np.where(cuts == 1, (middle >= 0).argmax(axis=1), ((middle < 0).argmax(axis=1) + 1) % 3)
    turn = (first[:, None] + np.arange(3)) % 3
    a, b, c = np.take_along_axis(triangles, turn, axis=1).T
    ab, bc, ca = np.take_along_axis(middle, turn, axis=1).T

    def pieces(chosen: NDArray[np.bool_], *corners: tuple[Ints, Ints, Ints]) -> list[Ints]:
        return [np.stack([p[chosen], q[chosen], r[chosen]], axis=1) for p, q, r in corners]

    return np.concatenate(
        [
            triangles[cuts == 0],
            *pieces(cuts == 1, (a, ab, c), (ab, b, c)),
            *pieces(cuts == 2, (ab, b, bc), (a, ab, bc), (a, bc, c)),
            *pieces(cuts == 3, (a, ab, ca), (ab, b, bc), (bc, c, ca), (ab, bc, ca)),
        ]
    )
