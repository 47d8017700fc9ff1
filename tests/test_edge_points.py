from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from sketchloft.edge_points import EdgePointsParams, edge_points, parse_probe_radius
from sketchloft.errors import StageError, UsageError
from sketchloft.ring import ring_is_simple
from sketchloft.work_points import WorkedSlice

Draw = Callable[[int, np.random.Generator], np.ndarray]


def disc(n: int, rng: np.random.Generator) -> np.ndarray:
    angle = 2 * np.pi * rng.random(n)
    return np.sqrt(rng.random(n))[:, None] * np.c_[np.cos(angle), np.sin(angle)]


def l_shape(n: int, rng: np.random.Generator) -> np.ndarray:
    points = rng.random((3 * n, 2)) * 10
    return points[(points < 4).any(axis=1)][:n]


def slices(draw: Draw, count: int = 12, n: int = 500) -> list[WorkedSlice]:
    return [WorkedSlice(float(i), draw(n, np.random.default_rng(i))) for i in range(count)]


def test_convex_sections_are_followed_by_their_hull() -> None:
    found = edge_points(slices(disc), EdgePointsParams())
    assert all(np.isinf(edge.probe_radius) for edge in found)


def test_hollow_corners_are_not_bridged() -> None:
    found = edge_points(slices(l_shape), EdgePointsParams())
    assert all(edge.probe_radius < 2 for edge in found)
    assert all(ring_is_simple(edge.points) for edge in found)


@pytest.mark.parametrize(("draw", "area"), [(disc, np.pi), (l_shape, 64.0)])
@pytest.mark.parametrize("n", [100, 500, 3000])
def test_the_area_accounts_for_the_gap_along_the_contour(draw: Draw, area: float, n: int) -> None:
    found = edge_points(slices(draw, 20, n), EdgePointsParams())
    drawn = np.mean([shoelace(edge.points) for edge in found])
    accounted = np.mean([edge.area for edge in found])
    assert drawn < area
    assert abs(accounted - area) < 0.35 * (area - drawn)


def shoelace(ring: np.ndarray) -> float:
    x, y = ring.T
    return float((x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2)


def test_a_skin_is_closed_and_its_area_left_as_it_is() -> None:
    def circle(n: int, rng: np.random.Generator) -> np.ndarray:
        angle = 2 * np.pi * rng.random(n)
        return (1 + 0.002 * rng.normal(size=n))[:, None] * np.c_[np.cos(angle), np.sin(angle)]

    for edge in edge_points(slices(circle, 8, 300), EdgePointsParams()):
        assert edge.area == pytest.approx(np.pi, rel=0.02)
        assert edge.area == pytest.approx(shoelace(edge.points))


def test_a_radius_for_all_and_one_for_each() -> None:
    drawn = slices(l_shape, 3)
    assert [edge.probe_radius for edge in edge_points(drawn, EdgePointsParams(2.5))] == [2.5] * 3
    radii = (1.0, 2.0, np.inf)
    found = edge_points(drawn, EdgePointsParams(radii))
    assert tuple(edge.probe_radius for edge in found) == radii
    assert len(found[2].points) < len(found[0].points)


def test_a_probe_through_which_everything_falls() -> None:
    with pytest.raises(StageError, match=r"edge points, slice 0: a probe of radius 0\.001 leaves 0%"):
        edge_points(slices(disc), EdgePointsParams(1e-3))


def test_points_on_one_line() -> None:
    worked = [WorkedSlice(0.0, np.outer(np.arange(20.0), [1, 2]))]
    with pytest.raises(StageError, match="edge points, slice 0: the 20 points of the slice lie on one line"):
        edge_points(worked, EdgePointsParams())


@pytest.mark.parametrize("radii", [(1.0, 2.0), -1.0, 0.0])
def test_wrong_radii_are_refused(radii: Any) -> None:
    with pytest.raises(UsageError, match="probe radius"):
        edge_points(slices(disc, 3), EdgePointsParams(radii))


def test_probe_radii_are_read(tmp_path: Path) -> None:
    file = tmp_path / "radii.txt"
    file.write_text("1\n2.5\ninf\n")
    assert parse_probe_radius("auto") == "auto"
    assert parse_probe_radius("0.5") == 0.5
    assert parse_probe_radius("inf") == np.inf
    assert parse_probe_radius(str(file)) == (1.0, 2.5, np.inf)


@pytest.mark.parametrize("text", ["wide", "-1", "0", "nan"])
def test_wrong_probe_radii_are_refused(text: str) -> None:
    with pytest.raises(UsageError, match="probe radius: found"):
        parse_probe_radius(text)


def test_a_file_without_numbers_is_refused(tmp_path: Path) -> None:
    file = tmp_path / "radii.txt"
    file.write_text("one two")
    with pytest.raises(UsageError, match="expected auto, a number, inf, or a file"):
        parse_probe_radius(str(file))
    file.write_bytes(b"\xff\xfe\x00")
    with pytest.raises(UsageError, match="cannot be read as text"):
        parse_probe_radius(str(file))
