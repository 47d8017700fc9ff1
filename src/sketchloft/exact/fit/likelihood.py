"""Likelihood: how well walls, noise and density explain the points, and which way they should move.

The points are a Poisson process of density ``rho(x) * inside(x) + stray``, where ``inside`` falls from 1 to
0 across the walls as the normal distribution of the noise does.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import NoReturn

import numpy as np
from numpy.typing import NDArray

from sketchloft.cloud import Floats, Ints
from sketchloft.exact.fit.expected import expected_points, expected_slope, wall_nodes
from sketchloft.exact.fit.inside import share_within, slabs_of, slopes_of
from sketchloft.exact.fit.motion import LAST, Bools
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.exact.model.soundness import sound

__all__ = [
    "Derivatives",
    "Evaluation",
    "beside_walls",
    "evaluate",
    "evaluated",
    "losses",
    "rising",
    "scores",
    "share_of",
    "value_of",
]


@dataclass(frozen=True)
class Derivatives:
    """Those of the log likelihood by walls, breaks, tilt, log sigma and log stray, in this order.

    They tell nothing of parameters that are not free.

    Parameters
    ----------
    score : (p,) float array
    information : (p, p) float array
        Sum of the outer products of the points' scores.
    reach : (p,) float array
        Largest movement of a wall that a unit of each parameter makes.
    """

    score: Floats
    information: Floats
    reach: Floats


@dataclass(frozen=True)
class Evaluation:
    """The log likelihood, and its derivatives for who asks.

    Parameters
    ----------
    points : (n, 3) float array
        Rising.
    model : ExactModel
    caps : bool
        Whether the first and last break are walls.
    value : float
        Minus infinity where the model is not sound: then there are no derivatives.
    derive : callable
        Finds the derivatives by some parameters, which a step that leads downwards has no use for.
    each : callable
        Finds what each point adds to their scores (n, p), and the reach.
    """

    points: Floats
    model: ExactModel
    caps: bool
    value: float
    derive: Callable[[Bools], Derivatives]
    each: Callable[[Bools], tuple[Floats, Floats]]
    _found: dict[bytes, Derivatives] = field(default_factory=dict, init=False, repr=False)

    def derivatives(self, free: Bools | None = None) -> Derivatives:
        """Those by the parameters that are free (p,), or by all of them; found once."""
        if free is None:
            free = np.ones(_parameters(self.model), dtype=bool)
        key = free.tobytes()
        if key not in self._found:
            self._found[key] = self.derive(free)
        return self._found[key]


def beside_walls(points: Floats, model: ExactModel, width: float) -> NDArray[np.bool_]:
    """(n,) whether points (n, 3) lie within a width of a wall or a break, or outside."""
    return np.asarray(_share_inside(points, model, width / 3) < 0.9987)


def evaluate(points: Floats, model: ExactModel, *, caps: bool = True) -> Evaluation:
    """Evaluate the likelihood of the points (n, 3) and its derivatives.

    Parameters
    ----------
    points : (n, 3) float array
    model : ExactModel
    caps : bool
        Whether the first and last break are walls. Without, all points must lie between them.
    """
    return evaluated(rising(points), model, caps=caps)


def evaluated(points: Floats, model: ExactModel, *, caps: bool) -> Evaluation:
    """Evaluate, as `evaluate`, what is known to be `rising`."""
    if not sound(model):
        return Evaluation(points, model, caps, -np.inf, _none, _none)
    slabs = slabs_of(points, model, model.sigma, caps=caps)
    rho = model.density.at(points)
    total = rho * share_within(len(points), slabs) + model.stray
    nodes = wall_nodes(model)

    def each(free: Bools) -> tuple[Floats, Floats]:
        slope, reach = slopes_of(points, model, slabs, free)
        ratio = (rho / total)[:, None] * slope
        ratio[:, -1] = model.stray / total
        return ratio, reach

    def derive(free: Bools) -> Derivatives:
        ratio, reach = each(free)
        score = ratio.sum(axis=0)
        score[: model.size + len(model.stack.breaks)] -= expected_slope(model, nodes, free, caps=caps)
        score[-1] -= model.stray * model.space
        return Derivatives(score, ratio.T @ ratio, reach)

    value = float(np.log(total).sum()) - expected_points(model, nodes) - model.stray * model.space
    return Evaluation(points, model, caps, value, derive, each)


def _parameters(model: ExactModel) -> int:
    return model.size + len(model.stack.breaks) + LAST


def _none(_: Bools) -> NoReturn:
    raise ValueError("a model that is not sound has no likelihood, and no derivatives of it")


def value_of(points: Floats, model: ExactModel, *, caps: bool = True) -> float:
    """Return the log likelihood alone, as `evaluate` does."""
    return evaluate(points, model, caps=caps).value


def share_of(points: Floats, model: ExactModel, *, caps: bool = True) -> Floats:
    """(n,) probability of each point to be none of the strays."""
    inside = model.density.at(points) * _share_inside(points, model, model.sigma, caps=caps)
    return inside / (inside + model.stray)


def losses(points: Floats, model: ExactModel) -> Floats:
    """(n,) what points (n, 3) cost in log likelihood beside ones that are deep inside."""
    inside = _share_inside(points, model, model.sigma)
    return -np.log(inside + model.stray / model.density.at(points))


def scores(points: Floats, model: ExactModel, *, caps: bool = True) -> Floats:
    """(n, p) what each of the points (n, 3) says of each parameter: the slopes of its log likelihood."""
    ratio, _ = evaluate(points, model, caps=caps).each(np.ones(_parameters(model), dtype=bool))
    found = np.empty_like(ratio)
    found[_upwards(points)] = ratio
    return found


def rising(points: Floats) -> Floats:
    """Points (n, 3) in the order in which those of a run are all in a row, each coordinate in one piece."""
    return np.asfortranarray(points[_upwards(points)])


def _upwards(points: Floats) -> slice | Ints:
    """Order of points (n, 3) by height: as they are, where they rise already."""
    z = points[:, 2]
    return slice(None) if (z[1:] >= z[:-1]).all() else np.argsort(z, kind="stable")


def _share_inside(points: Floats, model: ExactModel, sigma: float, *, caps: bool = True) -> Floats:
    """Soft indicator (n,) of points in any order."""
    order, inside = _upwards(points), np.empty(len(points))
    inside[order] = share_within(len(points), slabs_of(points[order], model, sigma, caps=caps))
    return inside
