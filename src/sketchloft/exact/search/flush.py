"""Flush: sides of neighbouring runs that lie in one plane, as far as the points can tell, are put there."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.fit.expected import empty_shell
from sketchloft.exact.fit.schwarz import price
from sketchloft.exact.model.exact_model import ExactModel, model_of
from sketchloft.exact.search.as_many_as_pay import as_many_as_pay, telling
from sketchloft.outline.outline import Segment
from sketchloft.outline.polygons import Polygon
from sketchloft.stack import Run, Stack, Wall
from sketchloft.wall.swept import Swept

__all__ = ["flush", "polygon_between"]

NOISES, SHELLS = 4.0, 100.0
"""Sides within so many noise deviations and expected empty shells of each other may be one."""
FLAT = 0.05
"""Sine of the turn at a corner below which it is not known where the sides meet."""

Line = tuple[Floats, float]
"""Unit normal n and offset c: the points x with n . x = c."""


@dataclass(frozen=True)
class Side:
    """A straight side of a prism.

    Parameters
    ----------
    run, wall, edge : int
        Which it is.
    start, end : (2,) float array
    height : float
        Of its run.
    """

    run: int
    wall: int
    edge: int
    start: Floats
    end: Floats
    height: float

    @property
    def line(self) -> Line:
        """The line that it lies on."""
        along = self.end - self.start
        normal = np.array([along[1], -along[0]]) / np.hypot(*along)
        return normal, float(normal @ self.start)


def flush(points: Floats, model: ExactModel, together: float) -> ExactModel:
    """Put sides of neighbouring runs into common planes where the likelihood allows it.

    Parameters
    ----------
    points : (n, 3) float array
    model : ExactModel
        Fitted.
    together : float
        How many of the points go together.

    Notes
    -----
    A common plane is the mean of its sides, weighted by their areas; the corners are where the planes of
    neighbouring sides meet. Each one takes two parameters away, so that it may cost what they are worth by
    Schwarz's criterion.
    """
    sides = [side for j in range(len(model.stack.runs)) for side in _sides(model, j)]
    reach = NOISES * model.sigma + SHELLS * empty_shell(model, len(points))
    pairs = [
        (a, b)
        for a, one in enumerate(sides)
        for b, other in enumerate(sides)
        if other.run == one.run + 1 and _near(one, other, reach)
    ]
    if not pairs:
        return model
    worth = together * price(2, len(points), together)
    return as_many_as_pay(telling(points, model), model, pairs, worth, partial(_joined, model, sides))


def _sides(model: ExactModel, j: int) -> list[Side]:
    low, high = model.stack.breaks[j : j + 2].tolist()
    return [
        Side(j, i, k, edge.start, edge.end, high - low)
        for i, wall in enumerate(model.stack.runs[j].walls)
        if isinstance(wall, Swept) and _is_prism(wall)
        for k, edge in enumerate(wall.outline.edges())
        if isinstance(edge, Segment)
    ]


def _is_prism(wall: Swept) -> bool:
    """Whether a wall stands straight on a polygon."""
    return wall.still and all(isinstance(edge, Segment) for edge in wall.outline.edges())


def _near(one: Side, other: Side, reach: float) -> bool:
    """Whether two sides face the same way, in one plane and beside each other."""
    along = one.end - one.start
    length = float(np.hypot(*along))
    ends = np.array([other.start, other.end]) - one.start
    share = np.sort(ends @ along / length**2)
    apart = np.abs(ends @ one.line[0])
    return bool(one.line[0] @ other.line[0] > 0 and apart.max() < reach and share[1] > 0 and share[0] < 1)


def _joined(model: ExactModel, sides: list[Side], pairs: list[tuple[int, int]]) -> ExactModel | None:
    """The model with the planes of pairs of sides made one; None where sides do not meet then."""
    group = np.arange(len(sides))
    for a, b in pairs:
        group[group == group[b]] = group[a]
    joined = set(group[[k for pair in pairs for k in pair]].tolist())
    common = {name: _common([sides[k] for k in np.flatnonzero(group == name)]) for name in joined}
    lines: dict[tuple[int, int], list[Line]] = {}
    for side, name in zip(sides, group.tolist(), strict=True):
        lines.setdefault((side.run, side.wall), []).append(common.get(name, side.line))
    moved = {(sides[k].run, sides[k].wall) for k in np.flatnonzero(np.isin(group, list(joined)))}
    polygons = {place: polygon_between(lines[place]) for place in moved}
    if None in polygons.values():
        return None
    runs = tuple(
        Run(tuple(_on(wall, polygons.get((j, i))) for i, wall in enumerate(run.walls)), run.holes)
        for j, run in enumerate(model.stack.runs)
    )
    fresh = model_of(Stack(model.stack.breaks, runs), model.sigma, model.density, model.stray, model.space)
    return replace(fresh, joins=model.joins, core=model.core)


def _on(wall: Wall, polygon: Polygon | None) -> Wall:
    """The wall upon a polygon, or as it was."""
    return wall if polygon is None or not isinstance(wall, Swept) else replace(wall, outline=polygon)


def _common(sides: list[Side]) -> Line:
    lengths = np.array([float(np.hypot(*(side.end - side.start))) for side in sides])
    weights = lengths * [side.height for side in sides]
    # A side says where its direction is with the cube of its length.
    normal = (weights * lengths**2) @ np.array([side.line[0] for side in sides])
    normal /= np.hypot(*normal)
    middles = np.array([(side.start + side.end) / 2 for side in sides])
    return normal, float(weights @ (middles @ normal) / weights.sum())


def polygon_between(lines: list[Line]) -> Polygon | None:
    """Polygon with its sides on lines, in their order; None where two neighbours hardly meet."""
    vertices = []
    for (n0, c0), (n1, c1) in zip(lines[-1:] + lines[:-1], lines, strict=True):
        matrix = np.array([n0, n1])
        if abs(float(np.linalg.det(matrix))) < FLAT:
            return None
        vertices.append(np.linalg.solve(matrix, np.array([c0, c1])))
    return Polygon(np.array(vertices))
