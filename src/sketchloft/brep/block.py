"""Block: the faces of one or more runs, apart from those that close it."""

from __future__ import annotations

from dataclasses import dataclass

from OCP.TopoDS import TopoDS_Face

__all__ = ["Block"]


@dataclass(frozen=True)
class Block:
    """Part of a stack between two breaks.

    Parameters
    ----------
    walls : list of TopoDS_Face
        Normals outwards; ledges at breaks within the block are among them.
    bottom, top : list of TopoDS_Face
        Level faces that would close it, normals outwards.
    """

    walls: list[TopoDS_Face]
    bottom: list[TopoDS_Face]
    top: list[TopoDS_Face]
