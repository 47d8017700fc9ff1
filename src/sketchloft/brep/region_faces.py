"""Level faces put together of pieces of rims."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from OCP.Geom import Geom_Plane
from OCP.gp import gp_Ax3, gp_Dir
from OCP.TopoDS import TopoDS_Edge, TopoDS_Face

from sketchloft.brep.kernel import point
from sketchloft.brep.planar_curve import PlanarCurve
from sketchloft.brep.shell_parts import planar_face
from sketchloft.cloud import Floats
from sketchloft.errors import ModelError

__all__ = ["Walk", "region_faces"]


@dataclass(frozen=True)
class Walk:
    """A piece of a rim walked so that the region is on the left, seen from above.

    Parameters
    ----------
    edge : TopoDS_Edge
        In the sense of the walk.
    curve : PlanarCurve
    start, end : float
        Parameters on the curve; the end is the lesser one when it is walked against its sense.
    nodes : (int, int)
        From and to.
    """

    edge: TopoDS_Edge
    curve: PlanarCurve
    start: float
    end: float
    nodes: tuple[int, int]

    def leaving(self) -> float:
        """Angle of the direction at its start."""
        return self._angle(self.start)

    def arriving(self) -> float:
        """Angle of the direction at its end."""
        return self._angle(self.end)

    def _angle(self, at: float) -> float:
        x, y = np.sign(self.end - self.start) * self.curve.at(np.array([at]), 1)[0]
        return float(np.arctan2(y, x))

    def swept_area(self, origin: Floats) -> float:
        """Area that the ray from an origin sweeps on the way."""
        low, high = min(self.start, self.end), max(self.start, self.end)
        area = self.curve.swept_area(low, high, origin)
        return area if self.end > self.start else -area

    def box(self) -> Floats:
        """Least and greatest coordinates (2, 2), about."""
        points = self.curve.at(np.linspace(self.start, self.end, 33))
        return np.array([points.min(axis=0), points.max(axis=0)])


def region_faces(walks: Sequence[Walk], height: float) -> list[TopoDS_Face]:
    """The level faces, normals upwards, of the region to the left of all walks."""
    loops = _loops(walks)
    areas = [_area(loop) for loop in loops]
    boxes = [_box(loop) for loop in loops]
    outer = [i for i, area in enumerate(areas) if area > 0]
    holes: dict[int, list[int]] = {i: [] for i in outer}
    for i, area in enumerate(areas):
        if area <= 0:
            # Loops do not cross, so the least loop around a hole is the one that it is in.
            around = [j for j in outer if areas[j] > -area and _is_within(boxes[i], boxes[j])]
            if not (around or outer):
                raise ModelError("a ledge has no outer rim; make the sections at the break clearly different")
            holes[min(around or outer, key=lambda j: areas[j])].append(i)
    plane = Geom_Plane(gp_Ax3(point((0, 0, height)), gp_Dir(0, 0, 1)))
    return [
        planar_face(plane, [[walk.edge for walk in loops[j]] for j in (i, *inner)])
        for i, inner in holes.items()
    ]


def _loops(walks: Sequence[Walk]) -> list[list[Walk]]:
    """Walks joined end to start; where several start, on by the sharpest turn to the left."""
    leaving: dict[int, list[int]] = defaultdict(list)
    for i, walk in enumerate(walks):
        leaving[walk.nodes[0]].append(i)
    left, loops = set(range(len(walks))), []
    for i, first in enumerate(walks):
        if i not in left:
            continue
        left.remove(i)
        loop = [first]
        while loop[-1].nodes[1] != first.nodes[0]:
            found = [j for j in leaving[loop[-1].nodes[1]] if j in left]
            if not found:
                raise ModelError("a ledge does not close; make the sections at the break clearly different")
            j = max(found, key=lambda k: _turn(loop[-1], walks[k]))
            left.remove(j)
            loop.append(walks[j])
        loops.append(loop)
    return loops


def _turn(before: Walk, after: Walk) -> float:
    """Turn to the left between two walks, from minus half a turn to half a turn."""
    return float(np.mod(after.leaving() - before.arriving() + np.pi, 2 * np.pi))


def _area(loop: Sequence[Walk]) -> float:
    origin = loop[0].curve.at(np.array([loop[0].start]))[0]
    return sum(walk.swept_area(origin) for walk in loop)


def _box(loop: Sequence[Walk]) -> Floats:
    boxes = np.array([walk.box() for walk in loop])
    return np.array([boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)])


def _is_within(inner: Floats, outer: Floats) -> bool:
    slack = 0.01 * np.ptp(outer, axis=0)
    return bool((inner[0] >= outer[0] - slack).all() and (inner[1] <= outer[1] + slack).all())
