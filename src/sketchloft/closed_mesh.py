"""Closed mesh: a mesh whose triangles share corners, leave no hole and face outwards."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats, Ints
from sketchloft.errors import ModelError
from sketchloft.mesh import Mesh

__all__ = ["WELD", "closed_mesh", "welded"]

WELD = 1e-6
"""Vertices closer than this, in diagonals of the mesh, are one."""


def closed_mesh(mesh: Mesh, name: str) -> Mesh:
    """Weld a mesh, turn its triangles outwards, and refuse it if it is not closed.

    Parameters
    ----------
    mesh : Mesh
        Each triangle may bring its own corners, as in an STL file.
    name : str
        What the message calls it ("model", "goal").

    Returns
    -------
    Mesh
        The same surface; every edge is run as often one way as the other.

    Raises
    ------
    ModelError
        If the mesh has no triangle, is not finite, has a hole, or encloses no volume.
    """
    if len(mesh.triangles) == 0 or not np.isfinite(mesh.corners).all():
        what = "no triangle" if len(mesh.triangles) == 0 else "coordinates that are not finite"
        raise ModelError(f"{name}: found {what}, expected a closed mesh; export it again")
    mesh = welded(mesh)
    a, b, c = mesh.triangles.T
    mesh = Mesh(mesh.vertices, mesh.triangles[(a != b) & (b != c) & (c != a)])
    n_open, n_edges = _open_edges(mesh.triangles)
    if n_open:
        raise ModelError(
            f"{name}: its mesh is not closed, {n_open} of {n_edges} edges lack a neighbour that faces the "
            "same way; inside and outside need a closed surface, so fill its holes or export a solid"
        )
    volume = mesh.volume
    if abs(volume) < 1e-12 * mesh.size**3:
        raise ModelError(f"{name}: its mesh encloses no volume, expected a solid; export it again")
    return mesh if volume > 0 else Mesh(mesh.vertices, mesh.triangles[:, ::-1])


def welded(mesh: Mesh, tolerance: float = WELD) -> Mesh:
    """Make vertices within `tolerance` diagonals one, drop unused ones; triangles stay in their rows."""
    used, index = np.unique(mesh.triangles, return_inverse=True)
    vertices, same = np.unique(mesh.vertices[used], axis=0, return_inverse=True)
    size = float(np.linalg.norm(np.ptp(vertices, axis=0)))
    vertices, near = _merged(vertices, tolerance * size)
    return Mesh(vertices, near[same.reshape(-1)[index.reshape(-1, 3)]])


def _merged(vertices: Floats, distance: float) -> tuple[Floats, Ints]:
    """Keep the first of each group of near vertices, and say which one stands for each."""
    from scipy.sparse import coo_array  # noqa: PLC0415  half a second that --help need not pay
    from scipy.sparse.csgraph import connected_components  # noqa: PLC0415
    from scipy.spatial import cKDTree  # noqa: PLC0415

    pairs = cKDTree(vertices).query_pairs(distance, output_type="ndarray")
    graph = coo_array((np.ones(len(pairs)), pairs.T), shape=(len(vertices),) * 2)
    _, group = connected_components(graph, directed=False)
    _, first, index = np.unique(group, return_index=True, return_inverse=True)
    return vertices[first], index


def _open_edges(triangles: Ints) -> tuple[int, int]:
    """How many edges are not run equally often both ways, and how many edges there are."""
    ends = triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
    low, high = ends.min(axis=1), ends.max(axis=1)
    _, edge = np.unique(low * (triangles.max() + 1) + high, return_inverse=True)
    balance = np.bincount(edge, weights=np.where(ends[:, 0] < ends[:, 1], 1.0, -1.0))
    return int(np.count_nonzero(balance)), len(balance)
