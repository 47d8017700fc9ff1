"""Stray strokes: rows of points beside the walls that are likelier an accident than part of the thing."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from sketchloft.cloud import Floats, Ints
from sketchloft.exact.changes.free_trial import ENOUGH
from sketchloft.exact.changes.worth import worth
from sketchloft.exact.fit.climb import climbed, promise
from sketchloft.exact.fit.fit_density import fit_density
from sketchloft.exact.fit.likelihood import beside_walls, evaluate, losses, scores
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.exact.model.joins import joined
from sketchloft.exact.model.soundness import sound
from sketchloft.workers import ALONE, Workers

if TYPE_CHECKING:
    from scipy.sparse import csr_array

__all__ = ["Strays", "counted", "stray_strokes"]

Bools = NDArray[np.bool_]

ODDS = 10.0
"""Log odds against a stroke to be a stray one, of so many that lie beside the walls by chance."""
PULLS = 7.0
"""The same for the few that pull at sharp walls the most."""
BESIDE = 3.0
"""Noise deviations from the walls from which on a stroke may be one."""
NEAR = 8.0
"""The same within which the walls are fitted."""
LINK = 2.5
"""Distances to the nearest neighbour, in the median, by which points of a stroke are apart at most."""
ROW = 0.7
"""Share of the tree that spans a stroke's points which its longest way has at least."""
SUSPECTS = 5
"""Strokes that are tried in a round."""
COST = 2.0
"""What their points cost at least beside ones inside."""
MOST = 0.03
"""Share of the points in stray strokes at most."""
STEPS = (4, 26)
LEAST = 1e-6
"""Information about a parameter at least, in shares of the mean."""


@dataclass(frozen=True)
class Strays:
    """Points that are left out, and the model without them.

    Parameters
    ----------
    kept : (n,) bool array
    model : ExactModel
    worth : float
        What the points left out add to what the model is worth by the others, their odds taken off.
    """

    kept: Bools
    model: ExactModel
    worth: float

    def among(self, points: Floats, sample: Floats) -> Bools:
        """(n,) which of all points (n, 3) are kept: those whose next one in a sample (m, 3) is."""
        if self.kept.all():
            return np.ones(len(points), dtype=bool)
        from scipy.spatial import cKDTree  # noqa: PLC0415

        return np.asarray(self.kept[cKDTree(sample).query(points)[1]])


def counted(model: ExactModel, points: int) -> ExactModel:
    """Return the model with so many points more among its strays."""
    return replace(model, stray=model.stray + points / model.space)


def stray_strokes(
    points: Floats, model: ExactModel, together: float, workers: Workers = ALONE, *, sharp: bool = False
) -> Strays:
    """Leave out strokes, one at a time, as long as the model of the others gains more than the odds.

    Parameters
    ----------
    points : (n, 3) float array
    model : ExactModel
        Fitted.
    together : float
        How many of the points go together; where it is one there are no strokes.
    workers : Workers, optional
    sharp : bool
        Whether the noise is that of the points, so that walls have bent as far as they will: then those that
        pull at them are looked at, not those that cost most.

    Notes
    -----
    A stray point is one of a few that lie anywhere, but those of a stray stroke come together, and a small
    part of the thing that it lies beside bends to it. So a stroke is judged by what the model gains that is
    fitted without it (a deletion diagnostic), not by how far it is from the walls.

    References
    ----------
    R. D. Cook, Detection of influential observation in linear regression, Technometrics 19 (1977) 15-18.
    """
    kept, left, odds = np.ones(len(points), dtype=bool), model, 0.0
    against = PULLS if sharp else ODDS
    while together > 1 and sound(left) and (~kept).mean() < MOST:
        inner = np.flatnonzero(kept)
        some = points[inner]
        parts = [(some, left, row, together) for row in _suspects(some, left, together, sharp=sharp)]
        tried = workers.each(_without, parts)
        least = worth(some, fit_density(some, left, 1), together, len(some)) + against
        value, model, row = max(tried, key=lambda trial: trial[0], default=(-np.inf, left, inner))
        if value <= least:
            break
        kept[inner[row]], left, odds = False, model, odds + against
    away = points[~kept]
    return Strays(kept, left, float(np.log(left.density.at(away)).sum()) / together - odds)


def _without(points: Floats, model: ExactModel, row: Ints, together: float) -> tuple[float, ExactModel, Ints]:
    """What the model without some of the points is worth, those being as well off as any inside; and it.

    A few steps are enough for nearly all; a wall that has bent far to the points has far to go back.
    """
    others = np.delete(points, row, axis=0)
    near = others[beside_walls(others, model, NEAR * model.sigma)]
    now, enough = evaluate(near, joined(fit_density(others, model, 1))), ENOUGH * together
    for steps in STEPS:
        now, _ = climbed(now, steps, enough=enough)
        if promise(now, range(len(now.model.stack.runs))) < enough:
            break
    after = fit_density(others, now.model, 1)
    gone = float(np.log(after.density.at(points[row])).sum()) / together
    return worth(others, after, together, len(points)) + gone, after, row


def _suspects(points: Floats, model: ExactModel, together: float, *, sharp: bool) -> list[Ints]:
    """Rows of points beside the walls, those that cost or pull most."""
    from scipy.sparse import coo_array  # noqa: PLC0415
    from scipy.sparse.csgraph import connected_components  # noqa: PLC0415
    from scipy.spatial import cKDTree  # noqa: PLC0415

    next_one, _ = cKDTree(points).query(points, [2])
    apart = LINK * float(np.median(next_one))
    near = np.flatnonzero(beside_walls(points, model, BESIDE * model.sigma))
    pairs = cKDTree(points[near]).query_pairs(apart, output_type="ndarray")
    start, end = points[near[pairs]].transpose(1, 0, 2)
    lengths = np.linalg.norm(end - start, axis=1)
    links = coo_array((lengths, pairs.T), shape=(len(near), len(near))).tocsr()
    count, label = connected_components(links, directed=False)
    if sharp:
        first, least = _pulls(points, model, near, label, count), 0.0
    else:
        first, least = np.bincount(label, losses(points[near], model), count) / together, COST
    rows: list[Ints] = []
    for k in np.argsort(-first):
        mine = np.flatnonzero(label == k)
        if len(rows) == SUSPECTS or first[k] < least:
            break
        if len(mine) < MOST * len(points) and _in_a_row(links[mine][:, mine]):
            rows.append(near[mine])
    return rows


def _pulls(points: Floats, model: ExactModel, near: Ints, label: NDArray[np.int32], count: int) -> Floats:
    """How far each of so many parts of the points near moves the fit, in its errors (Cook's distance)."""
    found = scores(points, model)[:, : model.size]
    information = found.T @ found
    information += LEAST * float(np.trace(information)) / len(information) * np.eye(len(information))
    sums = np.zeros((count, model.size))
    np.add.at(sums, label, found[near])
    return np.asarray((sums * np.linalg.solve(information, sums.T).T).sum(axis=1))


def _in_a_row(links: csr_array) -> bool:
    """Whether the longest way through the tree that spans linked points has most of it."""
    from scipy.sparse import csr_array  # noqa: PLC0415
    from scipy.sparse.csgraph import dijkstra, minimum_spanning_tree  # noqa: PLC0415

    tree = csr_array(minimum_spanning_tree(links))
    # The place farthest from any is an end of the longest way, as in every tree.
    end = np.argmax(dijkstra(tree, directed=False, indices=np.array([0])))
    return bool(dijkstra(tree, directed=False, indices=np.array([end])).max() >= ROW * tree.sum())
