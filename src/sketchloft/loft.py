"""Stage 7: loft the sections to one B-spline surface (paper, sections 3.4 and 4.7)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.shapes.recognise import Shape
from sketchloft.surface import SkinSurface, basis_matrix

__all__ = ["LoftParams", "Section", "loft"]

Between = Literal["straight", "smooth"]

DEGREE = 3
SAMPLES = 256
"""Parameters around at which sections are compared to find the start without twist."""
PER_SPAN = 4
"""Points per knot span that a section is carried over to the common knots with."""


@dataclass(frozen=True)
class LoftParams:
    """How sections are joined.

    Parameters
    ----------
    between : {"straight", "smooth"}
        Straight lines between neighbouring sections (the paper's equation 3), which never overshoot,
        or a cubic spline through all sections.
    spans : int
        Knot spans around that all sections share; a multiple of 4.
    """

    between: Between = "straight"
    spans: int = 64


@dataclass(frozen=True)
class Section:
    """A shape on its slice plane.

    Parameters
    ----------
    height : float
    shape : Shape
    borrowed : bool
        Whether the shape is that of the neighbouring section, because its own could not be lofted.
    """

    height: float
    shape: Shape
    borrowed: bool = False


def loft(sections: Sequence[Section], params: LoftParams) -> SkinSurface:
    """Skin the sections.

    Parameters
    ----------
    sections : sequence of Section
        At least two, by rising height.
    params : LoftParams

    Returns
    -------
    SkinSurface
        In the frame of the slicing direction. Its u parameter goes once around, its v parameter is
        the height as a share of the whole.

    Notes
    -----
    All sections are brought to the same parameter first: starting from one with corners, each
    neighbour is turned to where the sum of squared distances between points of equal parameter is
    least. Sections are then carried over to common knots around; knots of full multiplicity keep
    corners sharp where any section has them.
    """
    starts = _starts([section.shape for section in sections])
    knots, design = _common_knots(params.spans, any(section.shape.corners for section in sections))
    t = (np.arange(len(design)) + 0.5) / len(design)
    rings = np.stack([s.shape.evaluate(t + start) for s, start in zip(sections, starts, strict=True)], axis=1)
    poles = np.linalg.solve(design.T @ design, design.T @ rings.reshape(len(t), -1)).reshape(
        -1, len(sections), 2
    )
    poles = np.moveaxis(np.r_[poles, poles[:1]], 1, 0)
    heights = np.array([section.height for section in sections])
    rows = np.concatenate([poles, np.broadcast_to(heights[:, None, None], (*poles.shape[:2], 1))], axis=2)
    along = (heights - heights[0]) / (heights[-1] - heights[0])
    if params.between == "straight" or len(sections) < 4:
        return SkinSurface(rows, knots, np.r_[0.0, along, 1.0], DEGREE, 1)
    v_knots = np.r_[np.zeros(4), along[2:-2], np.ones(4)]
    through = np.linalg.solve(basis_matrix(v_knots, DEGREE, along), rows.reshape(len(rows), -1))
    return SkinSurface(through.reshape(rows.shape), knots, v_knots, DEGREE, DEGREE)


def _common_knots(spans: int, corners: bool) -> tuple[Floats, Floats]:
    """Clamped knots around, and the values of the basis functions with the seam's two poles as one."""
    inner = np.arange(1, spans) / spans
    if corners:
        quarters = np.array([0.25, 0.5, 0.75])
        inner = np.sort(np.r_[inner, np.repeat(quarters, DEGREE - 1)])
    knots = np.r_[np.zeros(DEGREE + 1), inner, np.ones(DEGREE + 1)]
    t = (np.arange(PER_SPAN * spans) + 0.5) / (PER_SPAN * spans)
    basis = basis_matrix(knots, DEGREE, t)
    basis[:, 0] += basis[:, -1]
    return knots, basis[:, :-1]


def _starts(shapes: Sequence[Shape]) -> Floats:
    """Parameter at which each section starts so that the loft does not twist."""
    t = np.arange(SAMPLES) / SAMPLES
    rings = np.array([(shape.evaluate(t) - shape.evaluate(t).mean(axis=0)) @ [1, 1j] for shape in shapes])
    anchor = int(np.argmax([shape.corners for shape in shapes]))
    starts = np.zeros(len(shapes))
    previous = rings[anchor]
    for i in [*range(anchor - 1, -1, -1), *range(anchor + 1, len(shapes))]:
        if i == anchor + 1:
            previous = rings[anchor]
        starts[i] = _best_start(rings[i], previous, shapes[i].corners)
        centred = shapes[i].evaluate(t + starts[i])
        previous = (centred - centred.mean(axis=0)) @ [1, 1j]
    return starts


def _best_start(ring: np.ndarray, previous: np.ndarray, corners: int) -> float:
    """Start at which a ring lies closest to the previous one; at a corner where it has any."""
    spectrum = np.fft.fft(ring) * np.conj(np.fft.fft(previous))
    likeness = np.fft.ifft(spectrum).real
    if corners:
        step = SAMPLES // corners
        return float(np.argmax(likeness[::step])) / corners
    top = int(np.argmax(likeness))
    before, at, after = likeness[top - 1], likeness[top], likeness[(top + 1) % SAMPLES]
    bend = before - 2 * at + after
    return float((top + (0.5 * (before - after) / bend if bend < 0 else 0.0)) / SAMPLES)
