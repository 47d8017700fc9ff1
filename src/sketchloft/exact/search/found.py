"""Found: where a search ended."""

from __future__ import annotations

from dataclasses import dataclass

from sketchloft.cloud import Floats
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.exact.start.start import Start
from sketchloft.frame import Frame

__all__ = ["Found"]


@dataclass(frozen=True)
class Found:
    """Where a search ended.

    Parameters
    ----------
    start : Start
        Where it began.
    model : ExactModel
        Of all points.
    points : (n, 3) float array
        Those of the start, turned with the direction.
    turn : (3, 3) float array
        The rotation: these points = the start's points @ turn.
    value : float
        What the model is worth.
    misfit : float
        What other walls might gain, about.
    """

    start: Start
    model: ExactModel
    points: Floats
    turn: Floats
    value: float
    misfit: float

    @property
    def frame(self) -> Frame:
        """Of the model, in the axes that the frame of the start is in."""
        return Frame(self.turn.T @ self.start.frame.axes)
