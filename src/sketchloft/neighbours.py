"""Which points of a cloud hang together: links between near neighbours, and parts joined by them."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

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
CHANCE = 7.0
"""Points, of those that do not go together, that are missing by chance once in exp(7) times."""
STRAY = 3.0
"""Points that reach more than this many times as far as the median point are strays and join nothing."""
PIECE = 0.002
"""Share of the points that a piece has at least that may bridge a gap."""
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
    """

    points: Floats
    reach: Floats
    links: Ints

    @cached_property
    def together(self) -> float:
        """How many of the points go together, as those of a stroke do."""
        return dispersion(self.points / middle_and_size(self.points)[1])

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
        """Part of each large group, where groups with hardly a gap between them are one.

        Small ones may bridge the gap: of a thin place in a drawing only pieces may be left.
        """
        core = self.reach <= STRAY * np.median(self.reach)
        size = np.bincount(group[core], minlength=int(group.max()) + 1)
        small = np.setdiff1d(np.flatnonzero(size >= PIECE * len(group)), large)
        members = [np.flatnonzero(core & (group == one)) for one in (*large, *small)]
        close = [
            pair for pair in itertools.combinations(range(len(members)), 2) if self._touch(members, pair)
        ]
        part = _connected(np.array(close, dtype=np.intp).reshape(-1, 2), np.arange(len(members)))
        joined = [
            np.concatenate([m for m, p in zip(members, part, strict=True) if p == one])
            for one in range(int(part.max()) + 1)
        ]
        pairs = itertools.combinations(np.unique(part[: len(large)]).tolist(), 2)
        near = [pair for pair in pairs if self._by_chance(joined, pair)]
        return _connected(np.array(near, dtype=np.intp).reshape(-1, 2), np.arange(len(joined)))[
            part[: len(large)]
        ]

    def _gap(self, members: Sequence[Ints], pair: tuple[int, int]) -> tuple[Floats, Ints]:
        """Distance of each point of the second of two groups from the first, and the point there."""
        from scipy.spatial import cKDTree  # noqa: PLC0415  only where there is a gap to measure

        first, second = (members[i] for i in pair)
        distance, nearest = cKDTree(self.points[first]).query(self.points[second])
        return np.asarray(distance), first[nearest]

    def _touch(self, members: Sequence[Ints], pair: tuple[int, int]) -> bool:
        distance, nearest = self._gap(members, pair)
        reach = np.minimum(self.reach[nearest], self.reach[members[pair[1]]])
        return bool((distance <= APART * np.cbrt(self.together) * reach).any())

    def _by_chance(self, members: Sequence[Ints], pair: tuple[int, int]) -> bool:
        """Whether a part that went on from one to the other could have no points there but by chance.

        As many are to be expected in the gap as lie in a slab of its width behind either of its ends.
        """
        distance, nearest = self._gap(members, pair)
        k = int(np.argmin(distance))
        first, second = (self.points[members[i]] for i in pair)
        start, end = self.points[nearest[k]], self.points[members[pair[1]][k]]
        square = float((end - start) @ (end - start))
        behind, beyond = (first - start) @ (start - end), (second - end) @ (end - start)
        fewest = min(((away >= 0) & (away < square)).sum() for away in (behind, beyond))
        return bool(fewest < CHANCE * self.together)


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
    return NeighbourGraph(points, reach, links)


def _connected(links: Ints, label: Ints) -> Ints:
    """(k,) component of each label, when the labels at both ends of a link are joined."""
    from scipy.sparse import coo_array  # noqa: PLC0415  as above
    from scipy.sparse.csgraph import connected_components  # noqa: PLC0415

    size = int(label.max()) + 1
    pairs = label[links]
    graph = coo_array((np.ones(len(pairs), dtype=np.int8), (pairs[:, 0], pairs[:, 1])), shape=(size, size))
    return connected_components(graph, directed=False)[1].astype(np.intp)
