"""Corner normals: smooth where a surface is, sharp at its creases."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats, Ints
from sketchloft.mesh import Mesh

__all__ = ["corner_normals"]


def corner_normals(mesh: Mesh, crease: float = 30.0) -> Floats:
    """Normals at the corners of triangles, equal for neighbours that meet at a small angle.

    Parameters
    ----------
    mesh : Mesh
        With shared vertices.
    crease : float
        Triangles that meet at a larger angle, in degrees, keep their own normals.

    Returns
    -------
    (t, 3, 3) float array
        Unit normals; the corners of each triangle along axis 1.

    Notes
    -----
    Around each vertex the triangles fall into groups, joined over edges that are not creases; the
    normal of a group is the mean of its triangles' normals, weighted by their angle there.
    """
    a, b, c = np.moveaxis(mesh.corners, 1, 0)
    across = np.cross(b - a, c - a)
    normal = across / np.maximum(np.linalg.norm(across, axis=1, keepdims=True), np.finfo(float).tiny)
    group = _smooth_groups(mesh.triangles, normal, crease)
    weighted = _angles(mesh.corners)[:, :, None] * normal[:, None, :]
    total = np.stack([np.bincount(group, weights=weighted[:, :, i].ravel()) for i in range(3)], axis=1)
    unit = total / np.maximum(np.linalg.norm(total, axis=1, keepdims=True), np.finfo(float).tiny)
    return np.asarray(unit[group].reshape(-1, 3, 3))


def _smooth_groups(triangles: Ints, normal: Floats, crease: float) -> Ints:
    """(3 t,) which corners share a normal."""
    from scipy.sparse import coo_array  # noqa: PLC0415  half a second that only pictures need
    from scipy.sparse.csgraph import connected_components  # noqa: PLC0415

    corner = np.arange(triangles.size).reshape(-1, 3)
    start, end = corner[:, [0, 1, 2]].ravel(), corner[:, [1, 2, 0]].ravel()
    vertex = triangles.ravel()
    swap = vertex[start] > vertex[end]
    start, end = np.where(swap, end, start), np.where(swap, start, end)
    order = np.lexsort([vertex[end], vertex[start]])
    start, end = start[order], end[order]
    same = (vertex[start][1:] == vertex[start][:-1]) & (vertex[end][1:] == vertex[end][:-1])
    face = start // 3
    smooth = (normal[face[1:]] * normal[face[:-1]]).sum(axis=1) >= np.cos(np.radians(crease))
    joined = np.flatnonzero(same & smooth)
    ones = np.concatenate([start[joined], end[joined]])
    others = np.concatenate([start[joined + 1], end[joined + 1]])
    graph = coo_array((np.ones(len(ones)), (ones, others)), shape=(triangles.size,) * 2)
    return np.asarray(connected_components(graph, directed=False)[1], dtype=np.intp)


def _angles(corners: Floats) -> Floats:
    """(t, 3) angle of each triangle at each corner."""
    to_next = np.roll(corners, -1, axis=1) - corners
    to_last = np.roll(corners, 1, axis=1) - corners
    across = np.linalg.norm(np.cross(to_next, to_last), axis=2)
    return np.asarray(np.arctan2(across, (to_next * to_last).sum(axis=2)))
