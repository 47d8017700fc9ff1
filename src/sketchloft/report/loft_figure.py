"""Picture of the section curves in space beside the solid lofted through them (paper, figures 9 and 10)."""

from __future__ import annotations

from collections import Counter

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from sketchloft.cloud import Floats, Unit
from sketchloft.pipeline import BodyModel, Reconstruction
from sketchloft.report.axes_style import heading, legend_below
from sketchloft.report.camera import BEHIND, FRONT, Camera
from sketchloft.report.faces import CREASE, coloured_faces, face_legend
from sketchloft.report.palette import CURVES
from sketchloft.report.picture import new_figure
from sketchloft.report.pose import Pose, pose_of
from sketchloft.report.view3d import draw_lines, draw_mesh
from sketchloft.report.views import finish_views

__all__ = ["curve_legend", "draw_sections", "loft_figure"]

PIXELS = 480
"""Resolution of a view of solids along its longer side."""
AROUND = np.arange(181) / 180


def loft_figure(result: Reconstruction, body: BodyModel, *, unit: Unit) -> Figure:
    """Draw the sections as curves in space, and the solid from two sides.

    Parameters
    ----------
    result : Reconstruction
    body : BodyModel
        One of its bodies.
    unit : {"mm", "cm", "m", "in"}

    Returns
    -------
    matplotlib.figure.Figure
    """
    figure = new_figure(11.5, 4.8)
    curves, front, behind = figure.subplots(1, 3)
    draw_sections(curves, body, pose_of(result, body), FRONT)
    heading(curves, "Section curves", f"{len(body.sections)}, one on every slice plane")
    mesh, colours = coloured_faces(body.solid, result.cloud.centre)
    for ax, camera in ((front, FRONT), (behind, BEHIND)):
        draw_mesh(ax, mesh, camera, colour=colours, crease=CREASE, pixels=PIXELS)
    heading(front, "Lofted solid", f"{sum(body.facts.faces.values())} faces, {body.facts.edges} edges")
    heading(behind, "The same solid", "from behind and below")
    finish_views([(curves, FRONT), (front, FRONT), (behind, BEHIND)], unit)
    legend_below(curves, curve_legend(body), columns=2)
    legend_below(front, face_legend([body.solid]), columns=2)
    return figure


def draw_sections(ax: Axes, body: BodyModel, pose: Pose, camera: Camera) -> None:
    """Draw the section curves of a body, in the colours of their kinds."""
    for kind in sorted({section.shape.kind for section in body.sections}):
        paths = [pose.in_space(path) for path in _paths(body, kind)]
        draw_lines(ax, paths, camera, colour=CURVES[kind], width=1.2)


def _paths(body: BodyModel, kind: str) -> list[Floats]:
    return [
        np.column_stack([section.shape.evaluate(AROUND), np.full(len(AROUND), section.height)])
        for section in body.sections
        if section.shape.kind == kind
    ]


def curve_legend(body: BodyModel) -> list[Line2D]:
    """One line per kind of section, with its number, the most frequent first."""
    counts = Counter(section.shape.kind for section in body.sections)
    return [
        Line2D([], [], color=CURVES[kind], linewidth=2, label=f"{count} {kind}{'s' if count > 1 else ''}")
        for kind, count in sorted(counts.items(), key=lambda item: (-item[1], item[0]))
    ]
