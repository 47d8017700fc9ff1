"""Alpha shapes of point sets in the plane and in space: what a probe ball of a given radius touches.

The geometry that the slice planes (paper, section 4.4), the edge points (4.6) and the comparison
(5.3) share.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from sketchloft.cloud import Floats, Ints

__all__ = ["AlphaComplex", "alpha_complex", "boundary_facets", "circumradii", "components"]

FLAT = 1e-4
"""Simplices below this share of the mean volume are flat: rounding, to single precision, decides on them."""


@dataclass(frozen=True)
class AlphaComplex:
    """Delaunay simplices of a point set, each with the radius of its empty circumscribed ball.

    The alpha shape for a probe radius keeps the simplices whose radius is not larger; what it
    encloses is all that the probe cannot reach.

    Parameters
    ----------
    points : (n, d) float array
        d = 2 or 3.
    simplices : (s, d + 1) int array
        Positively oriented.
    neighbours : (s, d + 1) int array
        Simplex opposite each corner, -1 outside the hull.
    radii : (s,) float array
        Circumradius of each simplex.
    volumes : (s,) float array
        Area (d = 2) or volume (d = 3) of each simplex.
    """

    points: Floats
    simplices: Ints
    neighbours: Ints
    radii: Floats
    volumes: Floats

    def inside(self, probe_radius: float) -> Ints:
        """Return the indices of the simplices that a probe of this radius cannot enter."""
        return _with_flat(self, np.flatnonzero(self.radii <= probe_radius))


def alpha_complex(points: Floats) -> AlphaComplex:
    """Triangulate the points and measure every simplex.

    Parameters
    ----------
    points : (n, d) float array
        At least d + 1 points that are not all on one line (d = 2) or plane (d = 3).

    Returns
    -------
    AlphaComplex

    Raises
    ------
    scipy.spatial.QhullError
        If the points do not span d dimensions.

    References
    ----------
    H. Edelsbrunner, E. P. Mücke, Three-dimensional alpha shapes, ACM Transactions on Graphics
    13(1), 1994; the paper, section 3.2.
    """
    from scipy.spatial import Delaunay  # noqa: PLC0415  half a second that --help need not pay

    # Points on one sphere make one huge facet, which takes Qhull minutes; joggled by rounding they do not.
    triangulation = Delaunay(points, qhull_options="QJ Pp" if points.shape[1] == 3 else None)
    simplices = triangulation.simplices.astype(np.intp)
    neighbours = triangulation.neighbors.astype(np.intp)
    corners = points[simplices]
    volumes = _volumes(corners)
    negative = volumes < 0
    # Swapping two corners turns a simplex round; its neighbours are swapped along with them.
    for array in (simplices, neighbours):
        array[negative, :2] = array[negative, 1::-1]
    return AlphaComplex(points, simplices, neighbours, circumradii(corners), np.abs(volumes))


def circumradii(corners: Floats) -> Floats:
    """Radius of the ball through the corners of each simplex.

    Parameters
    ----------
    corners : (s, d + 1, d) float array

    Returns
    -------
    (s,) float array
        Infinite where the corners are on one line or plane.
    """
    edges = corners[:, 1:] - corners[:, :1]
    squares = np.einsum("sij,sij->si", edges, edges)
    determinant = np.linalg.det(edges)
    scale = squares.max(axis=1) ** (edges.shape[1] / 2)
    flat = np.abs(determinant) <= 1e-14 * scale
    edges[flat] = np.eye(edges.shape[1])
    centre = np.linalg.solve(edges, squares[..., None] / 2)[..., 0]
    return np.where(flat, np.inf, np.linalg.norm(centre, axis=1))


def boundary_facets(shape: AlphaComplex, kept: Ints) -> Ints:
    """Facets between a kept simplex and one that is not kept.

    Parameters
    ----------
    shape : AlphaComplex
    kept : (k,) int array
        Indices of the kept simplices.

    Returns
    -------
    (f, d) int array
        Corner points of each facet, oriented so that its normal points out of the kept side.
    """
    is_kept = np.zeros(len(shape.simplices) + 1, dtype=bool)
    is_kept[kept] = True  # the extra last entry stands for "-1, outside the hull"
    rows, opposite = np.nonzero(~is_kept[shape.neighbours[kept]])
    corners = np.arange(shape.points.shape[1] + 1)
    facet_of = np.array([_opposite(corners, k) for k in corners])
    return shape.simplices[kept[rows][:, None], facet_of[opposite]]


def components(shape: AlphaComplex, kept: Ints) -> Ints:
    """Label the connected components (through facets) of the kept simplices.

    Returns
    -------
    (k,) int array
        Component of each entry of `kept`, numbered by falling volume.
    """
    from scipy.sparse import coo_array  # noqa: PLC0415  as above
    from scipy.sparse.csgraph import connected_components  # noqa: PLC0415

    position = np.full(len(shape.simplices) + 1, -1, dtype=np.intp)
    position[kept] = np.arange(len(kept))
    other = position[shape.neighbours[kept]]
    rows, columns = np.nonzero(other >= 0)
    links = (np.ones(len(rows), dtype=np.int8), (rows, other[rows, columns]))
    count, label = connected_components(coo_array(links, shape=(len(kept), len(kept))), directed=False)
    volume = np.bincount(label, weights=shape.volumes[kept], minlength=count)
    rank = np.empty(count, dtype=np.intp)
    rank[np.argsort(-volume, kind="stable")] = np.arange(count)
    return rank[label]


def _volumes(corners: Floats) -> Floats:
    edges = corners[:, 1:] - corners[:, :1]
    dimension = edges.shape[1]
    return np.linalg.det(edges) / (2 if dimension == 2 else 6)


def _opposite(corners: Ints, k: int) -> Ints:
    """Facet opposite corner k, turned so that it looks outwards."""
    facet = np.delete(corners, k)
    return facet if k % 2 == 0 else np.r_[facet[1], facet[0], facet[2:]]


def _with_flat(shape: AlphaComplex, kept: Ints) -> Ints:
    """Keep flat simplices that kept ones enclose, and no others.

    Eight points of a regular grid lie on one ball; cut into simplices, some are flat. Their own radius
    says nothing, they lie on the ball of their neighbours. Left out inside they would be slits; kept at
    the surface their sides would be arbitrary.
    """
    flat = np.append(shape.volumes <= FLAT * shape.volumes.mean(), False)
    if not flat.any():
        return kept
    is_kept = flat.copy()  # the extra last entry stands for "-1, outside the hull"
    is_kept[kept] = True
    exposed = np.flatnonzero(flat)
    while len(exposed):
        exposed = exposed[is_kept[exposed]]
        exposed = exposed[~is_kept[shape.neighbours[exposed]].all(axis=1)]
        is_kept[exposed] = False
        exposed = np.unique(shape.neighbours[exposed])
        exposed = exposed[flat[exposed]]
    return np.flatnonzero(is_kept)
