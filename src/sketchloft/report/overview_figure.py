"""Picture of all bodies: the cloud on the left, the model on the right."""

from __future__ import annotations

import numpy as np
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from sketchloft.cloud import Unit
from sketchloft.pipeline import Reconstruction
from sketchloft.report.axes_style import heading, legend_below
from sketchloft.report.camera import FRONT
from sketchloft.report.faces import CREASE, coloured_faces, face_legend, joined
from sketchloft.report.palette import BODIES, CLOUD
from sketchloft.report.picture import new_figure
from sketchloft.report.pose import pose_of
from sketchloft.report.thinning import thinned
from sketchloft.report.view3d import draw_mesh, draw_points
from sketchloft.report.views import finish_views
from sketchloft.report.words import counted

__all__ = ["overview_figure"]

PIXELS = 560
"""Resolution of a view of solids along its longer side."""
MOST = 20_000
"""Points that are drawn; an even sample stands for more."""


def overview_figure(result: Reconstruction, *, unit: Unit) -> Figure:
    """Draw the points of all bodies beside their solids.

    Several bodies have a colour each; a single one is coloured by its kinds of faces.

    Parameters
    ----------
    result : Reconstruction
    unit : {"mm", "cm", "m", "in"}

    Returns
    -------
    matplotlib.figure.Figure
    """
    bodies = result.bodies
    several = len(bodies) > 1
    figure = new_figure(9.5, 5.4)
    cloud, model = figure.subplots(1, 2)
    for number, body in enumerate(bodies):
        pose = pose_of(result, body)
        shown = pose.in_space(thinned(body.points, MOST // len(bodies))) + (pose.centre - result.cloud.centre)
        draw_points(cloud, shown, FRONT, colour=BODIES[number] if several else CLOUD, size=1.8, opacity=0.8)
    heading(cloud, "Cloud", counted(sum(len(body.points) for body in bodies), "point"))
    solids = [coloured_faces(body.solid, result.cloud.centre) for body in bodies]
    plain = [np.tile(to_rgb(BODIES[i]), (len(paint), 1)) for i, (_, paint) in enumerate(solids)]
    paint = np.concatenate(plain if several else [paint for _, paint in solids])
    draw_mesh(model, joined([mesh for mesh, _ in solids]), FRONT, colour=paint, crease=CREASE, pixels=PIXELS)
    faces = sum(sum(body.facts.faces.values()) for body in bodies)
    heading(model, "Model", f"{counted(len(bodies), 'solid')}, {counted(faces, 'face')}")
    finish_views([(cloud, FRONT), (model, FRONT)], unit)
    names = [Patch(color=BODIES[i], label=f"body {i + 1}") for i in range(len(bodies))]
    legend_below(model, names if several else face_legend([bodies[0].solid]), columns=5)
    return figure
