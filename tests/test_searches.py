"""Searches: other directions are looked at only where the first end leaves something to wish for."""

from __future__ import annotations

import numpy as np
import pytest

from scribbles import SCRIBBLED
from sketchloft import PointCloud, reconstruct
from sketchloft.exact.body import ExactBody
from sketchloft.exact.search import searches
from sketchloft.exact.search.searches import ALONE_BLURRED
from sketchloft.exact.start import choose_start
from sketchloft.exact.start.start import Start
from sketchloft.sample import GOALS, FillParams, sample_goal
from test_strokes import points_in


@pytest.fixture
def looks(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """How many other starts each look at other directions has found."""
    found: list[int] = []
    ask = choose_start.other_starts

    def counted(*given: object, **how: object) -> tuple[Start, ...]:
        others = ask(*given, **how)  # type: ignore[arg-type]
        found.append(len(others))
        return others

    monkeypatch.setattr(searches, "other_starts", counted)
    return found


def _body(cloud: PointCloud) -> ExactBody:
    body = reconstruct(cloud).bodies[0]
    assert isinstance(body, ExactBody)
    return body


@pytest.mark.parametrize(
    ("name", "params"), [("l-shape", FillParams()), ("cone", FillParams()), ("box", SCRIBBLED)]
)
def test_a_simple_thing_is_seen_from_its_direction_at_once(
    name: str, params: FillParams, looks: list[int]
) -> None:
    body = _body(sample_goal(GOALS[name], 6000, params, seed=5))
    assert looks == []
    assert abs(float(body.vector @ body.frame.direction)) == pytest.approx(1, abs=1e-12)


@pytest.mark.parametrize(("seed", "others"), [(1, 0), (7, 1)])
def test_one_run_of_stiff_walls_is_enough_of_a_scribble_that_leaves_it_sharp(
    seed: int, others: int, looks: list[int]
) -> None:
    """The second leaves a noise of between 0.005 and 0.006."""
    body = _body(PointCloud.of(points_in("twisted", seed)))
    assert len(looks) == others
    assert (body.model.sigma > ALONE_BLURRED) == bool(others)
    assert [wall.kind for wall in body.model.stack.walls] == ["twisted rectangle"]


def test_a_hopeless_start_waits_for_others(monkeypatch: pytest.MonkeyPatch, looks: list[int]) -> None:
    cloud = sample_goal(GOALS["box"], 6000, SCRIBBLED, seed=5)
    monkeypatch.setattr(searches, "HOPELESS", 0.0)
    assert _body(cloud).facts.faces == {"Plane": 6}
    assert len(looks) == 1


def test_where_a_simpler_stack_may_lie_along_another_direction_that_is_looked_for(looks: list[int]) -> None:
    body = _body(sample_goal(GOALS["lamp"], 6000, seed=2))
    assert len(looks) == 1
    assert body.facts.faces == {"ConicalSurface": 1, "CylindricalSurface": 1, "Plane": 8}


def test_the_direction_of_an_end_is_that_of_the_model() -> None:
    cloud = sample_goal(GOALS["cylinder"], 4000, seed=3)
    body = _body(cloud)
    np.testing.assert_allclose(abs(body.vector[2]), 1, atol=1e-4)


@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, 2])
def test_a_noisy_hopper_is_not_left_a_pile_of_prisms(seed: int) -> None:
    """Seen from its side, which is where the likeliest direction is, as three runs with corners."""
    rng = np.random.default_rng(seed)
    box = rng.uniform([-3.0, -1.5, 0.0], [3.0, 1.5, 6.0], (30_000, 3))
    shares = 1 - box[:, 2:] * np.array([1.5, 0.3]) / [18.0, 9.0]
    inside = box[(np.abs(box[:, :2]) < shares * [3.0, 1.5]).all(axis=1)][:10_000]
    body = _body(PointCloud.of(inside + 0.04 * rng.standard_normal(inside.shape)))
    assert body.facts.faces == {"Plane": 6}
    assert abs(body.vector[2]) > np.cos(np.radians(2))
    assert body.facts.volume == pytest.approx(6 * (18 + 7.2 + 4 * 4.5 * 2.7) / 6, rel=0.02)
