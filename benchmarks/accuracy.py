"""Accuracy: how far models of known solids lie from them, over several seeds.

    python benchmarks/accuracy.py [--points 10000] [--seeds 10] [--ways exact,auto,off] [--fill uniform]

A row per goal and way: exact is the method exact, every other word the paper's method with that choice of
`--shapes`, such as auto and off. Median and worst of the root mean square normal distance (model to goal or
goal to model, whichever is larger), in thousandths of the goal's diagonal, and the number of valid solids.
"""

from __future__ import annotations

import argparse
from dataclasses import replace
from typing import get_args

import numpy as np

from sketchloft import Mesh, Params, PointCloud, SketchloftError, measure, reconstruct
from sketchloft.brep.primitives import fuse
from sketchloft.brep.tessellate import tessellate
from sketchloft.direction import DirectionParams
from sketchloft.sample import GOALS, Fill, FillParams, sample_goal
from sketchloft.shapes.choice import ShapesParams

__all__ = ["error", "main", "row"]

Z = DirectionParams((0.0, 0.0, 1.0))


def error(cloud: PointCloud, goal: Mesh, way: str) -> float:
    """Larger of both root mean squares, in thousandths of the diagonal; NaN where there is no model."""
    params = Params(direction=Z)
    if way != "exact":
        params = replace(params, method="paper", shapes=ShapesParams(way))
    try:
        body = reconstruct(cloud, params).bodies[0]
    except SketchloftError:
        return np.nan
    found = measure(tessellate(body.solid, 1e-4, 0.2), goal, n=10_000)
    return max(found.errors_in_thousandths.rms, found.back_errors_in_thousandths.rms)


def row(name: str, points: int, seeds: int, way: str, fill: Fill) -> str:
    """One line of the table."""
    goal = tessellate(fuse(GOALS[name].parts), 2e-5, 0.1)
    clouds = (sample_goal(GOALS[name], points, FillParams(fill=fill), seed=i + 1) for i in range(seeds))
    found = np.array([error(cloud, goal, way) for cloud in clouds])
    valid = found[np.isfinite(found)]
    figures = f"{np.median(valid):8.2f}{valid.max():8.2f}" if len(valid) else f"{'-':>8}{'-':>8}"
    return f"{name:16}{fill:10}{way:12}{points:>9}{figures}{len(valid):>5}/{seeds}"


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--points", type=int, default=10_000)
    parser.add_argument("--seeds", type=int, default=10)
    parser.add_argument("--ways", default="exact,auto,off")
    parser.add_argument("--fill", default="uniform", choices=get_args(Fill))
    parser.add_argument("--goals", default=",".join(GOALS))
    asked = parser.parse_args()
    print(f"{'goal':16}{'fill':10}{'way':12}{'points':>9}{'median':>8}{'worst':>8}{'valid':>7}")
    for name in asked.goals.split(","):
        for way in asked.ways.split(","):
            print(row(name, asked.points, asked.seeds, way, asked.fill), flush=True)


if __name__ == "__main__":
    main()
