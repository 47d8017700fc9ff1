"""Swept: a wall whose outline moves along the axis: it may drift, taper, twist, and close like a dome."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal, Self

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.gauss import gauss
from sketchloft.outline.outline import Outline
from sketchloft.wall.dome import dome_foot
from sketchloft.wall.foot import WallBoundary, WallFoot, spread

__all__ = ["MOVEMENTS", "Freedom", "Swept"]

Freedom = Literal["drift", "taper", "twist", "bow", "height"]
MOVEMENTS: tuple[Freedom, ...] = ("drift", "taper", "twist", "bow")
GAUSS = gauss(6)
LEAST_SQUARE = 1e-4
"""The outline is looked at from no farther than its size at this squared scale."""


@dataclass(frozen=True)
class Swept:
    """An outline carried along z.

    Parameters
    ----------
    outline : Outline
        At `height`.
    height : float
        A parameter only where another wall has the same outline and this one begins to move away from it.
    pivot : (2,) float array
        Point that taper and twist are about; fixed, but for one at the centre of an outline that has one,
        which stays there as long as drift is not free: else the sections would drift as they grow.
    drift : (2,) float array
        Sideways movement per height.
    taper : float
        Relative growth per height.
    twist : float
        Turn per height in radians; none where the wall bows.
    free : tuple of {"drift", "taper", "twist", "bow", "height"}
        Which of these are parameters; the others stay what they are.
    bow : float
        Per height; the squared scale is ``(1 + taper dz)**2 - (bow dz)**2``, so that the sections shrink as
        the chords of an ellipse do.
    """

    outline: Outline
    height: float
    pivot: Floats
    drift: Floats
    taper: float = 0.0
    twist: float = 0.0
    free: tuple[Freedom, ...] = ()
    bow: float = 0.0

    @property
    def kind(self) -> str:
        """The outline's kind, and how it moves."""
        moves = [name for name in MOVEMENTS if np.any(getattr(self, name))]
        if "bow" in moves:
            moves = [name for name in moves if name != "taper"]
        words = {"drift": "slanted", "taper": "tapered", "twist": "twisted", "bow": "domed"}
        return " ".join([*(words[name] for name in moves), self.outline.kind])

    @property
    def vector(self) -> Floats:
        """The outline's parameters, then those of the free movements."""
        return np.concatenate(
            [self.outline.vector, *(np.atleast_1d(getattr(self, name)) for name in self.free)]
        )

    def moved(self, vector: Floats) -> Self:
        """Return the wall with other parameters."""
        at = len(self.outline.vector)
        changes: dict[str, object] = {}
        for name in self.free:
            if name == "drift":
                changes[name] = vector[at : at + 2].copy()
                at += 2
            else:
                changes[name] = float(vector[at])
                at += 1
        outline = self.outline.moved(vector[: len(self.outline.vector)])
        if self.centred:
            changes["pivot"] = centre_of(outline)
        return replace(self, outline=outline, **changes)  # type: ignore[arg-type]

    def about_centre(self) -> Self:
        """Return the wall with its pivot at the centre of its outline, if that has one and nothing drifts."""
        centre = centre_of(self.outline)
        drifts = "drift" in self.free or np.any(self.drift)
        return self if centre is None or drifts else replace(self, pivot=centre)

    @property
    def centred(self) -> bool:
        """Whether the pivot is the centre of the outline, and goes with it."""
        return "drift" not in self.free and np.array_equal(centre_of(self.outline), self.pivot)  # type: ignore[arg-type]

    @property
    def moves(self) -> tuple[Freedom, ...]:
        """Which movements are parameters."""
        return tuple(name for name in self.free if name != "height")

    def moving(self, *moves: Freedom) -> Self:
        """Return the wall with other movements as parameters; its height stays one if it is."""
        return replace(self, free=(*moves, *(name for name in self.free if name == "height")))

    @property
    def bows(self) -> bool:
        """Whether the sections shrink as those of a dome do."""
        return bool(self.bow) or "bow" in self.free

    @property
    def still(self) -> bool:
        """Whether all sections are the same, one above the other."""
        return not (self.bows or self.taper or self.twist or np.any(self.drift))

    def square(self, heights: Floats) -> Floats:
        """Squared scale of the sections at heights (m,), 1 at the outline's; below 0 beyond a tip."""
        dz = heights - self.height
        return (1 + self.taper * dz) ** 2 - (self.bow * dz) ** 2

    def scale(self, heights: Floats) -> Floats:
        """Scale of the sections at heights (m,); 0 or less beyond a tip."""
        if self.bows:
            return np.sqrt(np.maximum(self.square(heights), 0.0))
        return 1 + self.taper * (heights - self.height)

    def _rise(self, heights: Floats) -> Floats:
        """Half the slope of the squared scale at heights (m,)."""
        dz = heights - self.height
        return self.taper * (1 + self.taper * dz) - self.bow**2 * dz

    def tips(self) -> tuple[float, float]:
        """Heights between which there are sections, where the wall comes down to a point; else infinite."""
        if not self.bows:
            tip = self.height - 1 / self.taper if self.taper else np.inf
            return (-np.inf, tip) if self.taper <= 0 else (tip, np.inf)
        if abs(self.bow) <= abs(self.taper):  # no ellipse
            return -np.inf, np.inf
        ends = [self.height - 1 / slope for slope in (self.taper + self.bow, self.taper - self.bow)]
        return min(ends), max(ends)

    def area(self, heights: Floats) -> Floats:
        """Area of the sections at heights (m,)."""
        return self.outline.area * (self.square(heights) if self.bows else self.scale(heights) ** 2)

    def foot(self, points: Floats) -> WallFoot:
        """Signed distance of points (n, 3), and its derivatives."""
        if self.bows:
            return self._dome(points)
        if self.still and not self.free:
            seen = self.outline.foot(points[:, :2])
            normal = np.zeros((3, len(points))).T  # each coordinate in one piece
            normal[:, :2] = seen.normal
            return WallFoot(seen.distance, normal, seen.slopes, seen.curvature)
        dz = points[:, 2] - self.height
        scale = np.maximum(1 + self.taper * dz, 1e-6)
        cos, sin = np.cos(self.twist * dz), np.sin(self.twist * dz)
        moved = points[:, :2] - self.pivot - dz[:, None] * self.drift
        arm = _turned(moved, cos, -sin) / scale[:, None]
        seen = self.outline.foot(self.pivot + arm)
        across = _turned(seen.normal, cos, sin)
        quarter = np.column_stack([-arm[:, 1], arm[:, 0]])
        along_arm = np.einsum("ij,ij->i", seen.normal, arm)
        along_quarter = np.einsum("ij,ij->i", seen.normal, quarter)
        slope = (
            -across @ self.drift
            + self.taper * (seen.distance - along_arm)
            - self.twist * scale * along_quarter
        )
        c = 1 / np.hypot(1.0, slope)
        normal = np.column_stack([across, slope]) * c[:, None]

        def slopes() -> Floats:
            columns = [(c * scale)[:, None] * seen.gradient]
            if self.centred:
                columns[0][:, :2] = -c[:, None] * across
            for name in self.free:
                if name == "drift":
                    columns.append(-(c * dz)[:, None] * across)
                elif name == "taper":
                    columns.append((c * dz * (seen.distance - along_arm))[:, None])
                elif name == "height":
                    columns.append(-normal[:, 2:])
                else:
                    columns.append(-(c * scale * dz * along_quarter)[:, None])
            return np.concatenate(columns, axis=1)

        return WallFoot(c * scale * seen.distance, normal, slopes, c * seen.curvature / scale)

    def _dome(self, points: Floats) -> WallFoot:
        dz = points[:, 2] - self.height
        square, rise = self.square(points[:, 2]), self._rise(points[:, 2])
        moved = points[:, :2] - self.pivot - dz[:, None] * self.drift
        arm = moved / np.sqrt(np.maximum(square, LEAST_SQUARE))[:, None]
        seen = self.outline.foot(self.pivot + arm)
        bend = self.taper**2 - self.bow**2
        found = dome_foot(moved, seen, arm, (square, rise, bend), self.drift)

        def slopes() -> Floats:
            by = {
                "drift": dz[:, None] * found.by_shift,
                "taper": (2 * dz * (1 + self.taper * dz) * found.by_square)[:, None],
                "bow": (-2 * self.bow * dz**2 * found.by_square)[:, None],
                "height": -found.normal[:, 2:],
            }
            columns = [found.by_outline[:, None] * seen.gradient, *(by[name] for name in self.free)]
            if self.centred:
                columns[0][:, :2] = found.by_shift
            return np.concatenate(columns, axis=1)

        return WallFoot(found.distance, found.normal, slopes, found.curvature)

    def carried(self, points: Floats, heights: Floats) -> Floats:
        """Places (m, k, 2) where points (k, 2) of the outline lie at heights (m,)."""
        dz = (heights - self.height)[:, None]
        cos, sin = np.cos(self.twist * dz), np.sin(self.twist * dz)
        arm = _turned(points - self.pivot, cos, sin)
        return self.pivot + dz[..., None] * self.drift + self.scale(heights)[:, None, None] * arm

    def boundary(self, low: float, high: float, count: int) -> WallBoundary:
        """About `count` points on the wall between two heights."""
        z, weights = self._heights(low, high)
        ring = self.outline.boundary(max(24, count // len(z)))
        if self.still:
            rim = self.pivot + (ring.points - self.pivot)
            return spread(rim, z, ring.normals, np.zeros((1, 1)), weights[:, None] * ring.lengths)
        dz = (z - self.height)[:, None]
        scale = self.scale(z)[:, None]
        growth = self.taper * np.ones_like(scale)
        if self.bows:
            growth = self._rise(z)[:, None] / np.maximum(scale, 1e-9)
        cos, sin = np.cos(self.twist * dz), np.sin(self.twist * dz)
        arm = ring.points - self.pivot
        xy = self.carried(ring.points, z)
        flat = _turned(ring.normals, cos, sin)
        quarter = np.stack([-arm[:, 1], arm[:, 0]], axis=1)
        slope = (
            -flat @ self.drift
            - growth * np.einsum("ij,ij->i", ring.normals, arm)
            - self.twist * scale * np.einsum("ij,ij->i", ring.normals, quarter)
        )
        areas = weights[:, None] * ring.lengths * scale * np.hypot(1.0, slope)
        return spread(xy, z, flat, slope, areas)

    def _heights(self, low: float, high: float) -> tuple[Floats, Floats]:
        """Gauss points and weights along z; on a dome in the angle of its ellipse, for its tips' sake."""
        x, w = GAUSS
        below, above = self.tips()
        if not (self.bows and np.isfinite([below, above]).all()):
            return (low + high) / 2 + (high - low) / 2 * x, w * (high - low) / 2
        middle, radius = (below + above) / 2, (above - below) / 2
        ends = np.arcsin(np.clip((np.array([low, high]) - middle) / radius, -1, 1))
        half = (ends[1] - ends[0]) / 2
        angle = ends.mean() + half * x
        return middle + radius * np.sin(angle), w * half * radius * np.cos(angle)


def centre_of(outline: Outline) -> Floats | None:
    """(2,) centre of an outline that is placed by one, with its first two parameters; else None."""
    return getattr(outline, "centre", None)


def _turned(vectors: Floats, cos: Floats, sin: Floats) -> Floats:
    """Vectors (..., 2) turned."""
    x, y = vectors[..., 0], vectors[..., 1]
    turned = np.empty((*np.broadcast_shapes(x.shape, cos.shape), 2))
    turned[..., 0], turned[..., 1] = x * cos - y * sin, x * sin + y * cos
    return turned
