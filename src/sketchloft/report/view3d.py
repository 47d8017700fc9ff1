"""View: draw triangles, points and lines in space on a matplotlib Axes, without OpenGL."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import Colormap, to_rgb
from matplotlib.typing import ColorType

from sketchloft.cloud import Floats, Ints
from sketchloft.mesh import Mesh
from sketchloft.report.camera import Camera, project
from sketchloft.report.render import render

__all__ = ["CLAY", "draw_lines", "draw_mesh", "draw_points"]

CLAY = "#b4c6dc"
"""The colour of a surface that shows no values."""
SOFT = 0.6
"""Contrast of light and shadow where colours stand for values and must stay legible."""


def draw_mesh(
    ax: Axes,
    mesh: Mesh,
    camera: Camera,
    *,
    colour: ColorType | Floats = CLAY,
    values: Floats | None = None,
    cmap: str | Colormap = "coolwarm",
    limits: tuple[float, float] | None = None,
    crease: float = 30.0,
    lines: float = 0.55,
    opacity: float = 1.0,
    pixels: int = 640,
) -> None:
    """Draw a surface under soft light, with what is hidden left out.

    Parameters
    ----------
    ax : matplotlib.axes.Axes
        Gets equal scales, no frame, and limits that hold all that is drawn on it.
    mesh : Mesh
        To draw several things that hide each other, give them as one mesh.
    camera : Camera
    colour : colour or (t, 3) float array
        One for all, or red, green and blue of each triangle from 0 to 1.
    values : (m,) float array, optional
        Values at the vertices, shown in the colours of `cmap` instead.
    cmap : str or Colormap
    limits : (low, high), optional
        Values at the ends of `cmap`; from the smallest to the largest value if not given.
    crease : float
        Edges sharper than this, in degrees, are drawn sharp.
    lines : float
        How dark outlines and creases are, from 0 (none) to 1 (black).
    opacity : float
        From 0 to 1; below 1 what was drawn before shines through.
    pixels : int
        Resolution along the picture's longer side.
    """

    def paint(triangle: Ints, weights: Floats) -> Floats:
        if values is None:
            whole = colour if isinstance(colour, np.ndarray) else to_rgb(colour)
            return np.broadcast_to(whole, (len(mesh.triangles), 3))[triangle]
        there = np.einsum("kc,kc->k", weights, values[mesh.triangles[triangle]])
        return _mapped(there, values, cmap, limits)

    contrast = 1.0 if values is None else SOFT
    picture, extent = render(
        mesh, camera, paint, crease=crease, contrast=contrast, lines=lines, pixels=pixels
    )
    picture[..., 3] *= opacity
    ax.imshow(picture, extent=extent, origin="lower", interpolation="bilinear", zorder=1)
    _fit_axes(ax, np.array([[extent[0], extent[2]], [extent[1], extent[3]]]))


def draw_points(
    ax: Axes,
    points: Floats,
    camera: Camera,
    *,
    colour: ColorType = "#3b6ea8",
    values: Floats | None = None,
    cmap: str | Colormap = "coolwarm",
    limits: tuple[float, float] | None = None,
    size: float = 1.5,
    opacity: float = 1.0,
    haze: float = 0.55,
) -> None:
    """Draw points (n, 3), the nearer ones over the farther ones.

    Parameters
    ----------
    ax, points, camera
    colour : colour
        One for all.
    values : (n,) float array, optional
        Shown in the colours of `cmap` instead.
    cmap, limits
        As in `draw_mesh`.
    size : float
        Diameter in typographic points.
    opacity : float
        From 0 to 1.
    haze : float
        How pale the farthest point is, from 0 (as strong as the nearest) to 1 (white).
    """
    if not len(points):
        return
    x, y, depth = project(camera, points).T
    paint = (
        np.tile(to_rgb(colour), (len(points), 1)) if values is None else _mapped(values, values, cmap, limits)
    )
    order = np.argsort(depth, kind="stable")
    paint = _hazed(paint, depth, haze)[order]
    ax.scatter(x[order], y[order], s=size**2, c=paint, alpha=opacity, linewidths=0, rasterized=True, zorder=2)
    _fit_axes(ax, np.column_stack([x, y]))


def draw_lines(
    ax: Axes,
    paths: Sequence[Floats],
    camera: Camera,
    *,
    colour: ColorType = "#1f3a5f",
    width: float = 0.8,
    opacity: float = 1.0,
    haze: float = 0.55,
) -> None:
    """Draw polylines, each (k, 3), the nearer ones over the farther ones.

    Parameters
    ----------
    ax, paths, camera
        Repeat the first point of a path at its end to close it.
    colour : colour
    width : float
        In typographic points.
    opacity, haze : float
        As in `draw_points`; each piece of a path is as pale as its middle is far.
    """
    if not len(paths):
        return
    pieces = np.concatenate([np.stack([path[:-1], path[1:]], axis=1) for path in paths])
    seen = project(camera, pieces)
    depth = seen[:, :, 2].mean(axis=1)
    order = np.argsort(depth, kind="stable")
    paint = _hazed(np.tile(to_rgb(colour), (len(pieces), 1)), depth, haze)[order]
    lines = LineCollection(
        seen[order, :, :2].tolist(), colors=paint, linewidths=width, alpha=opacity, capstyle="round", zorder=3
    )
    ax.add_collection(lines)
    _fit_axes(ax, seen[:, :, :2].reshape(-1, 2))


def _mapped(
    values: Floats, scale: Floats, cmap: str | Colormap, limits: tuple[float, float] | None
) -> Floats:
    """(k, 3) colours of values (k,); the limits are those of `scale` if not given."""
    low, high = limits or (float(scale.min()), float(scale.max()))
    shares = (values - low) / (high - low) if high > low else np.full(len(values), 0.5)
    return np.asarray(colormaps.get_cmap(cmap)(shares))[:, :3]


def _hazed(colours: Floats, depth: Floats, haze: float) -> Floats:
    """Blend colours towards white with the distance from the eye."""
    span = float(np.ptp(depth))
    far = (depth.max() - depth) / span if span > 0 else np.zeros(len(depth))
    return colours + (1 - colours) * (haze * far)[:, None]


def _fit_axes(ax: Axes, flat: Floats) -> None:
    """Equal scales, no frame, and limits that hold (k, 2) positions and all that was drawn before."""
    ax.use_sticky_edges = False
    ax.update_datalim(flat)
    ax.set_autoscale_on(True)
    ax.margins(0.02)
    ax.autoscale_view()
    ax.set_aspect("equal")
    ax.set_axis_off()
