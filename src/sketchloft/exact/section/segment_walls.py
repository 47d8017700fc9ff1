"""Segment walls: the walls of one segment, chosen by evidence among all families, its ends held still."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.dispersion import clump, thinned
from sketchloft.exact.fit.climb import climb
from sketchloft.exact.fit.fit_density import fit_density
from sketchloft.exact.fit.likelihood import evaluate
from sketchloft.exact.fit.schwarz import evidence
from sketchloft.exact.model.density import Density
from sketchloft.exact.model.exact_model import ExactModel, model_of
from sketchloft.exact.model.soundness import covers
from sketchloft.exact.section.recognise_section import SectionShape, recognise_section
from sketchloft.exact.section.section_contours import PlanView, plan_view
from sketchloft.exact.section.twist import twist_of, untwisted
from sketchloft.outline.circle import Circle
from sketchloft.outline.outline import Outline
from sketchloft.stack import Run, Stack, Wall
from sketchloft.surface import basis_matrix, even_knots
from sketchloft.wall.dome import taper_and_bow
from sketchloft.wall.profile import ArcProfile, LineProfile, SplineProfile
from sketchloft.wall.revolved import Revolved
from sketchloft.wall.swept import Freedom, Swept
from sketchloft.workers import ALONE, Workers

__all__ = ["segment_run", "tori"]

MOST_POINTS = 3000
REACH = 0.03
"""How far beyond the segment's ends its walls must go, in sizes of the cloud: its breaks may move."""


def segment_run(
    points: Floats,
    ends: tuple[float, float],
    sigma: float,
    together: float,
    density: Density,
    *,
    rough: bool = False,
    turn: float = 0.0,
    workers: Workers = ALONE,
) -> Run | None:
    """Find the walls of a segment; None if its points have no section.

    Parameters
    ----------
    points : (n, 3) float array
        Between the ends, strays left out.
    ends : (low, high)
        Heights.
    sigma : float
        Noise to judge with.
    together : float
        How many of the points go together.
    density : Density
        Inside, about.
    rough : bool
        Whether a few kinds of sections will do.
    turn : float
        Turn per height that the thing as a whole seems to have; tried where the segment shows none.
    workers : Workers, optional
    """
    in_row = clump(together)
    plan = plan_view(points, in_row)
    heights = points[:, 2] - plan.height
    twist = twist_of(plan, heights, in_row)
    runs: list[Run] = []
    for turns in (twist,) if twist or not turn else (0.0, turn):
        view = untwisted(plan, heights, turns) if turns else plan
        shape = recognise_section(view.points, together, rough=rough, workers=workers)
        runs += [] if shape is None else _runs(view, shape, ends, turns)
    every = len(points) // MOST_POINTS + 1
    points, together, density = points[::every], thinned(together, every), density.times(1 / every)
    best: tuple[float, ExactModel] | None = None
    for model in workers.each(_fitted, [(points, run, ends, sigma, density) for run in runs]):
        walls = model.stack.runs[0].walls
        if not all(covers(wall, ends[0] - REACH, ends[1] + REACH) for wall in walls):
            continue
        value = evidence(evaluate(points, model, caps=False), together)
        if best is None or value > best[0]:
            best = value, model
    return None if best is None else best[1].stack.runs[0]


def _fitted(
    points: Floats, run: Run, ends: tuple[float, float], sigma: float, density: Density
) -> ExactModel:
    breaks = np.array(ends)
    space = 1.25 * float(np.prod(np.ptp(points, axis=0)))
    model = model_of(Stack(breaks, (run,)), 2 * sigma, density, 1.0 / space, space)
    for at in (2 * sigma, sigma):
        model = fit_density(points, replace(model, sigma=at), 1, caps=False)
        model, points, _ = climb(points, model, 5, caps=False)
    return fit_density(points, model, 2, caps=False)


