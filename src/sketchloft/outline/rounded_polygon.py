"""RoundedPolygon: a free polygon with the same fillet at each corner."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar, Self, TypeVar

import numpy as np
from numpy.typing import NDArray

from sketchloft.cloud import Floats
from sketchloft.outline.chain import chords
from sketchloft.outline.chain_outline import ChainOutline
from sketchloft.ring import following

__all__ = ["RoundedPolygon"]

T = TypeVar("T", np.float64, np.complex128)

COMPLEX_STEP = 1e-30


@dataclass(frozen=True)
class RoundedPolygon(ChainOutline):
    """A simple polygon with the same fillet at each corner, convex or not.

    Parameters
    ----------
    vertices : (m, 2) float array
        Counter-clockwise; where the edges would meet without fillets.
    radius : float
        Of the fillets; taken down to the largest that fits where it is larger.
    """

    kind: ClassVar[str] = "rounded polygon"

    vertices: Floats
    radius: float

    @property
    def vector(self) -> Floats:
        """Vertices, then the radius: (2m + 1,)."""
        return np.append(self.vertices, self.radius)

    def moved(self, vector: Floats) -> Self:
        """Return the polygon with other parameters, the radius within what fits."""
        vertices = vector[:-1].reshape(-1, 2).copy()
        return replace(self, vertices=vertices, radius=_fitting(vertices, float(vector[-1])))

    def chain(self) -> tuple[Floats, Floats]:
        """Ends of the fillets, and their bulges between lines."""
        ends, bulges = _filleted(self.vertices, np.asarray(_fitting(self.vertices, self.radius)))
        return ends, bulges

    def by_vector(self, gradient: Floats) -> Floats:
        """Apply the derivative of the fillets' ends and bulges, taken by a complex step.

        References
        ----------
        W. Squire, G. Trapp, "Using complex variables to estimate derivatives of real functions",
        SIAM Rev. 40, 1998.
        """
        count = self.vertices.size
        step = 1j * COMPLEX_STEP * np.eye(count + 1)
        vertices = self.vertices + step[:, :count].reshape(-1, *self.vertices.shape)
        radius = _fitting(self.vertices, self.radius) + step[:, count]
        ends, bulges = _filleted(vertices, radius)
        moves = np.concatenate([ends.reshape(count + 1, -1), bulges], axis=1).imag / COMPLEX_STEP
        return gradient @ moves.T


def _fitting(vertices: Floats, radius: float) -> float:
    """Radius taken down to the largest with which no two fillets overlap."""
    *_, tangent = _corners(vertices)
    needed = np.abs(tangent) + np.abs(following(tangent))
    length = np.linalg.norm(chords(vertices), axis=1)
    return float(np.clip(radius, 0.0, (length / np.maximum(needed, 1e-300)).min()))


def _corners(vertices: NDArray[T]) -> tuple[NDArray[T], NDArray[T], NDArray[T]]:
    """Unit edges into and out of vertices (..., m, 2), and the tangents of half the turns; analytic."""
    along = np.roll(vertices, -1, axis=-2) - vertices
    leaving = along / np.sqrt((along * along).sum(axis=-1, keepdims=True))
    coming = np.roll(leaving, 1, axis=-2)
    cross = coming[..., 0] * leaving[..., 1] - coming[..., 1] * leaving[..., 0]
    return coming, leaving, cross / (1 + (coming * leaving).sum(axis=-1))


def _filleted(vertices: NDArray[T], radius: NDArray[T]) -> tuple[NDArray[T], NDArray[T]]:
    """Vertices (..., 2m, 2) and bulges (..., 2m) of a chain with fillets of a radius (...)."""
    coming, leaving, tangent = _corners(vertices)
    reach = (radius[..., None] * tangent * np.where(tangent.real < 0, -1.0, 1.0))[..., None]
    ends = np.stack([vertices - reach * coming, vertices + reach * leaving], axis=-2)
    bulge = tangent / (1 + np.sqrt(1 + tangent * tangent))
    bulges = np.stack([bulge, np.zeros_like(bulge)], axis=-1)
    return ends.reshape(*vertices.shape[:-2], -1, 2), bulges.reshape(*vertices.shape[:-2], -1)
