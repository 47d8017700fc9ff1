"""Which points of a cloud hang together: links between near neighbours, and parts joined by them."""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np

from sketchloft.cloud import Floats, Ints
from sketchloft.dispersion import dispersion
from sketchloft.robust_size import middle_and_size

__all__ = ["NeighbourGraph", "neighbour_graph"]

NEIGHBOURS = 8
REACH = 2.0
"""Neighbours are linked when they lie within this many times the reach of both."""
APART = 5.0
"""Parts closer than this many times the smaller reach are one, with a thin place in the drawing; farther
by the third root of how many points go together, as those of a stroke do: strokes leave wider gaps."""
STRAY = 3.0
"""Points that reach more than this many times as far as the median point are strays and join nothing."""
MIN_SHARE = 0.02
"""A part with fewer than this share of the points is taken for stray points."""


@dataclass(frozen=True)
class NeighbourGraph:
    """Links between near neighbours.

    Parameters
    ----------
    points : (n, 3) float array
    reach : (n,) float array
        Median distance of each point's eight nearest neighbours.
    links : (m, 2) int array
        Pairs of points.
    apart : float
        Parts closer than this many times the smaller reach are one.
    """

    points: Floats
    reach: Floats
    links: Ints
    apart: float

    def joined(self, label: Ints) -> Ints:
        """Join the labels that hang together.

        Parameters
        ----------
        label : (n,) int array
            Label of every point, 0..k-1.

        Returns
        -------
        (k,) int array
            Part of each label, 0 for the largest. Parts too small to be a body count as the largest.
        """
        group = _connected(self.links, label)
        share = np.bincount(group[label]) / len(label)
        large = np.flatnonzero(share >= MIN_SHARE)
        if len(large) < 2:
            return np.zeros(len(group), dtype=np.intp)
        part_of = self._without_thin_places(group[label], large)
        size = np.bincount(part_of, weights=share[large])
        rank = np.empty(len(size), dtype=np.intp)
        rank[np.argsort(-size, kind="stable")] = np.arange(len(size))
        part = np.zeros(len(share), dtype=np.intp)
        part[large] = rank[part_of]
        return part[group]

    def _without_thin_places(self, group: Ints, large: Ints) -> Ints:
        """Part of each large group, where groups with hardly a gap between them are one."""
        from scipy.spatial import cKDTree  # noqa: PLC0415  only where there is a gap to measure

        core = self.reach <= STRAY * np.median(self.reach)
        members = [np.flatnonzero(core & (group == one)) for one in large]
        close = []
        for i, j in itertools.combinations(range(len(large)), 2):
            a, b = members[i], members[j]
            distance, nearest = map(np.asarray, cKDTree(self.points[a]).query(self.points[b]))
            if (distance <= self.apart * np.minimum(self.reach[a][nearest], self.reach[b])).any():
                close.append((i, j))
        return _connected(np.array(close, dtype=np.intp).reshape(-1, 2), np.arange(len(large)))


def neighbour_graph(points: Floats) -> NeighbourGraph:
    """Link the points that are among each other's near neighbours.

    Parameters
    ----------
    points : (n, 3) float array

    Returns
    -------
    NeighbourGraph
    """
    from scipy.spatial import cKDTree  # noqa: PLC0415  half a second that --help need not pay

    k = min(NEIGHBOURS, len(points) - 1)
    distance, other = map(np.asarray, cKDTree(points).query(points, k + 1))
    reach = np.median(distance[:, 1:], axis=1)
    first = np.repeat(np.arange(len(points)), k)
    second, length = other[:, 1:].ravel(), distance[:, 1:].ravel()
    near = length <= REACH * np.minimum(reach[first], reach[second])
    links = np.stack([first[near], second[near]], axis=1).astype(np.intp)
    together = dispersion(points / middle_and_size(points)[1])
    return NeighbourGraph(points, reach, links, APART * float(np.cbrt(together)))


def _connected(links: Ints, label: Ints) -> Ints:
    """(k,) component of each label, when the labels at both ends of a link are joined."""
    from scipy.sparse import coo_array  # noqa: PLC0415  as above
    from scipy.sparse.csgraph import connected_components  # noqa: PLC0415

    size = int(label.max()) + 1
    pairs = label[links]
    graph = coo_array((np.ones(len(pairs), dtype=np.int8), (pairs[:, 0], pairs[:, 1])), shape=(size, size))
    return connected_components(graph, directed=False)[1].astype(np.intp)
