"""Outer piece: the largest closed piece of a mesh whose triangles may face either way."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats, Ints
from sketchloft.mesh import Mesh

__all__ = ["outer_piece"]


def outer_piece(mesh: Mesh) -> Mesh:
    """Leave cavities and islands away, and turn what is left outwards.

    Parameters
    ----------
    mesh : Mesh
        The boundary of some solids. They may touch along edges, and triangles may face inwards.

    Returns
    -------
    Mesh
        The triangles that hang together by edges and enclose the most; every edge is run as often one way
        as the other.

    Notes
    -----
    Around an edge, solid and void take turns, so triangles that follow each other around it run it in
    opposite directions. Each triangle is taken twice, as it is and turned over, and linked with that
    one of its neighbour's two sides which agrees: the connected components are then the pieces, each once
    facing outwards and once inwards.
    """
    from scipy.sparse import coo_array  # noqa: PLC0415
    from scipy.sparse.csgraph import connected_components  # noqa: PLC0415

    sides = np.concatenate([mesh.triangles, mesh.triangles[:, ::-1]])
    one, other = _links(mesh)
    graph = coo_array((np.ones(len(one), dtype=np.int8), (one, other)), shape=(len(sides), len(sides)))
    _, piece = connected_components(graph, directed=False)
    a, b, c = np.moveaxis(mesh.vertices[sides] - mesh.vertices.mean(axis=0), 1, 0)
    volume = np.bincount(piece, np.einsum("ij,ij->i", a, np.cross(b, c)))
    return Mesh(mesh.vertices, sides[piece == volume.argmax()])


def _links(mesh: Mesh) -> tuple[Ints, Ints]:
    """Pairs of sides that agree; those that are turned over come after those as they are."""
    count = len(mesh.triangles)
    start, end, apex = (np.roll(mesh.triangles, -shift, axis=1).ravel() for shift in range(3))
    low, high = np.minimum(start, end), np.maximum(start, end)
    order = np.lexsort((_angle_around(mesh.vertices, low, high, apex), high, low))
    together = (low[order[1:]] == low[order[:-1]]) & (high[order[1:]] == high[order[:-1]])
    one, other = order[:-1][together], order[1:][together]
    same_way = (start[one] < end[one]) == (start[other] < end[other])
    one, other = one // 3, other // 3
    turned = np.where(same_way, count, 0)
    return np.concatenate([one, one + count]), np.concatenate([other + turned, other + count - turned])


def _angle_around(vertices: Floats, low: Ints, high: Ints, apex: Ints) -> Floats:
    """Angle of the apex around the edge from low to high, from a direction that the edge alone determines."""
    along, to_apex = vertices[high] - vertices[low], vertices[apex] - vertices[low]
    aside = np.eye(3)[np.abs(along).argmin(axis=1)]
    x = np.cross(along, aside)
    # Marching cubes leave edges of no length; a triangle at one has no other that it could be confused with.
    length = np.maximum(np.linalg.norm(along, axis=1, keepdims=True), np.finfo(float).tiny)
    y = np.cross(along, x) / length
    return np.arctan2(np.einsum("ij,ij->i", to_apex, y), np.einsum("ij,ij->i", to_apex, x))