def _runs(plan: PlanView, shape: SectionShape, ends: tuple[float, float], twist: float) -> list[Run]:
    """Ways in which the section may go along the segment, the simplest first."""
    changing = bool(np.any(plan.growth[1:]))
    pieces = len(shape.outlines) - shape.holes
    options = [
        _walls(plan, outline, ends if k < pieces else None, twist, changing=changing)
        for k, outline in enumerate(shape.outlines)
    ]
    count = max(len(option) for option in options)
    return [
        Run(tuple(option[min(k, len(option) - 1)] for option in options), shape.holes) for k in range(count)
    ]


def _walls(
    plan: PlanView, outline: Outline, ends: tuple[float, float] | None, twist: float, *, changing: bool
) -> list[Wall]:
    """Walls upon an outline. Without ends, those of a hole, which need not grow as the section does."""
    slanted = bool(np.any(plan.drift))
    taper, bow = taper_and_bow(*plan.growth[1:].tolist())
    walls: list[Wall] = []
    if ends and isinstance(outline, Circle) and not twist:
        # A density that changes across makes what is revolved look slanted.
        walls = _revolved(plan, outline, ends, changing=changing)
    if walls and not slanted:
        return walls

    def swept(*free: Freedom, taper: float = 0.0, bow: float = 0.0) -> Swept:
        drift = plan.drift if "drift" in free else np.zeros(2)
        if twist:
            free = (*free, "twist")
        wall = Swept(outline, plan.height, plan.centre, drift, taper, twist, free, bow)
        return wall if isinstance(outline, Circle) else wall.about_centre()  # a circle shows how it leans

    walls.append(swept())
    if slanted:
        walls.append(swept("drift"))
    if changing:
        walls.append(swept("taper", taper=taper))
    if slanted and changing:
        walls.append(swept("drift", "taper", taper=taper))
    if changing and not twist and bow > abs(taper):
        walls.append(swept("taper", "bow", taper=taper, bow=bow))
        if slanted:
            walls.append(swept("drift", "taper", "bow", taper=taper, bow=bow))
    return walls


def _revolved(plan: PlanView, circle: Circle, ends: tuple[float, float], *, changing: bool) -> list[Wall]:
    _, first, second = plan.growth
    height, radius = plan.height, circle.radius
    profiles: list[LineProfile | ArcProfile | SplineProfile] = [LineProfile(height, radius, None)]
    if changing:
        profiles.append(LineProfile(height, radius, radius * first / 2))
        if second < 0:
            shrink = radius**2 * first / 2
            profiles.append(ArcProfile(height + shrink, None, float(np.hypot(radius, shrink))))
        z = np.linspace(*ends, 24)
        r = radius * np.sqrt(np.maximum(1 + first * (z - height) + second * (z - height) ** 2, 0.01))
        profiles.extend(tori(z, r))
        margin = 0.1 * (ends[1] - ends[0]) + REACH
        knots = even_knots(ends[0] - margin, ends[1] + margin, 3)
        basis = basis_matrix(knots, 3, z)
        profiles.append(SplineProfile(knots, np.linalg.lstsq(basis, r, rcond=None)[0]))
    return [Revolved(circle.centre, profile) for profile in profiles]


def tori(z: Floats, r: Floats) -> list[ArcProfile]:
    """Arc through the profile, its centre off the axis."""
    rows = np.column_stack([r, z, np.ones(len(z))])
    solution = np.linalg.lstsq(rows, r**2 + z**2, rcond=None)[0]
    offset, height = float(solution[0]) / 2, float(solution[1]) / 2
    radius = float(np.sqrt(max(solution[2] + offset**2 + height**2, 1e-12)))
    reach = float(np.abs(z - height).max())
    if radius > 20 * np.ptp(z) or radius < reach:
        return []
    side = 1 if float(r.mean()) > offset else -1
    if side < 0 and offset - radius <= 0:
        return []
    return [ArcProfile(height, offset, radius, side)]
