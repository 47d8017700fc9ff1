"""Meshes of known shape for the tests."""

from __future__ import annotations

import numpy as np

from sketchloft.mesh import Mesh

__all__ = ["block", "soup", "sphere"]

OCTAHEDRON = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]]
BOX = [
    [0, 2, 1], [0, 3, 2], [4, 5, 6], [4, 6, 7], [0, 1, 5], [0, 5, 4],
    [1, 2, 6], [1, 6, 5], [2, 3, 7], [2, 7, 6], [3, 0, 4], [3, 4, 7],
]  # fmt: skip


def sphere(radius: float = 1.0, centre: tuple[float, float, float] = (0, 0, 0), level: int = 5) -> Mesh:
    """An octahedron, its triangles cut into four `level` times and blown up."""
    vertices = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]], dtype=float)
    triangles = np.array(OCTAHEDRON)
    for _ in range(level):
        ends = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
        edges, edge = np.unique(ends, axis=0, return_inverse=True)
        ab, bc, ca = (edge.reshape(-1, 3) + len(vertices)).T
        a, b, c = triangles.T
        vertices = np.concatenate([vertices, vertices[edges].sum(axis=1)])
        vertices /= np.linalg.norm(vertices, axis=1, keepdims=True)
        corners = [(a, ab, ca), (ab, b, bc), (bc, c, ca), (ab, bc, ca)]
        triangles = np.concatenate([np.stack(three, axis=1) for three in corners])
    return Mesh(radius * vertices + centre, triangles)


def block(x: float, y: float, z: float, shift: tuple[float, float, float] = (0, 0, 0)) -> Mesh:
    """A box with one corner at `shift`."""
    corners = [[0, 0, 0], [x, 0, 0], [x, y, 0], [0, y, 0], [0, 0, z], [x, 0, z], [x, y, z], [0, y, z]]
    return Mesh(np.array(corners, dtype=float) + shift, np.array(BOX))


def soup(mesh: Mesh) -> Mesh:
    """The same surface, each triangle with its own corners, as in an STL file."""
    return Mesh(mesh.corners.reshape(-1, 3), np.arange(3 * len(mesh.triangles)).reshape(-1, 3))
