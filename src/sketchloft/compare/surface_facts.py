"""Surface facts: whether a mesh is closed, whether it is a manifold, and of how many pieces it is."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from sketchloft.cloud import Ints

__all__ = ["SurfaceFacts", "surface_facts"]


@dataclass(frozen=True)
class SurfaceFacts:
    """What kind of surface a mesh is.

    Parameters
    ----------
    closed : bool
        Every edge is run as often one way as the other.
    manifold : bool
        Closed, every edge has two triangles, and around every vertex they are one fan.
    shells : int
        Number of pieces that share no edge: one for a solid, one more for each cavity in it.
    """

    closed: bool
    manifold: bool
    shells: int


def surface_facts(triangles: Ints) -> SurfaceFacts:
    """Look at how the triangles hang together.

    Parameters
    ----------
    triangles : (t, 3) int array
        At least one; neighbours share their vertices, as in `Mesh`.
    """
    from scipy.sparse import coo_array  # noqa: PLC0415  half a second that --help need not pay
    from scipy.sparse.csgraph import connected_components  # noqa: PLC0415

    start, end = triangles.ravel(), np.roll(triangles, -1, axis=1).ravel()
    key = np.minimum(start, end) * (int(triangles.max()) + 1) + np.maximum(start, end)
    _, edge, uses = np.unique(key, return_inverse=True, return_counts=True)
    closed = not np.bincount(edge, weights=np.where(start < end, 1.0, -1.0)).any()
    # Half-edges of one edge, one beside the next.
    order = np.argsort(edge, kind="stable")
    same = edge[order[1:]] == edge[order[:-1]]
    one, other = order[:-1][same], order[1:][same]

    def pieces(first: Ints, second: Ints, count: int) -> int:
        links = coo_array((np.ones(len(first), dtype=np.int8), (first, second)), shape=(count, count))
        return int(connected_components(links, directed=False)[0])

    shells = pieces(one // 3, other // 3, len(triangles))
    if not closed or uses.max() > 2:
        return SurfaceFacts(closed, False, shells)
    # Corner k of the flattened triangles is where half-edge k starts; the two half-edges of an edge
    # run opposite ways, so each starts where the other ends.
    after = np.arange(len(start)).reshape(-1, 3)[:, [1, 2, 0]].ravel()
    fans = pieces(np.concatenate([one, after[one]]), np.concatenate([after[other], other]), len(start))
    return SurfaceFacts(True, fans == len(np.unique(triangles)), shells)
