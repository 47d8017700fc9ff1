"""Ledges: what is left open where one section stands upon another, and the edges that both share."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np
from OCP.BRep import BRep_Builder, BRep_Tool
from OCP.TopoDS import TopoDS, TopoDS_Edge, TopoDS_Face, TopoDS_Vertex

from sketchloft.brep.explore import vertices_of
from sketchloft.brep.overlay import Overlay, Piece, overlay
from sketchloft.brep.region_faces import Walk, region_faces
from sketchloft.brep.rim_edges import corners_of, edge_of, widen
from sketchloft.brep.section_rims import Section, section_of
from sketchloft.errors import ModelError

__all__ = ["Ledges", "ledges"]

_BUILD = BRep_Builder()


@dataclass(frozen=True)
class Ledges:
    """What becomes of two sections at a break.

    Parameters
    ----------
    faces : list of TopoDS_Face
        What is left open, normals out of the solid: upwards where the lower section reaches farther.
    edges : list of (TopoDS_Edge, list of TopoDS_Edge)
        Rims and what replaces them, in the sense of the rim's curve.
    vertices : list of (TopoDS_Vertex, TopoDS_Vertex)
    """

    faces: list[TopoDS_Face]
    edges: list[tuple[TopoDS_Edge, list[TopoDS_Edge]]]
    vertices: list[tuple[TopoDS_Vertex, TopoDS_Vertex]]


def ledges(below: Sequence[TopoDS_Face], above: Sequence[TopoDS_Face], tolerance: float) -> Ledges:
    """Lay the section that ends at a break and the one that starts there upon each other.

    Parameters
    ----------
    below, above : sequence of TopoDS_Face
        Level faces at the same height: the top of the run below and the bottom of the one above.
    tolerance : float
        Distance up to which rims are taken for one.

    Raises
    ------
    ModelError
        If the sections run together in a way that the tolerance leaves ambiguous.

    Notes
    -----
    Only the sections are cut with each other, never the walls, and not by the kernel's general boolean
    operation: where free curves run within a thousandth of each other that fails, or takes for ever.
    """
    height = BRep_Tool.Pnt_s(vertices_of(below[0])[0]).Z()
    lower, upper = section_of(below), section_of(above)
    cut = overlay(lower, upper, tolerance)
    corners, vertices = corners_of(cut, lower, upper, height)
    low = [edge_of(lower.rims[piece.rim], piece, corners) for piece in cut.below]
    twins = _twins(cut, lower, upper)
    high = []
    for i, piece in enumerate(cut.above):
        if i in twins:
            twin, along = twins[i]
            widen(low[twin], max(piece.away, cut.below[twin].away))
            high.append(low[twin] if along else TopoDS.Edge(low[twin].Reversed()))
        else:
            high.append(edge_of(upper.rims[piece.rim], piece, corners))
    back_to_back = {
        (twin, i)
        for i, (twin, along) in twins.items()
        if lower.rims[cut.below[twin].rim].ahead != (upper.rims[cut.above[i].rim].ahead == along)
    }
    walked = _Walked(lower, cut.below, low), _Walked(upper, cut.above, high)
    up = walked[0].outside({twin for twin, _ in back_to_back}) + walked[1].inside()
    down = walked[1].outside({i for _, i in back_to_back}) + walked[0].inside()
    faces = region_faces(up, height)
    faces += [TopoDS.Face(face.Reversed()) for face in region_faces(down, height)]
    return Ledges(faces, walked[0].replaced() + walked[1].replaced(), vertices)


@dataclass(frozen=True)
class _Walked:
    """The pieces of a section with their edges, each in the sense of the rim's curve."""

    section: Section
    pieces: Sequence[Piece]
    edges: Sequence[TopoDS_Edge]

    def outside(self, others: Collection[int]) -> list[Walk]:
        """Walks along what is outside the other section, and some more pieces, the section on the left."""
        return [
            self._walk(i, turned=False)
            for i, piece in enumerate(self.pieces)
            if piece.place == "out" or i in others
        ]

    def inside(self) -> list[Walk]:
        """Walks along what is inside the other section, this one on the right."""
        return [self._walk(i, turned=True) for i, piece in enumerate(self.pieces) if piece.place == "in"]

    def _walk(self, i: int, *, turned: bool) -> Walk:
        piece, edge = self.pieces[i], self.edges[i]
        rim = self.section.rims[piece.rim]
        if rim.ahead != turned:
            return Walk(edge, rim.curve, piece.start, piece.end, piece.nodes)
        back = TopoDS.Edge(edge.Reversed())
        return Walk(back, rim.curve, piece.end, piece.start, piece.nodes[::-1])

    def replaced(self) -> list[tuple[TopoDS_Edge, list[TopoDS_Edge]]]:
        """Rims that are not one piece with an edge of its own, and what replaces them."""
        parts: dict[int, list[TopoDS_Edge]] = defaultdict(list)
        for piece, edge in zip(self.pieces, self.edges, strict=True):
            parts[piece.rim].append(edge)
        rims = [(self.section.rims[rim].edge, found) for rim, found in parts.items()]
        return [(rim, found) for rim, found in rims if not (len(found) == 1 and found[0].IsSame(rim))]


def _twins(cut: Overlay, lower: Section, upper: Section) -> dict[int, tuple[int, bool]]:
    """For each upper piece on a lower one that one's number, and whether their curves run the same way."""
    ons = [i for i, piece in enumerate(cut.above) if piece.place == "on"]
    middles = np.array([(cut.above[i].start + cut.above[i].end) / 2 for i in ons])
    found = {}
    for i, middle in zip(ons, middles, strict=True):
        piece = cut.above[i]
        curve = upper.rims[piece.rim].curve
        feet = lower.feet(curve.at(np.array([middle])))
        rim, at = int(feet.rim[0]), float(feet.at[0])
        for j, other in enumerate(cut.below):
            fits = other.place == "on" and set(other.nodes) == set(piece.nodes)
            if fits and other.rim == rim and other.start < at < other.end:
                slopes = curve.at(np.array([middle]), 1), lower.rims[rim].curve.at(np.array([at]), 1)
                found[i] = (j, float((slopes[0] * slopes[1]).sum()) > 0)
    if not len(found) == len(ons) == sum(piece.place == "on" for piece in cut.below):
        raise ModelError("the sections at the break nearly coincide; make them equal, or clearly different")
    return found
