"""Gallery: clouds and models beside each other in one picture, from one side and at one scale."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from sketchloft import Mesh, PointCloud
from sketchloft.report.axes_style import heading
from sketchloft.report.camera import FRONT, project
from sketchloft.report.palette import CLOUD
from sketchloft.report.picture import new_figure, save_figure
from sketchloft.report.view3d import draw_mesh, draw_points
from sketchloft.report.views import finish_views
from trial import UNIT

__all__ = ["Panel", "draw_gallery"]

HEIGHT, MARGINS = 4.6, 1.1
"""Inches for a panel, and for its heading and the axes below it."""
NARROWEST, WIDEST = 3.4, 5.0


@dataclass(frozen=True)
class Panel:
    """What is shown, with a title and a line below it."""

    title: str
    below: str
    shown: Mesh | PointCloud


def draw_gallery(panels: Sequence[Panel], path: Path) -> Path:
    """Write panels side by side as PNG and return its path."""
    points = [one.shown.vertices if isinstance(one.shown, Mesh) else one.shown.points for one in panels]
    across, up = np.ptp(project(FRONT, np.concatenate(points)), axis=0)[:2]
    width = float(np.clip(HEIGHT * across / up, NARROWEST, WIDEST))
    figure = new_figure(width * len(panels), min(HEIGHT, width * up / across) + MARGINS)
    views = figure.subplots(1, len(panels))
    for ax, panel in zip(views, panels, strict=True):
        if isinstance(panel.shown, Mesh):
            draw_mesh(ax, panel.shown, FRONT)
        else:
            draw_points(ax, panel.shown.points, FRONT, colour=CLOUD, size=1.6, opacity=0.7)
        heading(ax, panel.title, panel.below)
    finish_views([(ax, FRONT) for ax in views], UNIT)
    save_figure(figure, path)
    return path
