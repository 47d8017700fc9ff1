"""Evidence: what each slice of a model rests on, and how well its shape fits it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from sketchloft.pipeline import BodyModel
from sketchloft.shapes.recognise import Shape

__all__ = ["SliceEvidence", "diagonal", "slice_evidence", "total_rms"]


@dataclass(frozen=True)
class SliceEvidence:
    """One slice in figures. Lengths are in the unit of the cloud.

    Parameters
    ----------
    index : int
    height : float
        In the body's frame.
    is_key : bool
        Whether its plane lies at an end, an extremum or a step.
    points, edge_points, left_out : int
        Worked points, edge points, and contours other than the outer one.
    probe_radius : float
    shape : Shape
    rms : float
        Root of the mean square distance of the edge points from the shape.
    mean : float
        Their mean signed distance, negative inside. Shapes lie outside their edge points on purpose: these
        are the outermost points that were drawn, and the wall lies a gap beyond.
    """

    index: int
    height: float
    is_key: bool
    points: int
    edge_points: int
    left_out: int
    probe_radius: float
    shape: Shape
    rms: float
    mean: float

    @property
    def scatter(self) -> float:
        """Standard deviation of the distances: what is left of `rms` without the mean."""
        return float(np.sqrt(max(self.rms**2 - self.mean**2, 0.0)))


def slice_evidence(body: BodyModel) -> tuple[SliceEvidence, ...]:
    """Evidence of every slice of a body, by rising height."""
    found = []
    for i, (worked, edge, section) in enumerate(zip(body.worked, body.edges, body.sections, strict=True)):
        distance = section.shape.distance(edge.points)
        found.append(
            SliceEvidence(
                i,
                edge.height,
                bool(np.isin(edge.height, body.planes.key_heights)),
                len(worked.points),
                len(edge.points),
                edge.left_out,
                edge.probe_radius,
                section.shape,
                float(np.sqrt(np.square(distance).mean())),
                float(distance.mean()),
            )
        )
    return tuple(found)


def total_rms(slices: tuple[SliceEvidence, ...]) -> float:
    """Root of the mean square distance of all edge points from their shapes."""
    count = np.array([one.edge_points for one in slices])
    return float(np.sqrt((count * np.square([one.rms for one in slices])).sum() / count.sum()))


def diagonal(body: BodyModel) -> float:
    """Diagonal of the solid's bounding box."""
    return float(np.linalg.norm(body.facts.bounds[1] - body.facts.bounds[0]))
