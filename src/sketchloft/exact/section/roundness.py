"""Roundness: whether points have nothing against a circle, such as corners and flats."""

from __future__ import annotations

import numpy as np

from sketchloft.exact.fit.likelihood import scores
from sketchloft.exact.section.fitted_outline import Loop, section_model
from sketchloft.outline.circle import Circle

__all__ = ["seems_round"]

WAVES = np.arange(2, 13)
ROUND = 4.0
"""Power of a wave around a circle that chance exceeds once in exp(4) times."""
TELLING = 12.0
"""Independent points beside a circle at least, for their scores to tell anything."""


def seems_round(loop: Loop, circle: Circle) -> bool:
    """Whether no wave around a circle would gain anything.

    Parameters
    ----------
    loop : Loop
    circle : Circle
        Fitted to it.

    Notes
    -----
    Each point says by how much the likelihood rises as the circle moves outwards there. Right circles have
    scores whose Fourier coefficients around them are chance, and whose powers over the sum of the squared
    scores are exponential (score test); of points that go together, so many times that. Where points merely
    are, which Rayleigh's test asks, shows corners less clearly.
    """
    points = np.column_stack([loop.near, np.zeros(len(loop.near))])
    near = np.abs(circle.foot(loop.near).distance) < loop.blur
    if near.sum() <= TELLING * loop.together:
        return False
    _, _, outwards = scores(points, section_model(loop, circle), caps=False)[:, :3].T
    arms = loop.near - circle.centre
    angles = np.arctan2(arms[:, 1], arms[:, 0])
    waves = np.exp(1j * WAVES[:, None] * angles)
    powers = np.abs(waves @ outwards) ** 2 / max(float((outwards**2).sum()), np.finfo(float).tiny)
    return bool((powers < ROUND * loop.together).all())
