"""Run tables: the breaks of a body, and the dimensions of its walls, each with its error."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Unit
from sketchloft.exact.body import ExactBody
from sketchloft.pipeline import Reconstruction
from sketchloft.report.dimensions import dimensions
from sketchloft.report.markup import table
from sketchloft.report.pose import pose_of
from sketchloft.report.precision import Precision, spreads
from sketchloft.report.run_words import JOINS, break_words, dimension_error, dimension_value, turn_of
from sketchloft.report.words import number, place

__all__ = ["breaks_table", "dimensions_table"]


def breaks_table(result: Reconstruction, body: ExactBody, found: Precision, unit: Unit) -> str:
    """One row per break: height, error and kind."""
    pose, model = pose_of(result, body), body.model
    heights = pose.height(model.stack.breaks)
    size = float(np.ptp(heights))
    rows = []
    for k, (height, error) in enumerate(zip(heights.tolist(), found.breaks.tolist(), strict=True)):
        words = break_words(model, k)
        rows.append(
            [
                _between(k, len(model.stack.runs)),
                place(height, size),
                number(error * body.scale, 2) if np.isfinite(error) else "",
                JOINS.get(words, words),
            ]
        )
    return table(
        ["break", f"height [{unit}]", f"error [{unit}]", "kind"],
        rows,
        caption="Breaks along the slicing direction. Where a break follows from the walls beside it, it has "
        "no error of its own.",
        numbers=[1, 2],
    )


def dimensions_table(result: Reconstruction, body: ExactBody, found: Precision, unit: Unit) -> str:
    """One row per dimension of each wall of each run."""
    turn, model = turn_of(pose_of(result, body)), body.model
    rows = []
    for j, run in enumerate(model.stack.runs):
        low, high = model.stack.breaks[[j, j + 1]].tolist()
        for i, wall in enumerate(run.walls):
            errors = spreads(model, found, j, i).tolist()
            name = wall.kind if run.sign(i) > 0 else f"{wall.kind} (hole)"
            for one, error in zip(dimensions(wall, low, high), errors, strict=True):
                value = dimension_value(one, error, body.scale, turn, unit)
                rows.append(
                    [
                        str(j + 1),
                        name,
                        str(len(wall.vector)),
                        one.name,
                        value,
                        dimension_error(one, error, body.scale),
                    ]
                )
    return table(
        ["run", "wall", "parameters", "dimension", "value", "error"],
        rows,
        caption="Walls of the runs, counted along the slicing direction, and their dimensions. Angles of "
        "outlines are from the first axis of the pictures of the sections.",
        numbers=[2, 4, 5],
    )


def _between(index: int, runs: int) -> str:
    """Which runs a break divides."""
    if index == 0:
        return "start of run 1"
    return f"end of run {runs}" if index == runs else f"run {index} to {index + 1}"
