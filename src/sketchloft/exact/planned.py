"""Planned: a body made as a plan says, its numbers kept or fitted to the points once more."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from sketchloft.cloud import Floats, Unit
from sketchloft.dispersion import clump, dispersion
from sketchloft.errors import InputError
from sketchloft.exact.body import ExactBody
from sketchloft.exact.fit.climb import climb
from sketchloft.exact.fit.fit_density import fit_density
from sketchloft.exact.fit.inward_gap import without_gap
from sketchloft.exact.fit.likelihood import beside_walls
from sketchloft.exact.fit.sharpen import least_noise, sharpened
from sketchloft.exact.model.density import Density
from sketchloft.exact.model.exact_model import ExactModel, thicker
from sketchloft.exact.search.stray_strokes import counted, stray_strokes
from sketchloft.exact.section.level_set import level_set
from sketchloft.exact.start.inside_density import inside_density
from sketchloft.exact.start.seen import sampled
from sketchloft.exact.start.start import BESIDE
from sketchloft.exact.start.stray_space import stray_space
from sketchloft.plan.from_model import planned_from_model
from sketchloft.plan.plan import Plan, PlannedBody
from sketchloft.plan.to_model import model_from_plan
from sketchloft.robust_size import middle_and_size
from sketchloft.stack_volume import stack_volume

if TYPE_CHECKING:
    from sketchloft.pipeline import Reconstruction

__all__ = ["check_bodies", "plan_of", "planned_body", "planned_model"]

NOISES = (0.02, 0.006)
"""Noise that the fit begins with, as shares of the size: the first as far as a person's edit may reach."""


def plan_of(result: Reconstruction, unit: Unit) -> Plan:
    """Plan of what the exact method found.

    Parameters
    ----------
    result : Reconstruction
    unit : {"mm", "cm", "m", "in"}
        Of the cloud.
    """
    return Plan(
        unit,
        "nothing",
        tuple(
            planned_from_model(
                body.name, body.model, body.frame, result.cloud.centre + body.centre, body.scale
            )
            for body in result.bodies
            if isinstance(body, ExactBody)
        ),
    )


def check_bodies(plan: Plan, count: int) -> None:
    """Find out whether a plan has as many bodies as the cloud.

    Raises
    ------
    InputError
        If not.
    """
    if len(plan.bodies) != count:
        raise InputError(
            f"the plan has {len(plan.bodies)} bodies, the cloud is separated into {count}; ask for "
            "as many bodies as the plan has, or give the cloud that it was made from"
        )


def planned_body(
    points: Floats, origin: Floats, plan: PlannedBody, progress: Callable[[str], None], *, fit: bool
) -> ExactBody:
    """Model a body as a plan says.

    Parameters
    ----------
    points : (n, 3) float array
        About `origin`.
    origin : (3,) float array
    plan : PlannedBody
    progress : callable
        Called with the name of each stage when it begins.
    fit : bool
        Whether the numbers are fitted to the points; the direction, the kinds, the joins and what is shared
        are kept in any case.

    Raises
    ------
    ModelError
        If the solid fails a check.
    """
    progress("fit")
    _, scale = middle_and_size(points)
    centre, frame = plan.centre - origin, plan.frame
    local = frame.to_local((points - centre) / scale)
    model = planned_model(local, plan, scale)
    if fit:
        model = _refitted(local, model)
    progress("solid")
    from sketchloft.brep.build_stack import built_stack  # noqa: PLC0415  the kernel takes most of a second

    solid, facts = built_stack(model.stack, plan.centre, frame.axes, scale)
    return ExactBody(
        name=plan.name,
        points=local,
        vector=frame.direction,
        candidates=(),
        frame=frame,
        centre=centre,
        scale=scale,
        cuts=model.stack.breaks,
        first=model,
        model=model,
        solid=solid,
        facts=facts,
    )


def planned_model(points: Floats, plan: PlannedBody, scale: float) -> ExactModel:
    """Model of a plan, all numbers as they are written.

    Parameters
    ----------
    points : (n, 3) float array
        In the frame of the plan, in a unit of this size; they say how dense they are.
    plan : PlannedBody
    scale : float
    """
    sample = sampled(points)
    space = stray_space(sample, dispersion(sample))
    model = model_from_plan(plan, scale, stray=1 / space, space=space)
    inside = np.log(len(points) / max(stack_volume(model.stack), 1e-9))
    return replace(model, density=Density(np.array([inside])))


def _refitted(points: Floats, model: ExactModel) -> ExactModel:
    together = dispersion(points)
    grid = level_set(points, clump(together))
    model = replace(model, density=inside_density(points, grid, together))
    for noise in NOISES:
        model = fit_density(points, replace(model, sigma=noise), 2)
        near = beside_walls(points, model, BESIDE * noise)
        model, _, _ = climb(points[near], model, 10)
    sample = sampled(points)
    every = len(points) / len(sample)
    strays = stray_strokes(sample, thicker(model, 1 / every), dispersion(sample))
    kept, model = points[strays.among(points, sample)], thicker(strays.model, every)
    model, _, _ = sharpened(kept, fit_density(kept, model, 2), tilt=False)
    return counted(without_gap(model, least_noise(model, len(kept))), len(points) - len(kept))
