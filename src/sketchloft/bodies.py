"""Stage 1: separate bodies, by k-means (paper, sections 3.1 and 4.2)."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import Literal

import numpy as np

from sketchloft.cloud import Floats, Ints
from sketchloft.errors import StageError, UsageError
from sketchloft.neighbours import neighbour_graph

__all__ = ["BodiesParams", "parse_bodies", "separate_bodies"]

MAX_BODIES = 10
SAMPLE = 20_000
"""Points that the number of bodies is decided on; all points are then assigned."""


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
    cannot tell the number. Instead, clusters that touch are joined again, and the k whose clusters then
    make the most bodies is taken, the smallest of those that tie. Two clusters touch when points of both
    are linked: among each other's eight nearest neighbours and within twice the reach of both, or no
    further apart than five times the smaller reach, where reach is the median distance of a point's eight
    neighbours. Where linked points make still more bodies, k-means has cut across long bodies side by
    side, and the linked parts are taken.

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
        centres, _ = _k_means(sample, params.bodies, params.seed)
        return _assign(points, centres, np.arange(params.bodies))
    graph = neighbour_graph(sample)
    parts = graph.joined(np.arange(len(sample)))
    if parts.max() == 0:
        return (np.arange(len(points)),)
    anchors, body_of = sample, parts
    best = 1
    for k in range(2, MAX_BODIES + 1):
        centres, label = _k_means(sample, k, params.seed)
        bodies = graph.joined(label)
        if bodies.max() + 1 > best:
            best, anchors, body_of = int(bodies.max()) + 1, centres, bodies
    if parts.max() + 1 > best:
        anchors, body_of = sample, parts
    return _assign(points, anchors, body_of)


def _k_means(points: Floats, k: int, seed: int) -> tuple[Floats, Ints]:
    """Centres (k, 3) and the cluster of each point, the best of four starts."""
    from scipy.cluster.vq import kmeans2  # noqa: PLC0415  not needed for one body
    from scipy.spatial import cKDTree  # noqa: PLC0415

    rng = np.random.default_rng(seed)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # an empty cluster is no fault here, but a run that will not win
        runs = [kmeans2(points, k, iter=50, minit="++", missing="warn", rng=rng)[0] for _ in range(4)]
    found = [cKDTree(centres).query(points) for centres in runs]
    errors = [float(np.square(distance).sum()) for distance, _ in found]
    best = int(np.argmin(errors))
    return runs[best], np.asarray(found[best][1], dtype=np.intp)


def _assign(points: Floats, centres: Floats, body_of: Ints) -> tuple[Ints, ...]:
    """Every point to the body of its nearest centre."""
    from scipy.spatial import cKDTree  # noqa: PLC0415  as above

    body = body_of[cKDTree(centres).query(points)[1]]
    found = [np.flatnonzero(body == b) for b in range(int(body_of.max()) + 1)]
    if min(map(len, found)) == 0:
        raise StageError(
            f"only {sum(len(f) > 0 for f in found)} of {len(found)} bodies got points; ask for fewer bodies",
            stage="bodies",
        )
    return tuple(sorted(found, key=len, reverse=True))
