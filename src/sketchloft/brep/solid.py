"""Solid: the kernel's solid, and the loft that makes one from a skin and two planar caps."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from OCP.BRep import BRep_Builder
from OCP.Geom import Geom_Plane
from OCP.Geom2d import Geom2d_Line
from OCP.gp import gp_Dir2d, gp_Pnt2d
from OCP.TopoDS import TopoDS_Face, TopoDS_Shape, TopoDS_Solid

from sketchloft.brep.edges import LoftEdges, loft_edges
from sketchloft.brep.kernel import CONFUSION, bspline_surface, direction, point
from sketchloft.brep.patches import PatchGrid, cut, part
from sketchloft.brep.shell_parts import planar_face, solid_of, turned_around, wire
from sketchloft.cloud import Floats
from sketchloft.errors import ModelError
from sketchloft.surface import SkinSurface, evaluate

__all__ = ["Solid", "loft_solid"]

_BUILD = BRep_Builder()


@dataclass(frozen=True)
class Solid:
    """A solid of the CAD kernel; what is inside concerns `sketchloft.brep` only."""

    shape: TopoDS_Solid


def loft_solid(surface: SkinSurface) -> Solid:
    """Close a skin with planar caps and make a solid of it.

    Parameters
    ----------
    surface : SkinSurface
        Its first and last sections are planar; best about 1 across, see Notes.

    Returns
    -------
    Solid
        One closed shell, normals outwards: two planar caps, and between them one face, or one for each
        part of the skin that its sharp edges bound, across (at a kink of the wall) or along (at a corner
        of the sections).

    Raises
    ------
    ModelError
        If an end section is not planar or encloses no area.

    Notes
    -----
    Nothing is sewn: neighbouring faces are built on the same edges, and a cap on the same curves as the
    sides. The kernel's tolerance is absolute (1e-7), so build a skin in a frame in which it is about 1
    across, and place the solid afterwards (`placed`).
    """
    grid = cut(surface if _winds_left(surface) else _mirrored(surface))
    edges = loft_edges(grid)
    sides = [
        _side(grid, edges, band, list(ends))
        for band, columns in enumerate(grid.columns)
        for ends in pairwise(columns)
    ]
    bottom, top = list(edges.around[0].values()), list(edges.around[-1].values())
    first, last = grid.skin.poles[[0, -1]]
    return Solid(solid_of([*sides, _cap(first, turned_around(bottom), "first"), _cap(last, top, "last")]))


def _winds_left(surface: SkinSurface) -> bool:
    """Whether the sections turn counter-clockwise seen against v, so that the normals point outwards."""
    u = np.linspace(surface.u_knots[0], surface.u_knots[-1], 4 * surface.poles.shape[1])
    rings = evaluate(surface, u, np.linspace(surface.v_knots[0], surface.v_knots[-1], 9))
    centres = rings[:, :-1].mean(axis=1)
    spokes = rings - centres[:, None]
    areas = np.cross(spokes[:, :-1], spokes[:, 1:]).sum(axis=1) / 2
    volume = np.einsum("ij,ij->", (areas[:-1] + areas[1:]) / 2, np.diff(centres, axis=0))
    return bool(volume > 0)


def _mirrored(surface: SkinSurface) -> SkinSurface:
    """Let the skin run around the other way."""
    knots = surface.u_knots[0] + surface.u_knots[-1] - surface.u_knots[::-1]
    weights = None if surface.weights is None else surface.weights[:, ::-1]
    return replace(surface, poles=surface.poles[:, ::-1], u_knots=knots, weights=weights)


def _side(grid: PatchGrid, edges: LoftEdges, band: int, columns: list[int]) -> TopoDS_Face:
    """Make the face of one patch; its neighbours above and below may have more corners than it has."""
    start, end = columns
    skin = part(grid.skin, (grid.rows[band], grid.rows[band + 1]), (start, end))
    face = TopoDS_Face()
    _BUILD.MakeFace(face, bspline_surface(skin), CONFUSION)
    u0, u1, v0, v1 = (float(at) for at in (*skin.u_knots[[0, -1]], *skin.v_knots[[0, -1]]))
    bottom = [edge for column, edge in edges.around[band].items() if start <= column < end]
    top = [edge for column, edge in edges.around[band + 1].items() if start <= column < end]
    left, right = edges.along[band][start], edges.along[band][end]
    across, up = gp_Dir2d(1, 0), gp_Dir2d(0, 1)
    for edge in bottom:
        _BUILD.UpdateEdge(edge, Geom2d_Line(gp_Pnt2d(0, v0), across), face, CONFUSION)
    for edge in top:
        _BUILD.UpdateEdge(edge, Geom2d_Line(gp_Pnt2d(0, v1), across), face, CONFUSION)
    at_left, at_right = Geom2d_Line(gp_Pnt2d(u0, 0), up), Geom2d_Line(gp_Pnt2d(u1, 0), up)
    if left.IsSame(right):  # the seam: its forward use bounds the face on the right
        _BUILD.UpdateEdge(left, at_right, at_left, face, CONFUSION)
    else:
        _BUILD.UpdateEdge(left, at_left, face, CONFUSION)
        _BUILD.UpdateEdge(right, at_right, face, CONFUSION)
    _BUILD.Add(face, wire([*bottom, right, *turned_around(top), left.Reversed()]))
    return face


def _cap(section: Floats, edges: Sequence[TopoDS_Shape], which: str) -> TopoDS_Face:
    """Make the planar face that the edges bound, counter-clockwise about its normal."""
    centre = section[:-1].mean(axis=0)
    spokes = section - centre
    area = np.cross(spokes[:-1], spokes[1:]).sum(axis=0) / 2
    size = float(np.linalg.norm(np.ptp(section, axis=0)))
    if float(np.linalg.norm(area)) < 1e-9 * size**2 or size < 10 * CONFUSION:
        raise ModelError(
            f"the {which} section is {size:.2g} across and encloses no area, so it cannot be capped; "
            "leave this slice out"
        )
    normal = (area if which == "last" else -area) / np.linalg.norm(area)
    off_plane = float(np.abs(spokes @ normal).max())
    if off_plane > CONFUSION:
        raise ModelError(
            f"the {which} section leaves its plane by {off_plane:.2g} of a size of {size:.2g}, so a planar "
            "cap cannot close it; project it onto its plane first"
        )
    return planar_face(Geom_Plane(point(centre), direction(normal)), [edges])
