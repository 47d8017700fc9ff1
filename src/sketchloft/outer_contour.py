"""The outer contour of a 2D alpha shape: one simple, ordered ring of points."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from sketchloft.alpha_shape import AlphaComplex, boundary_facets, components
from sketchloft.cloud import Floats, Ints
from sketchloft.ring import ring_area

__all__ = ["Contour", "outer_contour"]


@dataclass(frozen=True)
class Contour:
    """A closed ring of edge points.

    Parameters
    ----------
    points : (m, 2) float array
        Counter-clockwise, the first point not repeated.
    left_out : int
        How many other rings the alpha shape has: holes and islands.
    share : float
        Share of the slice's points within or on the part that the ring surrounds.
    filled : float
        Share of the area within the ring that the alpha shape fills; the rest are holes.
    """

    points: Floats
    left_out: int
    share: float
    filled: float

    @property
    def area(self) -> float:
        """Area that the ring encloses."""
        return ring_area(self.points)


def outer_contour(shape: AlphaComplex, probe_radius: float) -> Contour | None:
    """Outer ring of the largest part of the alpha shape.

    Parameters
    ----------
    shape : AlphaComplex
        Of points in the plane.
    probe_radius : float
        May be infinite, for the convex hull.

    Returns
    -------
    Contour or None
        None where the probe fits through everywhere, so that nothing is left.
    """
    kept = shape.inside(probe_radius)
    if len(kept) == 0:
        return None
    label = components(shape, kept)
    part = kept[label == 0]
    rings = _rings(boundary_facets(shape, part))
    areas = [ring_area(shape.points[ring]) for ring in rings]
    outer = int(np.argmax(areas))
    filled = float(shape.volumes[part].sum()) / areas[outer]
    held = np.zeros(len(shape.points), dtype=bool)
    held[shape.simplices[part]] = True
    return Contour(shape.points[rings[outer]], len(rings) - 1 + int(label.max()), float(held.mean()), filled)


def _rings(edges: Ints) -> list[Ints]:
    """Chain directed edges (m, 2) to simple rings; a point met twice closes a ring of its own."""
    following: dict[int, list[int]] = {}
    for start, end in edges.tolist():
        following.setdefault(start, []).append(end)
    rings: list[Ints] = []
    while following:
        path = [next(iter(following))]
        place = {path[0]: 0}
        while path[-1] in following:
            ends = following[path[-1]]
            end = ends.pop()
            if not ends:
                del following[path[-1]]
            if end in place:
                ring = path[place[end] :]
                rings.append(np.array(ring, dtype=np.intp))
                for point in ring[1:]:
                    del place[point]
                path = path[: place[end] + 1]
            else:
                place[end] = len(path)
                path.append(end)
    return rings
