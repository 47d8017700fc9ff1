"""Worth: what a model tells of the points, less what it costs to say it."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.fit.likelihood import Evaluation, evaluate
from sketchloft.exact.fit.schwarz import price
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.exact.model.soundness import detached, slits
from sketchloft.stack import Run
from sketchloft.wall.swept import Swept

__all__ = ["LEANING", "PER_RUN", "worth", "worth_of"]

SHORT = 8.0
"""Runs shorter than so many noise deviations are taken for noise unless they gain a lot."""
DETACHED = 300.0
"""What a wall must gain that does not reach the run beside it."""
SLIT = 40.0
"""What a slit must gain: by chance there are no points in some that are thin enough."""
LEANING = 4.0
"""Log odds against each way in which a wall is not straight and upright: by chance many are not by a hair."""
BENT = {"cone": 1, "torus": 2, "ruled": 2}
"""In how many ways other walls are not: a designer draws a torus less often than a cone."""
PER_RUN = 2
"""Parameters that a run is priced as, beside those of its walls."""
DIRECTION = 2
"""Parameters of the direction, which a sphere alone has not."""
SHORTNESS = 12.0
"""What a run of no length at all must gain."""


def worth(points: Floats, model: ExactModel, together: float, count: int) -> float:
    """Log likelihood of some of a cloud's points (n, 3), less the price of the model for all of them."""
    return worth_of(evaluate(points, model), together, count)


def worth_of(seen: Evaluation, together: float, count: int) -> float:
    """What a model is worth that was evaluated, as `worth`."""
    model = seen.model
    lengths = np.diff(model.stack.breaks)
    short = np.maximum(1 - lengths / (SHORT * model.sigma), 0.0)
    odd = SHORTNESS * float(short.sum()) + DETACHED * detached(model) + SLIT * slits(model)
    odd += LEANING * sum(map(_leanings, model.stack.runs))
    parameters = model.parameters + PER_RUN * len(lengths) + (0 if _is_ball(model) else DIRECTION)
    return seen.value / together - (price(parameters, count, together) + odd)


def _is_ball(model: ExactModel) -> bool:
    """Whether all is one whole sphere."""
    return model.joins == ("pole", "pole") and [wall.kind for wall in model.stack.walls] == ["sphere"]


def _leanings(run: Run) -> int:
    """In how many ways walls are not straight and upright that others of their kind are."""
    walls = run.walls[:1] if run.torus is not None else run.walls  # two halves are one thing
    return sum(len(wall.moves) if isinstance(wall, Swept) else BENT.get(wall.kind, 0) for wall in walls)
