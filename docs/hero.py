"""Hero: the picture at the head of the README, from the cloud through slices and contours to the model."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_rgb
from matplotlib.patches import FancyArrowPatch

from sketchloft.report.camera import Camera, project
from sketchloft.report.faces import coloured_faces
from sketchloft.report.palette import CLOUD, CURVES, INK, MUTED
from sketchloft.report.picture import new_figure, save_figure
from sketchloft.report.pose import pose_of
from sketchloft.report.view3d import draw_mesh, draw_points
from trial import Trial

__all__ = ["draw_hero"]

CAMERA = Camera((0.6, -1.0, 0.45))
WIDTH, HEIGHT, WORDS = 11.0, 4.6, 0.66
"""Inches of the whole, and of the words below the panels."""
MARGIN = 0.03
"""Room around what is drawn, as a share of it."""
AROUND = np.arange(361) / 360
PAPER = 0.84
"""How white the slices are, from 0 (in the colour of their contour) to 1."""


def draw_hero(one: Trial, path: Path) -> Path:
    """Write the cloud, slices and solid side by side as PNG and return its path."""
    result, body = one.result, one.lofted
    points = pose_of(result, body).in_space(body.points)
    flat = project(CAMERA, points)[:, :2]
    margin = MARGIN * np.ptp(flat, axis=0)
    limits = np.stack([flat.min(axis=0) - margin, flat.max(axis=0) + margin])
    figure = new_figure(WIDTH, HEIGHT)
    figure.set_layout_engine("none")
    words = (
        ("Cloud", f"{len(points):,} points in no order"),
        ("Slices and contours", f"{len(body.sections)} sections, their shapes recognised"),
        ("CAD model", f"one valid solid of {sum(body.facts.faces.values())} faces"),
    )
    for i, (name, below) in enumerate(words):
        ax = figure.add_axes((i / 3, WORDS / HEIGHT, 1 / 3, 0.97 - WORDS / HEIGHT))
        if i == 0:
            draw_points(ax, points, CAMERA, colour=CLOUD, size=1.5, opacity=0.8, haze=0.6)
        elif i == 1:
            draw_points(ax, points, CAMERA, colour=CLOUD, size=1.2, opacity=0.25, haze=0.6)
            _draw_slices(ax, one)
        else:
            mesh, colours = coloured_faces(body.solid, result.cloud.centre)
            draw_mesh(ax, mesh, CAMERA, colour=colours, crease=50.0, pixels=900)
        ax.set(xlim=limits[:, 0], ylim=limits[:, 1], aspect="equal")
        ax.set_axis_off()
        figure.text((2 * i + 1) / 6, 0.4 / HEIGHT, name, ha="center", fontsize=14, color=INK)
        figure.text((2 * i + 1) / 6, 0.14 / HEIGHT, below, ha="center", fontsize=10, color=MUTED)
        if i:
            ends = ((i / 3 - 0.022, 0.52), (i / 3 + 0.022, 0.52))
            figure.add_artist(FancyArrowPatch(*ends, arrowstyle="-|>", mutation_scale=18, lw=2, color=MUTED))
    save_figure(figure, path)
    return path


def _draw_slices(ax: Axes, one: Trial) -> None:
    """Slices as sheets of paper with their worked points, the higher ones over the lower ones."""
    body, pose = one.lofted, pose_of(one.result, one.lofted)
    for order, (worked, section) in enumerate(zip(body.worked, body.sections, strict=True), start=3):
        colour = CURVES[section.shape.kind]
        ring, inner = (
            project(CAMERA, pose.in_space(np.column_stack([flat, np.full(len(flat), section.height)])))
            for flat in (section.shape.evaluate(AROUND), worked.points)
        )
        pale = PAPER + (1 - PAPER) * np.array(to_rgb(colour))
        ax.fill(ring[:, 0], ring[:, 1], facecolor=pale, edgecolor=colour, linewidth=1.3, zorder=order)
        ax.scatter(inner[:, 0], inner[:, 1], s=1.5, c=CLOUD, alpha=0.7, linewidths=0, zorder=order + 0.5)
