"""Goals of known geometry, and clouds that fill or cover them."""

from sketchloft.sample.fill import FILLS, Fill, FillParams, sample_goal
from sketchloft.sample.goals import GOALS, Goal

__all__ = ["FILLS", "GOALS", "Fill", "FillParams", "Goal", "sample_goal"]
