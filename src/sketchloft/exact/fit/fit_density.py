"""Fit density: that of the points inside and that of the strays, the walls held still."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.fit.expected import mass_nodes, wall_nodes
from sketchloft.exact.fit.likelihood import share_of
from sketchloft.exact.model.density import Density, regressed
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.exact.model.soundness import sound

__all__ = ["FEWEST", "fit_density"]

FEWEST = 0.5
"""Strays at least."""
STRAY_MOST = 0.06
"""Largest share of strays."""
MOST_CHANGE = 0.5
"""Largest change of the logarithm of the density in one round, lest it run away with a shrinking model."""


def fit_density(points: Floats, model: ExactModel, rounds: int = 3, *, caps: bool = True) -> ExactModel:
    """Fit the density inside and that of the strays to the points (n, 3), the walls held still."""
    if not sound(model):
        return model
    at, volumes = mass_nodes(model, wall_nodes(model))
    count = len(model.density.coefficients)
    terms, nodes = Density.terms(points, count), Density.terms(at, count)
    for _ in range(rounds):
        share = share_of(points, model, caps=caps)
        coefficients = model.density.coefficients.copy()
        mass = max(float(np.exp(np.clip(nodes @ coefficients, -50, 50)) @ volumes), 1e-12)
        change = np.log(max(float(share.sum()), 1.0) / mass)
        coefficients[0] += float(np.clip(change, -MOST_CHANGE, MOST_CHANGE))
        if count > 1:
            coefficients = regressed(coefficients, nodes, volumes, share @ terms, steps=4)
        stray = float(np.clip((1 - share).sum(), FEWEST, STRAY_MOST * len(points))) / model.space
        model = replace(model, density=Density(coefficients), stray=stray)
    return model
