"""Picture of one cloud lofted along several slicing directions (paper, figure 4)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure

from sketchloft.cloud import Floats, Unit
from sketchloft.direction import Direction, DirectionParams, slicing_direction
from sketchloft.errors import UsageError
from sketchloft.pipeline import BodyModel, Reconstruction
from sketchloft.report.axes_style import heading
from sketchloft.report.camera import FRONT
from sketchloft.report.faces import CREASE, coloured_faces
from sketchloft.report.loft_figure import draw_sections
from sketchloft.report.palette import INK
from sketchloft.report.picture import new_figure
from sketchloft.report.pose import pose_of
from sketchloft.report.view3d import draw_mesh
from sketchloft.report.views import finish_views
from sketchloft.report.words import direction_words, number

__all__ = ["directions_figure"]

PIXELS = 480
"""Resolution of a view of solids along its longer side."""
SAME = 1 - 1e-9
"""Cosine from which on two directions are one."""


def directions_figure(results: Sequence[Reconstruction], *, unit: Unit) -> Figure:
    """Draw the sections and the solid of the same cloud under several slicing directions.

    Parameters
    ----------
    results : sequence of Reconstruction
        Of one cloud; of each the first body is shown.
    unit : {"mm", "cm", "m", "in"}

    Returns
    -------
    matplotlib.figure.Figure
        Each direction with its value of the target function, where the automatic choice would look
        at it; the one that the automatic choice takes is marked.

    Raises
    ------
    UsageError
        If there is none, or one is no loft.
    """
    if not results:
        raise UsageError("directions: found no reconstruction, expected one for each direction")
    bodies = [result.bodies[0] for result in results if isinstance(result.bodies[0], BodyModel)]
    if len(bodies) < len(results):
        raise UsageError("directions: found the method exact, expected lofts; choose the method paper")
    points = bodies[0].frame.to_world(bodies[0].points)
    judged = slicing_direction(points - points.mean(axis=0), DirectionParams())
    figure = new_figure(3.9 * len(results), 7.6)
    panels = figure.subplots(2, len(results), squeeze=False)
    for result, body, (above, below) in zip(results, bodies, panels.T, strict=True):
        draw_sections(above, body, pose_of(result, body), FRONT)
        mesh, colours = coloured_faces(body.solid, result.cloud.centre)
        draw_mesh(below, mesh, FRONT, colour=colours, crease=CREASE, pixels=PIXELS)
        vector = body.direction.vector
        heading(above, f"sliced along {direction_words(vector)}", _judgement(vector, judged))
        heading(below, f"volume {number(body.facts.volume)} {unit}³", f"{len(body.sections)} sections lofted")
        if vector @ judged.vector > SAME:
            above.title.set(fontweight="bold", color=INK)
    finish_views([(ax, FRONT) for ax in panels.ravel()], unit)
    return figure


def _judgement(vector: Floats, judged: Direction) -> str:
    same = np.flatnonzero(np.abs(judged.candidates @ vector) > SAME)
    if not len(same):
        return "not a candidate of the automatic choice"
    chosen = ", chosen automatically" if vector @ judged.vector > SAME else ""
    return f"target function {number(float(judged.targets[same].min()), 3)}{chosen}"
