"""The pieces of a solid: which of its faces hang together."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence

from OCP.BRep import BRep_Tool
from OCP.collections import IndexedMap_TopoDS_Shape_TopTools_ShapeMapHasher
from OCP.TopoDS import TopoDS_Face, TopoDS_Shape

from sketchloft.brep.explore import edges_of, faces_of, vertices_of
from sketchloft.brep.flux import volume_and_area
from sketchloft.brep.shell_parts import solid_of
from sketchloft.errors import ModelError

__all__ = ["check_pieces", "pieces_of"]


def check_pieces(shape: TopoDS_Shape) -> None:
    """Prove that all faces of a closed solid hang together.

    Raises
    ------
    ModelError
        If they do not; the message tells where the least piece is, and whether it is a cavity.
    """
    pieces = pieces_of(faces_of(shape))
    if len(pieces) == 1:
        return
    measured = [(volume_and_area(solid_of(piece))[0], piece) for piece in pieces]
    volume, least = min(measured, key=lambda found: abs(found[0]))
    heights = [BRep_Tool.Pnt_s(corner).Z() for face in least for corner in vertices_of(face)]
    where = f"between the heights {min(heights):.4g} and {max(heights):.4g}"
    if volume < 0:
        raise ModelError(f"{where} there is a closed cavity; let it reach an end, or leave it out")
    raise ModelError(
        f"the stack makes {len(pieces)} pieces that do not hang together, one of them {where}; "
        "model them one by one"
    )


def pieces_of(faces: Sequence[TopoDS_Face]) -> list[list[TopoDS_Face]]:
    """Group faces that are joined by edges, directly or over others."""
    index = IndexedMap_TopoDS_Shape_TopTools_ShapeMapHasher()
    rims = [
        [index.Add(edge) for edge in edges_of(face) if not BRep_Tool.Degenerated_s(edge)] for face in faces
    ]
    along = defaultdict(list)
    for number, edges in enumerate(rims):
        for edge in edges:
            along[edge].append(number)
    pieces, left = [], set(range(len(faces)))
    while left:
        piece, reached = [], [left.pop()]
        while reached:
            number = reached.pop()
            piece.append(faces[number])
            found = {other for edge in rims[number] for other in along[edge]} & left
            left -= found
            reached += found
        pieces.append(piece)
    return pieces
