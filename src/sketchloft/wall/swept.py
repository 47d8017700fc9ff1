"""Swept: a wall whose outline moves evenly along the axis: it may drift, taper and twist."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal, Self

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.outline.outline import Outline
from sketchloft.wall.foot import WallBoundary, WallFoot

__all__ = ["Freedom", "Swept"]

Freedom = Literal["drift", "taper", "twist"]
GAUSS = np.polynomial.legendre.leggauss(6)


@dataclass(frozen=True)
class Swept:
    """An outline carried along z.

    Parameters
    ----------
    outline : Outline
        At `height`.
    height : float
    pivot : (2,) float array
        Point that taper and twist are about; fixed.
    drift : (2,) float array
        Sideways movement per height.
    taper : float
        Relative growth per height.
    twist : float
        Turn per height in radians.
    free : tuple of {"drift", "taper", "twist"}
        Which of these are parameters; the others stay what they are.
    """

    outline: Outline
    height: float
    pivot: Floats
    drift: Floats
    taper: float = 0.0
    twist: float = 0.0
    free: tuple[Freedom, ...] = ()

    @property
    def kind(self) -> str:
        """The outline's kind, and how it moves."""
        moves = [name for name in ("drift", "taper", "twist") if np.any(getattr(self, name))]
        words = {"drift": "slanted", "taper": "tapered", "twist": "twisted"}
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
        return replace(self, outline=outline, **changes)  # type: ignore[arg-type]

    def area(self, heights: Floats) -> Floats:
        """Area of the sections at heights (m,)."""
        return self.outline.area * (1 + self.taper * (heights - self.height)) ** 2

    def foot(self, points: Floats) -> WallFoot:
        """Signed distance of points (n, 3), and its derivatives."""
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
        columns = [(c * scale)[:, None] * seen.gradient]
        for name in self.free:
            if name == "drift":
                columns.append(-(c * dz)[:, None] * across)
            elif name == "taper":
                columns.append((c * dz * (seen.distance - along_arm))[:, None])
            else:
                columns.append(-(c * scale * dz * along_quarter)[:, None])
        normal = np.column_stack([across, slope]) * c[:, None]
        return WallFoot(
            c * scale * seen.distance, normal, np.concatenate(columns, axis=1), c * seen.curvature / scale
        )

    def carried(self, points: Floats, heights: Floats) -> Floats:
        """Places (m, k, 2) where points (k, 2) of the outline lie at heights (m,)."""
        dz = (heights - self.height)[:, None]
        cos, sin = np.cos(self.twist * dz), np.sin(self.twist * dz)
        x, y = (points - self.pivot).T
        arm = np.stack([x * cos - y * sin, x * sin + y * cos], axis=2)
        return self.pivot + dz[..., None] * self.drift + (1 + self.taper * dz)[..., None] * arm

    def boundary(self, low: float, high: float, count: int) -> WallBoundary:
        """About `count` points on the wall between two heights."""
        x, w = GAUSS
        z = (low + high) / 2 + (high - low) / 2 * x
        ring = self.outline.boundary(max(24, count // len(z)))
        dz = (z - self.height)[:, None]
        scale = 1 + self.taper * dz
        cos, sin = np.cos(self.twist * dz), np.sin(self.twist * dz)
        arm = ring.points - self.pivot
        xy = self.carried(ring.points, z)
        flat = np.stack(
            [
                ring.normals[:, 0] * cos - ring.normals[:, 1] * sin,
                ring.normals[:, 0] * sin + ring.normals[:, 1] * cos,
            ],
            axis=2,
        )
        quarter = np.stack([-arm[:, 1], arm[:, 0]], axis=1)
        slope = (
            -flat @ self.drift
            - self.taper * np.einsum("ij,ij->i", ring.normals, arm)
            - self.twist * scale * np.einsum("ij,ij->i", ring.normals, quarter)
        )
        steep = np.hypot(1.0, slope)
        points = np.concatenate([xy, np.broadcast_to(z[:, None, None], (*xy.shape[:2], 1))], axis=2)
        normals = np.concatenate([flat, slope[..., None]], axis=2) / steep[..., None]
        areas = (w * (high - low) / 2)[:, None] * ring.lengths * scale * steep
        return WallBoundary(points.reshape(-1, 3), normals.reshape(-1, 3), areas.ravel())


def _turned(vectors: Floats, cos: Floats, sin: Floats) -> Floats:
    return np.column_stack(
        [vectors[:, 0] * cos - vectors[:, 1] * sin, vectors[:, 0] * sin + vectors[:, 1] * cos]
    )
