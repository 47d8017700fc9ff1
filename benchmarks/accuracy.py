"""Accuracy: how far models of known solids lie from them, over several seeds.

    python benchmarks/accuracy.py [--points 10000] [--seeds 10] [--ways exact,auto,off] [--fill uniform]
        [--noisy] [--goals lamp,sphere]

A row per goal, number of points and way: exact is the method exact, its direction found; every other word the
paper's method along z with that choice of `--shapes`, such as auto and off. Median and worst of the root mean
square normal distance (model to goal or goal to model, whichever is larger), in thousandths of the goal's
diagonal; beside it the limit V / (n S), the expected width of the empty shell within the surface that one
parameter leaves, in the same unit; and the number of valid solids. `--noisy` adds 0.5 % of white noise and
1 % of stray points.
"""

from __future__ import annotations

import argparse
from dataclasses import replace
from typing import get_args

import numpy as np

from sketchloft import Mesh, Params, PointCloud, SketchloftError, measure, reconstruct
from sketchloft.brep.facts import solid_facts
from sketchloft.brep.primitives import fuse
from sketchloft.brep.tessellate import tessellate
from sketchloft.direction import DirectionParams
from sketchloft.sample import GOALS, Fill, FillParams, sample_goal
from sketchloft.shapes.choice import ShapesParams

__all__ = ["error", "main", "row"]

Z = DirectionParams((0.0, 0.0, 1.0))


def error(cloud: PointCloud, goal: Mesh, way: str) -> float:
    """Larger of both root mean squares, in thousandths of the diagonal; NaN where there is no model."""
    params = Params()
    if way != "exact":
        params = Params(direction=Z, method="paper", shapes=ShapesParams(way))
    try:
        body = reconstruct(cloud, params).bodies[0]
    except SketchloftError:
        return np.nan
    found = measure(tessellate(body.solid, 1e-4, 0.2), goal, n=10_000)
    return max(found.errors_in_thousandths.rms, found.back_errors_in_thousandths.rms)


def row(name: str, points: int, seeds: int, way: str, fill: FillParams) -> str:
    """One line of the table."""
    solid = fuse(GOALS[name].parts)
    goal, facts = tessellate(solid, 2e-5, 0.1), solid_facts(solid)
    limit = 1000 * facts.volume / (points * facts.area) / float(np.linalg.norm(np.ptp(facts.bounds, axis=0)))
    clouds = (sample_goal(GOALS[name], points, fill, seed=i + 1) for i in range(seeds))
    found = np.array([error(cloud, goal, way) for cloud in clouds])
    valid = found[np.isfinite(found)]
    figures = f"{np.median(valid):8.2f}{valid.max():8.2f}" if len(valid) else f"{'-':>8}{'-':>8}"
    kind = "noisy" if fill.jitter else fill.fill
    return f"{name:16}{kind:10}{way:12}{points:>9}{figures}{limit:9.4f}{len(valid):>5}/{seeds}"


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--points", default="10000")
    parser.add_argument("--seeds", type=int, default=10)
    parser.add_argument("--ways", default="exact,auto,off")
    parser.add_argument("--fill", default="uniform", choices=get_args(Fill))
    parser.add_argument("--noisy", action="store_true")
    parser.add_argument("--goals", default=",".join(GOALS))
    asked = parser.parse_args()
    fill = FillParams(fill=asked.fill)
    if asked.noisy:
        fill = replace(fill, jitter=0.005, outliers=0.01)
    print(f"{'goal':16}{'fill':10}{'way':12}{'points':>9}{'median':>8}{'worst':>8}{'V/(nS)':>9}{'valid':>7}")
    for name in asked.goals.split(","):
        for points in map(int, asked.points.split(",")):
            for way in asked.ways.split(","):
                print(row(name, points, asked.seeds, way, fill), flush=True)


if __name__ == "__main__":
    main()
