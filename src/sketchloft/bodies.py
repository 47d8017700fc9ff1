"""Stage 1: separate bodies, by k-means (paper, sections 3.1 and 4.2)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from sketchloft.cloud import Floats, Ints
from sketchloft.errors import StageError, UsageError

__all__ = ["BodiesParams", "parse_bodies", "separate_bodies"]

MAX_BODIES = 10
SAMPLE = 20_000
"""Points that the number of bodies is decided on; all points are then assigned."""
NEIGHBOURS = 8
REACH = 2.0
"""Two points are linked when they lie within this many times the reach of the eighth neighbour of either."""
MIN_SHARE = 0.02
"""A body with fewer than this share of the points is taken for stray points."""


@dataclass(frozen=True)
class BodiesParams:
    """How the cloud is separated into bodies.

    Parameters
    ----------
    bodies : "auto" or int
        Number of bodies, or "auto" to find it (1 to 10).
    seed : int
        Seed of the k-means starts.
    """

    bodies: Literal["auto"] | int = "auto"
    seed: int = 0


def parse_bodies(text: str) -> Literal["auto"] | int:
    """Read "auto" or a number of bodies.

    Raises
    ------
    UsageError
        If the text is neither, or the number is not 1 to 10.
    """
    if text == "auto":
        return "auto"
    if text.isdecimal() and 1 <= int(text) <= MAX_BODIES:
        return int(text)
    raise UsageError(f"bodies: found '{text}', expected auto or a number from 1 to {MAX_BODIES}")


def separate_bodies(points: Floats, params: BodiesParams) -> tuple[Ints, ...]:
    """Separate a cloud into bodies.

    k-means runs for k = 1..10, as in the paper. Its error always falls with k, so the least error
    cannot tell the number. Instead, clusters that touch are joined again: two clusters touch when a
    point of one and a point of the other are among each other's eight nearest neighbours and within
    twice the reach that both have among their own. What stays apart are bodies, and the k whose
    clusters fall into the most bodies is taken, the smallest k of those that tie.

    Parameters
    ----------
    points : (n, 3) float array
        In canonical order.
    params : BodiesParams

    Returns
    -------
    tuple of (m,) int arrays
        Indices of the points of each body, the largest body first.

    Raises
    ------
    StageError
        If a number of bodies is asked for that k-means cannot fill.
    """
    if params.bodies == 1:
        return (np.arange(len(points)),)
    # Canonical order is by distance from the centre: every k-th point is an even sample of it.
    sample = points[:: -(-len(points) // SAMPLE)]
    if params.bodies != "auto":
        centres, label = _k_means(sample, params.bodies, params.seed)
        return _assign(points, centres, np.arange(params.bodies))
    links = _links(sample)
    best: tuple[int, Floats, Ints] = (1, sample.mean(axis=0)[None], np.zeros(1, dtype=np.intp))
    if _groups(links, np.arange(len(sample)))[0] > 1:
        for k in range(2, MAX_BODIES + 1):
            centres, label = _k_means(sample, k, params.seed)
            bodies, body_of = _joined(label, links)
            if bodies > best[0]:
                best = bodies, centres, body_of
    return _assign(points, best[1], best[2])


def _k_means(points: Floats, k: int, seed: int) -> tuple[Floats, Ints]:
    """Best of four starts; centres that lost all their points are dropped."""
    from scipy.cluster.vq import kmeans2  # noqa: PLC0415  not needed for one body
    from scipy.spatial import cKDTree  # noqa: PLC0415

    rng = np.random.default_rng(seed)
    runs = [kmeans2(points, k, iter=50, minit="++", missing="warn", rng=rng)[0] for _ in range(4)]
    found = [cKDTree(centres).query(points) for centres in runs]
    errors = [float(np.square(distance).sum()) for distance, _ in found]
    best = int(np.argmin(errors))
    return runs[best], np.asarray(found[best][1], dtype=np.intp)


def _links(points: Floats) -> Ints:
    """(m, 2) pairs of points that are neighbours of each other."""
    from scipy.spatial import cKDTree  # noqa: PLC0415  as above

    k = min(NEIGHBOURS, len(points) - 1)
    distance, other = map(np.asarray, cKDTree(points).query(points, k + 1))
    reach = np.median(distance[:, 1:], axis=1)
    first = np.repeat(np.arange(len(points)), k)
    second, length = other[:, 1:].ravel(), distance[:, 1:].ravel()
    near = length <= REACH * np.minimum(reach[first], reach[second])
    return np.stack([first[near], second[near]], axis=1).astype(np.intp)


def _groups(links: Ints, label: Ints) -> tuple[int, Ints]:
    """Connected components of labels joined by links."""
    from scipy.sparse import coo_array  # noqa: PLC0415  as above
    from scipy.sparse.csgraph import connected_components  # noqa: PLC0415

    size = int(label.max()) + 1
    pairs = label[links]
    graph = coo_array((np.ones(len(pairs), dtype=np.int8), (pairs[:, 0], pairs[:, 1])), shape=(size, size))
    count, group = connected_components(graph, directed=False)
    return int(count), group.astype(np.intp)


def _joined(label: Ints, links: Ints) -> tuple[int, Ints]:
    """Join clusters that touch; groups too small for a body go to the largest one."""
    _, group = _groups(links, label)
    share = np.bincount(group[label]) / len(label)
    body = np.flatnonzero(share >= MIN_SHARE)
    number = np.full(len(share), int(np.argmax(share[body])))
    number[body] = np.arange(len(body))
    return len(body), number[group]


def _assign(points: Floats, centres: Floats, body_of: Ints) -> tuple[Ints, ...]:
    """Every point to the body of its nearest centre."""
    from scipy.spatial import cKDTree  # noqa: PLC0415  as above

    if body_of.max() == 0:
        return (np.arange(len(points)),)
    body = body_of[cKDTree(centres).query(points)[1]]
    found = [np.flatnonzero(body == b) for b in range(int(body.max()) + 1)]
    if min(map(len, found)) == 0:
        raise StageError(
            f"only {sum(len(f) > 0 for f in found)} of {len(found)} bodies got points; ask for fewer bodies",
            stage="bodies",
        )
    return tuple(sorted(found, key=len, reverse=True))
