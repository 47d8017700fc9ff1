"""Run words: what runs, their walls, breaks and dimensions are called."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

import numpy as np

from sketchloft.cloud import Unit
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.exact.model.kinks import kink_ties
from sketchloft.report.dimensions import Dimension
from sketchloft.report.pose import Pose
from sketchloft.report.words import MINUS, TIMES, number
from sketchloft.stack import Run

__all__ = ["JOINS", "break_words", "dimension_error", "dimension_value", "kinds", "run_words", "turn_of"]

JOINS = {
    "step": "step, the section jumps there and leaves a plane ledge",
    "cross": "crossing, the walls on both sides meet there in a kink",
    "tangent": "tangent, one wall goes over into the other there without a kink",
    "pole": "pole, the wall closes there by itself",
}
"""What the breaks are."""


def run_words(run: Run) -> str:
    """Kinds of the walls of a run: "2 x rectangle", "cylinder, hole cylinder"."""
    if run.torus is not None:
        return "whole torus"
    outer = len(run.walls) - run.holes
    parts = [kinds(run.kinds[:outer])]
    if run.holes:
        name = "hole" if run.holes == 1 else "holes"
        parts.append(f"{name} {kinds(run.kinds[outer:])}")
    return ", ".join(parts)


def kinds(names: Sequence[str]) -> str:
    """Names with how often each comes, where it comes more than once."""
    counts = Counter(names)
    return " + ".join(name if count == 1 else f"{count} {TIMES} {name}" for name, count in counts.items())


def break_words(model: ExactModel, index: int) -> str:
    """What a break is, in a word or two."""
    join, runs = model.joins[index], model.stack.runs
    if join != "step":
        return join
    if index in (0, len(runs)):
        return "flat end"
    return "cross" if kink_ties(runs[index - 1], runs[index], index) else "step"


def turn_of(pose: Pose) -> float:
    """Angle in the plan of what lies along x in the body."""
    start, end = pose.in_plan(np.array([[0.0, 0.0], [1.0, 0.0]]))
    return float(np.arctan2(*(end - start)[::-1]))


def dimension_value(one: Dimension, error: float, scale: float, turn: float, unit: Unit) -> str:
    """Value of a dimension in the unit of the cloud, with as many digits as its error leaves."""
    value = _scaled(one.value, one, scale)
    if one.period:
        period = np.degrees(one.period)
        value = (value + np.degrees(turn) + period / 2) % period - period / 2
    error = _scaled(error, one, scale)
    decimals = 0 if one.measure == "count" else _decimals(error)
    digits = number(value) if decimals is None else f"{value:.{decimals}f}".replace("-", MINUS)
    signs = {"length": f" {unit}", "area": f" {unit}²", "angle": "°", "ratio": " times", "count": ""}
    return digits + signs[one.measure]


def dimension_error(one: Dimension, error: float, scale: float) -> str:
    """Standard error of a dimension, two digits of it."""
    error = _scaled(error, one, scale)
    decimals = _decimals(error)
    return "" if decimals is None else f"{error:.{decimals}f}"


def _scaled(value: float, one: Dimension, scale: float) -> float:
    factors = {"length": scale, "area": scale**2, "angle": 180 / np.pi, "ratio": 1.0, "count": 1.0}
    return value * factors[one.measure]


def _decimals(error: float) -> int | None:
    """Decimals that show two digits of an error, if they are few."""
    if not (np.isfinite(error) and error > 0):
        return None
    decimals = 1 - int(np.floor(np.log10(error)))
    return decimals if 0 <= decimals <= 8 else None
