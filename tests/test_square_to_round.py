"""Square to round: what runs of other walls could be."""

from __future__ import annotations

import numpy as np
import pytest

from sketchloft.exact.changes.square_to_round import square_to_round
from sketchloft.exact.model.density import Density
from sketchloft.exact.model.exact_model import ExactModel, model_of
from sketchloft.outline.divided_circle import DividedCircle
from sketchloft.outline.placed_polygons import Rectangle
from sketchloft.stack import Run, Stack, Wall
from sketchloft.wall.profile import ArcProfile, LineProfile
from sketchloft.wall.revolved import Revolved
from sketchloft.wall.swept import Swept

ORIGIN = np.zeros(2)


def piled(*walls: Wall) -> ExactModel:
    breaks = np.arange(len(walls) + 1.0)
    return model_of(
        Stack(breaks, tuple(Run((wall,)) for wall in walls)), 0.01, Density(np.zeros(1)), 1.0, 1.0
    )


def test_a_square_on_a_cylinder_could_go_over_into_it() -> None:
    square = Swept(Rectangle(ORIGIN, 1.0, 0.8, 0.2), 0.5, ORIGIN, ORIGIN)
    model = piled(square, Revolved(ORIGIN, LineProfile(1.5, 0.3, None)))
    up, _ = square_to_round(model, range(2))
    assert isinstance(up.bottom, Rectangle)
    assert isinstance(up.top, DividedCircle)
    assert (up.low, up.high) == (0.0, 2.0)
    assert up.bottom.width * up.bottom.height == pytest.approx(0.8, rel=0.02)
    assert up.top.radius == pytest.approx(0.3, rel=0.03)


@pytest.mark.parametrize("profile", [LineProfile(1.0, 0.3, -0.4), ArcProfile(1.0, None, 0.5)])
def test_what_has_shrunk_to_a_point_could_not(profile: LineProfile | ArcProfile) -> None:
    model = piled(Revolved(ORIGIN, LineProfile(0.5, 0.3, None)), Revolved(ORIGIN, profile))
    assert square_to_round(model, range(2)) == ()
