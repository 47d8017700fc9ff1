"""The picture of the signed error on the model and its histogram."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from matplotlib.colors import to_rgb
from matplotlib.image import imread

from meshes import block, sphere
from sketchloft.errors import OutputError
from sketchloft.measurement import Measurement, measure
from sketchloft.report.camera import BEHIND, FRONT
from sketchloft.report.error_map import COLOURS, draw_error_map, error_map_figure
from sketchloft.report.picture import new_figure, save_figure


@pytest.fixture(autouse=True, scope="module")
def coarse() -> Iterator[None]:
    """Small views, for speed."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("sketchloft.report.error_map.PIXELS", 160)
        yield


def measured(radius: float) -> Measurement:
    return measure(sphere(radius, level=3), sphere(level=3), n=2000)


def mean_colour(picture: np.ndarray) -> np.ndarray:
    """Mean red, green and blue of the left half, where the model is shown, without white and grey."""
    left = picture[: 3 * len(picture) // 4, : picture.shape[1] // 2, :3].reshape(-1, 3)
    return np.asarray(left[np.ptp(left, axis=1) > 0.2].mean(axis=0))


@pytest.fixture(scope="module")
def outside(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("maps") / "outside.png"
    draw_error_map(measured(1.02), path, title="too large")
    return path


def test_png_shows_something(outside: Path) -> None:
    picture = imread(outside)
    width = picture.shape[1]
    assert width > 1500
    assert (picture[:, : width // 2, :3].min(axis=2) < 0.9).mean() > 0.1
    assert (picture[:, width // 2 :, :3].min(axis=2) < 0.9).mean() > 0.05


def test_outside_is_red_and_inside_blue(outside: Path, tmp_path: Path) -> None:
    red, _, blue = mean_colour(imread(outside))
    assert red > 2 * blue
    draw_error_map(measured(0.98), tmp_path / "inside.png")
    red, _, blue = mean_colour(imread(tmp_path / "inside.png"))
    assert blue > 2 * red
    assert np.ptp(to_rgb(COLOURS(0.5))) < 0.02
    assert min(to_rgb(COLOURS(0.5))) > 0.95


def test_same_input_same_bytes(outside: Path, tmp_path: Path) -> None:
    draw_error_map(measured(1.02), tmp_path / "again.png", title="too large")
    assert (tmp_path / "again.png").read_bytes() == outside.read_bytes()


def test_histogram_and_scales() -> None:
    found = measure(block(1.1, 1, 1), block(1, 1, 1), n=5000)
    figure = error_map_figure(found, unit="cm", title="box", cameras=(FRONT, BEHIND))
    histogram = next(ax for ax in figure.get_axes() if ax.get_ylabel())
    heights = [bar.get_height() for bar in histogram.patches]  # type: ignore[attr-defined]
    assert sum(heights) == pytest.approx(100)
    assert heights[-1] == pytest.approx(100 / 6.4, abs=0.5)
    assert histogram.get_xlabel() == "normal distance [cm]"
    assert figure.get_suptitle().startswith("box\nrms 0.0")
    assert "volume +10 %" in figure.get_suptitle()


def test_a_perfect_model_can_be_drawn() -> None:
    figure = error_map_figure(measured(1.0), unit="mm", title="", cameras=(FRONT, BEHIND))
    assert figure.get_suptitle().startswith("rms ")


def test_nothing_half_written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    figure = new_figure(2, 1)
    with pytest.raises(OutputError, match="cannot be written"):
        save_figure(figure, tmp_path / "nowhere" / "map.png")
    with pytest.raises(OutputError, match=r"choose \.png"):
        save_figure(figure, tmp_path / "map.jpg")
    (tmp_path / "map.png").write_bytes(b"old")

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "replace", full)
    with pytest.raises(OutputError, match="No space left"):
        save_figure(figure, tmp_path / "map.png")
    assert [(one.name, one.read_bytes()) for one in tmp_path.iterdir()] == [("map.png", b"old")]
