"""The examples, the pictures of the docs and the benchmark run, and leave what they promise."""

from __future__ import annotations

import importlib
import sys
from pathlib import Path
from types import ModuleType

import pytest
from matplotlib.image import imread

from sketchloft import load_mesh, read_cloud
from sketchloft.pipeline import EXACT_STAGES, STAGES, Method

ROOT = Path(__file__).parents[1]
FEW = 2_000
PROMISED = {
    "comparison": ["comparison-l-shape.png", "comparison-three-spheres.png"],
    "demo": [
        "cloud.ply",
        "model.step",
        "model.stl",
        "goal.step",
        "report.html",
        "cuts.png",
        "profile.png",
        "runs.png",
        "kinds.png",
        "walls.png",
        "overview.png",
        "error-map.png",
    ],
    "directions": ["directions.png"],
    "distortion": ["distortion-error.png", "distortion-models.png"],
    "lamp": ["lamp-error.png", "lamp-models.png"],
    "quantify": ["quantify-splines.png", "quantify-circles.png", "quantify-models.png"],
    "slices": [
        "cloud.png",
        "slice-planes.png",
        "edge-points.png",
        "sections.png",
        "evidence.png",
        "loft.png",
    ],
}
SHARED = {"gallery", "trial"}


@pytest.fixture(autouse=True)
def as_scripts(monkeypatch: pytest.MonkeyPatch) -> None:
    """Scripts find the modules beside them."""
    for folder in ("examples", "docs", "benchmarks"):
        monkeypatch.syspath_prepend(ROOT / folder)


def script(name: str) -> ModuleType:
    return importlib.import_module(name)


def assert_pictures(paths: list[Path]) -> None:
    for path in paths:
        if path.suffix == ".png":
            picture = imread(path)[..., :3]
            assert picture.shape[1] > 900, path
            assert (picture.min(axis=2) < 0.9).mean() > 0.02, f"{path} is empty"


def test_every_example_is_tested() -> None:
    assert {path.stem for path in (ROOT / "examples").glob("*.py")} == set(PROMISED) | SHARED


@pytest.mark.parametrize("name", sorted(PROMISED))
def test_example_says_what_it_shows_and_how_to_run_it(name: str) -> None:
    text = script(name).__doc__ or ""
    assert "paper" in text
    assert "figure" in text
    assert f"python examples/{name}.py" in text


@pytest.fixture
def coarse(monkeypatch: pytest.MonkeyPatch) -> None:
    """Small views of coarse triangles, for speed."""
    monkeypatch.setattr("sketchloft.report.comparison.PIXELS", 160)
    monkeypatch.setattr("sketchloft.report.error_map.PIXELS", 160)
    monkeypatch.setattr("trial.CHORD", 1e-3)


@pytest.mark.slow
@pytest.mark.usefixtures("coarse")
@pytest.mark.parametrize("name", sorted(PROMISED))
def test_example_leaves_what_it_promises(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    written = script(name).main(tmp_path, FEW)
    assert sorted(written) == sorted(tmp_path / file for file in PROMISED[name])
    assert sorted(tmp_path.iterdir()) == sorted(written)
    assert_pictures(written)
    assert capsys.readouterr().out
    if name == "demo":
        assert len(read_cloud(tmp_path / "cloud.ply")) == FEW
        goal = load_mesh(tmp_path / "goal.step").volume
        for model in ("model.step", "model.stl"):
            assert load_mesh(tmp_path / model).volume == pytest.approx(goal, rel=0.1)
        assert "volume" in (tmp_path / "report.html").read_text(encoding="utf-8")


def test_command_line_of_examples(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = tmp_path / "made" / "here"
    asked: list[tuple[Path, int]] = []

    def main(where: Path, n: int) -> list[Path]:
        asked.append((where, n))
        return [where / "picture.png"]

    monkeypatch.setattr(sys, "argv", ["example.py", str(folder), "-n", "70"])
    script("trial").run(main, "What it shows.", "demo/example")
    assert asked == [(folder, 70)]
    assert folder.is_dir()
    assert capsys.readouterr().out == f"written: {folder / 'picture.png'}\n"


def test_pictures_are_made_small_and_stay_white(tmp_path: Path) -> None:
    hero, trial, pictures = script("hero"), script("trial"), script("pictures")
    path = hero.draw_hero(trial.trial(trial.cloud_of("lamp", FEW)), tmp_path / "hero.png")
    large = path.stat().st_size
    pictures.shrink(path)
    picture = imread(path)[..., :3]
    assert path.stat().st_size < large / 2
    assert picture.shape[1] == pictures.WIDEST
    assert picture[0, 0].tolist() == [1, 1, 1]
    assert_pictures([path])


def test_pictures_of_the_docs_have_a_maker_and_are_small() -> None:
    made = {name for names in PROMISED.values() for name in names if name.endswith(".png")}
    pictures = sorted((ROOT / "docs" / "pictures").iterdir())
    assert {path.name for path in pictures} == made - {"error-map.png"} | {"hero.png"}
    for path in pictures:
        assert path.stat().st_size < 500_000, path
        assert imread(path)[0, 0, :3].tolist() == [1, 1, 1], f"{path} is not on white"


@pytest.mark.parametrize(("method", "names"), [("exact", EXACT_STAGES), ("paper", STAGES)])
def test_benchmark_times_every_stage(method: Method, names: tuple[str, ...], tmp_path: Path) -> None:
    stages = script("stages")
    timings = []
    for points in (300, 900):
        stages.draw("cylinder", points, tmp_path / f"{points}.ply")
        timings.append(stages.timed(method, tmp_path / f"{points}.ply"))
    assert [one.points for one in timings] == [300, 900]
    assert (tmp_path / "900.step").stat().st_size > 0
    for one in timings:
        assert list(one.seconds) == ["read", *names, "write"]
        assert one.memory >= one.before > 1 << 20
    lines = stages.table(timings).splitlines()
    assert lines[0].split() == ["seconds", "300", "900", "x3", "exponent"]
    assert [line[:14].strip() for line in lines[1:]] == [
        "read",
        *names,
        "write",
        "total",
        "peak MiB",
        "before",
    ]


def test_benchmark_tells_growth() -> None:
    stages = script("stages")
    timings = [
        stages.Timing(n, {"quick": 1e-4, "square": (n / 1e4) ** 2, "line": n / 1e4}, 2**30, 2**28)
        for n in (10_000, 100_000, 1_000_000)
    ]
    rows = {line.split()[0]: line.split()[1:] for line in stages.table(timings).splitlines()}
    assert rows["seconds"] == ["10,000", "100,000", "1,000,000", "x10", "x10", "exponent"]
    assert rows["quick"][3:] == ["-", "-", "-"]
    assert rows["square"][3:] == ["100.0", "100.0", "2.00"]
    assert rows["line"][3:] == ["10.0", "10.0", "1.00"]
    assert rows["total"][0] == "2.000"
