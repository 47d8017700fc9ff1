"""Clear: whether strokes leave the walls of some runs as sharp as they do right ones."""

from __future__ import annotations

from sketchloft.cloud import Floats
from sketchloft.exact.fit.climb import climb
from sketchloft.exact.fit.likelihood import beside_walls
from sketchloft.exact.model.exact_model import ExactModel

__all__ = ["CLEAR", "clear"]

CLEAR = 0.004
"""Noise, as a share of the size, that a cloud of strokes has at least where its walls are wrong."""
BESIDE = 6.0
"""Noise deviations from the walls within which points tell how sharp these are."""
STEPS = 6


def clear(points: Floats, model: ExactModel, runs: range) -> bool:
    """Whether the noise that suits some runs is that of right walls.

    Parameters
    ----------
    points : (n, 3) float array
        Of strokes.
    model : ExactModel
    runs : range

    Notes
    -----
    Points of strokes lie too unevenly beside the walls for a misfit to show. But walls in the wrong place
    have points far on either side of them, which is what noise looks like.
    """
    low, high = model.stack.breaks[[runs.start, runs.stop]]
    here = points[(points[:, 2] > low) & (points[:, 2] < high)]
    near = here[beside_walls(here, model, BESIDE * model.sigma)]
    return len(near) > 0 and climb(near, model, STEPS, noise=True, runs=runs)[0].sigma < CLEAR
