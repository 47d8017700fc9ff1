"""The vertices and edges that the faces of a loft share."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

from OCP.TopoDS import TopoDS_Edge, TopoDS_Vertex

from sketchloft.brep.kernel import bspline_curve
from sketchloft.brep.patches import PatchGrid, part
from sketchloft.brep.shell_parts import CurvePart, edge, vertex
from sketchloft.surface import SkinSurface

__all__ = ["LoftEdges", "loft_edges"]


@dataclass(frozen=True)
class LoftEdges:
    """Edges of a loft.

    Parameters
    ----------
    around : list of dict of int to TopoDS_Edge
        Per boundary of a band the edges along its section by the column that each begins at, in the
        sense of growing u.
    along : list of dict of int to TopoDS_Edge
        Per band the edges from its lower to its upper section, by their column; the last column is the first.
    """

    around: list[dict[int, TopoDS_Edge]]
    along: list[dict[int, TopoDS_Edge]]


def loft_edges(grid: PatchGrid) -> LoftEdges:
    """Make the edges around and between the patches."""
    corners, around, along = [], [], []
    for i, row in enumerate(grid.rows):
        columns = sorted(set().union(*grid.columns[max(i - 1, 0) : i + 1]))
        vertices = {column: vertex(grid.skin.poles[row, column]) for column in columns[:-1]}
        corners.append(vertices | {columns[-1]: vertices[columns[0]]})
        pairs = pairwise(columns)
        around.append({a: _around(grid.skin, row, (a, b), corners[i]) for a, b in pairs})
    for i, columns in enumerate(grid.columns):
        rows = (grid.rows[i], grid.rows[i + 1])
        edges = {column: _along(grid.skin, rows, column, corners[i : i + 2]) for column in columns[:-1]}
        along.append(edges | {columns[-1]: edges[columns[0]]})
    return LoftEdges(around, along)


def _around(
    skin: SkinSurface, row: int, columns: tuple[int, int], corner: dict[int, TopoDS_Vertex]
) -> TopoDS_Edge:
    piece = part(skin, (0, len(skin.poles) - 1), columns)
    weights = None if piece.weights is None else piece.weights[row]
    curve = bspline_curve(piece.poles[row], weights, piece.u_knots, piece.u_degree)
    ends = CurvePart(curve, float(piece.u_knots[0]), float(piece.u_knots[-1]))
    return edge(ends, corner[columns[0]], corner[columns[1]])


def _along(
    skin: SkinSurface, rows: tuple[int, int], column: int, corners: list[dict[int, TopoDS_Vertex]]
) -> TopoDS_Edge:
    piece = part(skin, rows, (0, skin.poles.shape[1] - 1))
    weights = None if piece.weights is None else piece.weights[:, column]
    curve = bspline_curve(piece.poles[:, column], weights, piece.v_knots, piece.v_degree)
    ends = CurvePart(curve, float(piece.v_knots[0]), float(piece.v_knots[-1]))
    return edge(ends, corners[0][column], corners[1][column])
