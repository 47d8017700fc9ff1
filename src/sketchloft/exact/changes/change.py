"""Change: what a stack could be instead, and what that must gain beside its price."""

from __future__ import annotations

from dataclasses import dataclass

from sketchloft.exact.fit.schwarz import price
from sketchloft.exact.model.exact_model import ExactModel

__all__ = ["CHAIN_GAIN", "FREE_GAIN", "Change", "Key", "free_gain"]

FREE_GAIN = 20.0
"""What a free profile must gain over lines and arcs."""
CHAIN_GAIN = 6.0
"""The same over three of them or more: a designer draws so many rarely where one curve would do."""

Key = tuple[object, ...]


@dataclass(frozen=True)
class Change:
    """A changed model, not fitted yet.

    Parameters
    ----------
    model : ExactModel
    runs : range
        The runs of it that are new.
    handicap : float
        What it must gain beside its price.
    free : bool
        Whether it puts a free wall in, takes one out, lets go of right corners or starts from a section found
        anew, so that its walls have far to go, or its noise must tell, and `tried_free` judges it.
    """

    model: ExactModel
    runs: range
    handicap: float = 0.0
    free: bool = False

    @property
    def key(self) -> Key:
        """The same for changes that start from the same numbers."""
        kinds = tuple(wall.kind for wall in self.model.stack.walls)
        return kinds, self.runs, self.model.vector.tobytes(), self.model.stack.breaks.tobytes()

    @property
    def around(self) -> range:
        """The new runs and their neighbours."""
        return range(max(self.runs.start - 1, 0), min(self.runs.stop + 1, len(self.model.stack.runs)))

    def before(self, model: ExactModel) -> range:
        """What these are in the model that is changed."""
        wide = self.around
        return range(wide.start, wide.stop + len(model.stack.runs) - len(self.model.stack.runs))


def free_gain(walls: int, tangents: int, count: int, together: float) -> float:
    """What a free profile must gain over lines and arcs.

    Parameters
    ----------
    walls : int
        How many lines and arcs.
    tangents : int
        How many of them run into the next.
    count : int
        Number of points.
    together : float
        How many of them go together.

    Notes
    -----
    In the end the lines and arcs have one axis, and those that run into each other one radius (`coaxial`),
    but as yet each is priced with its own. Among strokes, which drift, the curve that follows them is the
    nearer one more often than not, so that there this does not count.
    """
    shared = 2 * (walls - 1) + tangents if together == 1 else 0
    return (FREE_GAIN if walls < 3 else CHAIN_GAIN) + price(shared, count, together)
