"""Picture of the solid from two sides, its faces coloured by the kind of surface they lie on."""

from __future__ import annotations

from matplotlib.figure import Figure

from sketchloft.cloud import Unit
from sketchloft.exact.body import ExactBody
from sketchloft.pipeline import Reconstruction
from sketchloft.report.axes_style import heading
from sketchloft.report.camera import BEHIND, FRONT
from sketchloft.report.faces import CREASE, coloured_faces, face_legend
from sketchloft.report.picture import new_figure
from sketchloft.report.pose import pose_of
from sketchloft.report.view3d import draw_mesh
from sketchloft.report.views import finish_views
from sketchloft.report.words import counted

__all__ = ["kinds_figure"]

PIXELS = 560
"""Resolution of a view of solids along its longer side."""


def kinds_figure(result: Reconstruction, body: ExactBody, *, unit: Unit) -> Figure:
    """Draw the solid from the front and from behind, each kind of face in its colour.

    Parameters
    ----------
    result : Reconstruction
    body : ExactBody
        One of its bodies.
    unit : {"mm", "cm", "m", "in"}

    Returns
    -------
    matplotlib.figure.Figure
    """
    mesh, colours = coloured_faces(body.solid, pose_of(result, body).centre)
    figure = new_figure(9.5, 5.4)
    front, behind = figure.subplots(1, 2)
    for ax, camera in ((front, FRONT), (behind, BEHIND)):
        draw_mesh(ax, mesh, camera, colour=colours, crease=CREASE, pixels=PIXELS)
    faces, edges = sum(body.facts.faces.values()), body.facts.edges
    heading(front, "Solid", f"{counted(faces, 'face')}, {counted(edges, 'edge')}")
    heading(behind, "The same solid", "from behind and below")
    finish_views([(front, FRONT), (behind, BEHIND)], unit)
    figure.legend(
        handles=face_legend([body.solid]), loc="outside lower center", ncols=6, frameon=False, fontsize=9
    )
    return figure
