"""Boundary of an octree: the way to the surface that the paper tried and dropped (section 4)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from sketchloft.cloud import Ints
from sketchloft.compare.octree import Octree
from sketchloft.mesh import Mesh

__all__ = ["boundary_cells", "octree_boundary"]

FACES = np.array(
    [
        [[1, 0, 0], [1, 1, 0], [1, 1, 1], [1, 0, 1]],
        [[0, 0, 0], [0, 0, 1], [0, 1, 1], [0, 1, 0]],
        [[0, 1, 0], [0, 1, 1], [1, 1, 1], [1, 1, 0]],
        [[0, 0, 0], [1, 0, 0], [1, 0, 1], [0, 0, 1]],
        [[0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]],
        [[0, 0, 0], [0, 1, 0], [1, 1, 0], [1, 0, 0]],
    ]
)
"""Corners of a cube's faces, counter-clockwise from outside: +x, -x, +y, -y, +z, -z."""


def boundary_cells(octree: Octree) -> NDArray[np.bool_]:
    """(k,) whether each full cube has a void neighbour at one of its faces (paper, section 4)."""
    return np.any(_at_void(octree), axis=0)


def octree_boundary(octree: Octree) -> Mesh:
    """Faces between full and void cubes, each as two triangles, the normals towards the void.

    Parameters
    ----------
    octree : Octree

    Returns
    -------
    Mesh
        Closed, though cubes that share only an edge or a corner make it no manifold. It encloses the
        full cubes. Voids inside are part of it, which is why the paper dropped it.
    """
    corners = np.concatenate(
        [octree.cells[open_][:, None] + face for face, open_ in zip(FACES, _at_void(octree), strict=True)]
    )
    width = 2**octree.depth + 1
    used, quads = np.unique(_keys(corners.reshape(-1, 3), width), return_inverse=True)
    lattice = np.stack([used // width**2, used // width % width, used % width], axis=1)
    return Mesh(
        octree.origin + octree.edge * lattice,
        quads.reshape(-1, 4)[:, [[0, 1, 2], [0, 2, 3]]].reshape(-1, 3),
    )


def _at_void(octree: Octree) -> list[NDArray[np.bool_]]:
    """For each of the six `FACES`, which cubes (k,) have a void neighbour there."""
    width = 2**octree.depth + 2  # a margin, so that the keys of neighbours beyond the edge are free
    key = _keys(octree.cells + 1, width)
    full = np.sort(key)
    steps = [sign * width ** (2 - axis) for axis in range(3) for sign in (1, -1)]
    return [full[np.searchsorted(full, key + step).clip(max=len(full) - 1)] != key + step for step in steps]


def _keys(cells: Ints, width: int) -> Ints:
    return np.asarray((cells[:, 0] * width + cells[:, 1]) * width + cells[:, 2])
