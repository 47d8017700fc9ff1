"""Inward gap: walls fitted to points without noise lie a little inside them, and are moved out by as much.

Points lie inside a wall, none on it. The likelihood brings the wall up to them, so that each parameter costs
the volume of about one point.
"""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats, Ints
from sketchloft.exact.fit.expected import WallNodes, section_mass, wall_nodes
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.exact.model.joins import joined
from sketchloft.exact.model.soundness import sound
from sketchloft.wall.lofted import Lofted
from sketchloft.wall.profile import SplineProfile
from sketchloft.wall.revolved import Revolved

__all__ = ["without_gap"]

HUG = 0.7
"""Expected gap in shares of the volume of one point for each parameter, where the noise is less than that."""
SOFT = 0.36
"""Expected gap in shares of the noise of the model, where that is more, and the points have none."""
NOISY = 2.0
"""Noise, in shares of the smallest that is fitted, from which on the points have some and there is no gap."""
LEDGE = 0.5
"""Share of the larger section by which two must differ for their break to be pushed one way."""
TINY = 1e-9


def without_gap(model: ExactModel, least: float) -> ExactModel:
    """Move walls and breaks out by the gap that is expected within them.

    Parameters
    ----------
    model : ExactModel
        Fitted to all points.
    least : float
        Noise that was fitted at least.

    Notes
    -----
    Of points drawn evenly behind an edge of slope Phi(x / sigma) the most likely edge lies, in the mean of
    2,000 draws, by hypot(0.7 g, 0.36 sigma) inside theirs, g being the mean distance between them, to within
    a tenth. A wall of p parameters is taken for p edges, each of its p-th part. With noise of their own the
    points are as often outside as inside, and nothing is moved; nor are free walls, whose error is another.
    """
    share = float(np.clip((NOISY * least - model.sigma) / ((NOISY - 1) * least), 0.0, 1.0))
    if share == 0.0:
        return model
    nodes = wall_nodes(model)
    rows, targets = [], []
    users = np.bincount(np.concatenate([s for run in model.slots for s in run]), minlength=model.size)
    for node in nodes:
        row, gap = _wall_gap(model, node, users)
        rows.append(row)
        targets.append(gap)
    matrix, target = np.concatenate(rows), np.concatenate(targets)
    ridge = TINY * float((matrix**2).sum()) / model.size * np.eye(model.size)
    step = np.linalg.solve(matrix.T @ matrix + ridge, matrix.T @ target)
    breaks = model.stack.breaks + share * np.array([_break_gap(model, k) for k in range(len(model.joins))])
    moved = joined(model.moved(model.vector + share * step, breaks))
    return moved if sound(moved) else model


def _wall_gap(model: ExactModel, node: WallNodes, users: Ints) -> tuple[Floats, Floats]:
    """How each parameter, with so many walls as users, moves a wall's nodes out, and how far they should."""
    wall = model.stack.runs[node.run].walls[node.wall]
    slots = model.slots[node.run][node.wall]
    at = node.spread.points
    weight = np.sqrt(np.maximum(node.spread.areas, 0.0))
    row = np.zeros((len(at), model.size))
    np.add.at(row.T, slots, -(weight[:, None] * wall.foot(at).gradient).T)
    points = float(node.spread.areas @ model.density.at(at))
    free = isinstance(wall, Lofted) or (
        isinstance(wall, Revolved) and isinstance(wall.profile, SplineProfile)
    )
    if free or points <= 0:
        return row, np.zeros(len(at))
    between = float((1 / users[slots]).sum()) / points
    return row, node.sign * _gap(model, between) * weight


def _break_gap(model: ExactModel, k: int) -> float:
    """How far a break should move: away from the larger section that ends there."""
    if model.joins[k] != "step":
        return 0.0
    runs, height = model.stack.runs, float(model.stack.breaks[k])
    below = section_mass(model, runs[k - 1], height) if k > 0 else 0.0
    above = section_mass(model, runs[k], height) if k < len(runs) else 0.0
    net = below - above
    if abs(net) <= LEDGE * max(below, above):
        return 0.0
    return float(np.sign(net)) * _gap(model, 1 / abs(net))


def _gap(model: ExactModel, between: float) -> float:
    return float(np.hypot(HUG * between, SOFT * model.sigma))
