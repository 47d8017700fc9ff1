"""The report of the exact method: its figures, its facts, and what they are made of."""

from __future__ import annotations

import io
import re
from collections.abc import Callable, Iterator
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.image import imread

from sketchloft import Params, PointCloud, Reconstruction, reconstruct
from sketchloft.brep.build_stack import built_stack
from sketchloft.cloud import Floats
from sketchloft.direction import DirectionParams
from sketchloft.exact.body import ExactBody
from sketchloft.exact.model.density import Density
from sketchloft.exact.model.exact_model import ExactModel, model_of
from sketchloft.exact.start.direction import Candidate
from sketchloft.outline.circle import Circle
from sketchloft.outline.ellipse import Ellipse
from sketchloft.outline.outline import Outline
from sketchloft.outline.placed_polygons import Rectangle, RegularPolygon, RoundedRectangle
from sketchloft.outline.polygons import LineArc, Polygon
from sketchloft.outline.rounded_polygon import RoundedPolygon
from sketchloft.outline.spline_loop import spline_loop
from sketchloft.outline.stadium import Stadium
from sketchloft.report.axial_counts import axial_counts
from sketchloft.report.axial_profile_figure import axial_profile_figure
from sketchloft.report.cuts_figure import cuts_figure, likely_strays
from sketchloft.report.dimensions import Dimension, dimensions
from sketchloft.report.distance_outside import distance_from_walls, distance_outside
from sketchloft.report.exact_directions import exact_directions
from sketchloft.report.findings import density_words, stray_words
from sketchloft.report.html import write_report
from sketchloft.report.kinds_figure import kinds_figure
from sketchloft.report.nearby import nearby
from sketchloft.report.palette import CLOUD, FACES, SURFACE
from sketchloft.report.pose import pose_of
from sketchloft.report.precision import precision, spreads
from sketchloft.report.run_words import break_words, dimension_error, dimension_value, run_words
from sketchloft.report.runs_figure import runs_figure
from sketchloft.report.section_path import section_path
from sketchloft.report.spaced import spaced
from sketchloft.report.wall_counts import expected_counts
from sketchloft.report.wall_distance_figure import wall_distance_figure
from sketchloft.report.words import MINUS, TIMES, number, place
from sketchloft.ring import ring_area
from sketchloft.sample import GOALS, sample_goal
from sketchloft.stack import Run, Stack, Wall
from sketchloft.wall.lofted import lofted
from sketchloft.wall.profile import ArcProfile, LineProfile, SplineProfile
from sketchloft.wall.revolved import Revolved
from sketchloft.wall.swept import Swept

ORIGIN = np.zeros(2)
NOISE = 0.004


@pytest.fixture(autouse=True, scope="module")
def coarse() -> Iterator[None]:
    """Small pictures, for speed."""
    with pytest.MonkeyPatch.context() as patch:
        for room in ("overview_figure", "kinds_figure"):
            patch.setattr(f"sketchloft.report.{room}.PIXELS", 120)
        patch.setattr("sketchloft.report.markup.DPI", 40)
        yield


@pytest.fixture(scope="module")
def lamp() -> Reconstruction:
    """A lamp of 4,000 points far from the origin, found by the exact method."""
    points = sample_goal(GOALS["lamp"], 4000, seed=1).points + np.array([100.0, 0, 50])
    return reconstruct(PointCloud(points, name="lamp"), Params(direction=DirectionParams((0, 0, 1))))


@pytest.fixture(scope="module")
def lamp_body(lamp: Reconstruction) -> ExactBody:
    (body,) = lamp.bodies
    assert isinstance(body, ExactBody)
    return body


@pytest.fixture(scope="module")
def tube(lamp: Reconstruction, lamp_body: ExactBody) -> Reconstruction:
    """A tube on a twisted star, with noise and strays, made without a search."""
    star = np.arange(10) * np.pi / 5
    spokes = np.where(np.arange(10) % 2, 0.25, 0.4)[:, None]
    polygon = Polygon(spokes * np.column_stack([np.cos(star), np.sin(star)]))
    foot = Swept(polygon, -0.3, ORIGIN, ORIGIN, 0.0, 0.5, ("twist",))
    outer, inner = (Revolved(ORIGIN, LineProfile(0.0, radius, None)) for radius in (0.25, 0.15))
    stack = Stack(np.array([-0.3, -0.1, 0.35]), (Run((foot,)), Run((outer, inner), holes=1)))
    return known(lamp, lamp_body, stack)


@pytest.fixture(scope="module")
def page(lamp: Reconstruction, tmp_path_factory: pytest.TempPathFactory) -> bytes:
    path = tmp_path_factory.mktemp("report") / "report.html"
    write_report(lamp, path, unit="mm")
    return path.read_bytes()


def known(result: Reconstruction, body: ExactBody, stack: Stack, count: int = 4000) -> Reconstruction:
    """A reconstruction whose one body is a stack, its points drawn inside it with noise and some strays."""
    rng = np.random.default_rng(1)
    box = rng.uniform(-0.5, 0.5, (20 * count, 3))
    points = box[distance_outside(box, stack) < 0][:count] + NOISE * rng.standard_normal((count, 3))
    strays = rng.uniform(-0.5, 0.5, (count // 100, 3))
    volume = float((distance_outside(box, stack) < 0).mean())
    density = Density(np.log([count / volume]))
    model = model_of(stack, NOISE, density, len(strays), 1.0)
    solid, facts = built_stack(stack, result.cloud.centre + body.centre, body.frame.axes, body.scale)
    found = replace(
        body, points=np.concatenate([points, strays]), model=model, solid=solid, facts=facts, name="known"
    )
    return replace(result, bodies=(found,))


def body_of(result: Reconstruction) -> ExactBody:
    (body,) = result.bodies
    assert isinstance(body, ExactBody)
    return body


class Page(HTMLParser):
    """Reads a page: its rows of tables, its words, and what its pictures are said to show."""

    def __init__(self, page: bytes) -> None:
        super().__init__()
        self.rows: list[list[str]] = []
        self.words: list[str] = []
        self.alts: list[str] = []
        self.feed(page.decode("utf-8"))
        self.close()
        self.text = " ".join(" ".join(self.words).split())

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.alts += [value or "" for name, value in attrs if name == "alt"]
        if tag == "tr":
            self.rows.append([])
        if tag in ("td", "th"):
            self.rows[-1].append("")

    def handle_data(self, data: str) -> None:
        self.words.append(data)
        if self.rows and self.rows[-1]:
            self.rows[-1][-1] += data.strip()


def pixels(figure: Figure) -> np.ndarray:
    """(h, w, 3) colours of a figure."""
    image = io.BytesIO()
    figure.savefig(image, dpi=60)
    image.seek(0)
    return np.asarray(imread(image, format="png"))[..., :3]


def shows(picture: np.ndarray, colour: str, tolerance: float = 0.12) -> bool:
    """Whether some pixels have about this colour."""
    return bool((np.abs(picture - to_rgb(colour)).max(axis=2) < tolerance).sum() > 5)


# The report


def test_page_holds_the_figures(page: bytes) -> None:
    found = Page(page)
    for words in (
        "The points of the cloud on the left",
        "two slabs through them",
        "Size of the section against height",
        "Panels with the points near a height of each run",
        "its faces coloured by kind of surface",
        "Histogram of the distance of points from the walls",
    ):
        assert any(words in alt for alt in found.alts), words
    assert page.count(b"data:image/png;base64,") == len(found.alts) == 6
    assert not re.search(rb"https?:|<script|@import|file:", page)


def test_page_holds_the_facts(page: bytes, lamp: Reconstruction, lamp_body: ExactBody) -> None:
    found, facts, model = Page(page), lamp_body.facts, lamp_body.model
    for words in (
        "Valid solid",
        "one closed shell without free edges",
        f"{number(facts.volume, 5)} mm³",
        "8 plane, 1 cone, 1 cylinder",
        "The slicing direction was given: z.",
        f"Breaks divide it into {len(model.stack.runs)} runs.",
        "runs are counted from 1",
        "Nothing was left out on the way.",
    ):
        assert words in found.text, words
    heights = pose_of(lamp, lamp_body).height(model.stack.breaks)
    assert heights == pytest.approx([50, 51.5, 62, 68], abs=0.05)
    breaks = [row[1] for row in found.rows if re.match(r"(start of |end of |)run \d", row[0])]
    assert breaks == [place(height, float(np.ptp(heights))) for height in heights.tolist()]
    by_name = {(row[1], row[3]): row for row in found.rows if len(row) == 6 and row[0] in "123"}
    radius = by_name["cylinder", "radius"][4]
    assert radius.endswith(" mm")
    assert float(radius.split()[0]) == pytest.approx(5, abs=0.02)
    assert float(by_name["cone", "half angle"][4].rstrip("°")) == pytest.approx(26.57, abs=0.5)
    assert ["method", "method", "exact"] in found.rows
    assert not any(row[0] == "loft" for row in found.rows)


def test_same_input_same_bytes(lamp: Reconstruction, page: bytes, tmp_path: Path) -> None:
    write_report(lamp, tmp_path / "again.html", unit="mm")
    assert (tmp_path / "again.html").read_bytes() == page


def test_several_bodies_and_strays(lamp: Reconstruction, tube: Reconstruction, tmp_path: Path) -> None:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("sketchloft.report.exact_story.picture", lambda *_: "")
        write_report(replace(lamp, bodies=(*lamp.bodies, *tube.bodies)), tmp_path / "two.html", unit="cm")
    found = Page((tmp_path / "two.html").read_bytes())
    assert "2 valid solids" in found.text
    assert "Body 2: known" in found.text
    assert "about 40 points, 0.99 %" in found.text
    assert any(row[1:4] == ["cylinder (hole)", "3", "radius"] for row in found.rows if len(row) == 6)


def test_compared_directions_are_listed(lamp_body: ExactBody) -> None:
    tried = tuple(
        Candidate(axis, value, value, "principal")
        for axis, value in zip(np.eye(3)[::-1], (1.5, 1, 0), strict=True)
    )
    said = "".join(exact_directions(replace(lamp_body, candidates=tried)))
    assert "Of 3 directions" in said
    assert said.count("principal axis of the points") == 3


# The pictures


@pytest.mark.parametrize(
    ("draw", "colours"),
    [
        (lambda r, b: cuts_figure(r, b, unit="mm"), [CLOUD, SURFACE]),
        (lambda r, b: axial_profile_figure(r, b, unit="mm"), [CLOUD]),
        (lambda r, b: runs_figure(r, b, precision(b), unit="mm"), [SURFACE]),
        (lambda r, b: kinds_figure(r, b, unit="mm"), [FACES["Plane"]]),
        (lambda r, b: wall_distance_figure(r, b, precision(b), unit="mm"), [CLOUD]),
    ],
    ids=["cuts", "profile", "runs", "kinds", "distance"],
)
def test_pictures_show_something(
    tube: Reconstruction, draw: Callable[[Reconstruction, ExactBody], Figure], colours: list[str]
) -> None:
    picture = pixels(draw(tube, body_of(tube)))
    assert 0.01 < (picture.min(axis=2) < 0.9).mean() < 0.8
    assert all(shows(picture, colour) for colour in colours)


def test_profile_names_breaks_and_runs(lamp: Reconstruction, lamp_body: ExactBody) -> None:
    figure = axial_profile_figure(lamp, lamp_body, unit="mm")
    (ax,) = figure.axes
    said = [text.get_text() for text in ax.texts]
    breaks, runs = lamp_body.model.stack.breaks, lamp_body.model.stack.runs
    assert len(said) == len(breaks) + len(runs)
    assert said[0].endswith("flat end")
    assert said[1].endswith("step")
    assert said[len(breaks) :] == [f"{j + 1}: {run_words(run)}" for j, run in enumerate(runs)]
    assert ax.get_xlabel() == "z [mm]"


def test_each_run_has_its_panel(tube: Reconstruction) -> None:
    body = body_of(tube)
    figure = runs_figure(tube, body, precision(body), unit="mm")
    titles = [ax.get_title().strip() for ax in figure.axes if ax.axison]
    assert titles == ["run 1: twisted polygon", *(3 * ["run 2: cylinder, hole cylinder"])]
    lines = [len(ax.lines) for ax in figure.axes if ax.axison]
    assert lines[0] == 1
    assert lines[-1] == 2


# What they are made of


def test_distance_from_a_stack(tube: Reconstruction) -> None:
    stack = body_of(tube).model.stack
    outside = {
        (0.2, 0.0, 0.1): -0.05,  # in the middle of the tube
        (0.0, 0.0, 0.1): 0.15,  # in its hole
        (0.27, 0.0, 0.1): 0.02,
        (0.2, 0.0, 0.38): 0.03,  # above it
        (0.2, 0.0, -0.1): -0.05,  # where the runs meet there is no ledge, but the hole ends
        (0.0, 0.0, -0.13): -0.03,  # below the floor of the hole
        (0.1, 0.0, -0.29): -0.01,
    }
    assert distance_outside(np.array(list(outside)), stack) == pytest.approx(list(outside.values()), abs=1e-9)
    points = np.array([[0.2, 0, 0.29], [0, 0, 0.1], [0, 0, 0.5]])
    assert distance_from_walls(points, stack) == pytest.approx([-0.05, 0.15, np.nan], nan_ok=True)
    assert len(distance_outside(np.empty((0, 3)), stack)) == 0


def test_strays_and_density_in_words(tube: Reconstruction) -> None:
    body = body_of(tube)
    stray = likely_strays(body.points, body.model)
    outside = distance_outside(body.points, body.model.stack)
    assert stray[outside > 6 * NOISE].all()
    assert not stray[outside < 0].any()
    assert stray_words(body) == "about 40 points, 0.99 %"
    assert stray_words(replace(body, model=replace(body.model, stray=0.4))) == "none"
    assert density_words(body, "mm").startswith("even, ")
    graded = Density(np.array([8.0, 0, 0, np.log(10)]))
    words = density_words(replace(body, model=replace(body.model, density=graded)), "mm")
    assert re.match(r"graded by a factor of 4\.\d, on average .* points per mm³", words)


def test_counts_tell_areas(tube: Reconstruction) -> None:
    body = body_of(tube)
    counts = axial_counts(body)
    low, high = body.model.stack.breaks[[0, -1]]
    beyond = (counts.heights < low) | (counts.heights > high)
    expected = np.zeros(len(counts.heights))
    for run, z in zip(body.model.stack.runs, ([-0.3, -0.1], [-0.1, 0.35]), strict=True):
        here = (counts.heights > z[0]) & (counts.heights < z[1])
        expected[here] = sum(
            run.sign(i) * float(wall.area(np.array([z[0]]))[0]) for i, wall in enumerate(run.walls)
        )
    gaps = (counts.areas - expected)[~beyond] / counts.errors[~beyond]
    assert abs(gaps.mean()) < 0.5
    assert gaps.std() < 1.5
    assert beyond.sum() == 4


def test_expected_counts_agree_with_the_points(tube: Reconstruction) -> None:
    body = body_of(tube)
    edges = np.linspace(-0.03, 0.03, 13)
    at, expected = expected_counts(body.model, edges, 1.0)
    counted, _ = np.histogram(distance_outside(body.points, body.model.stack), edges)
    model = np.interp((edges[:-1] + edges[1:]) / 2, at, expected)
    assert ((counted - model) / np.sqrt(model + 1)).std() < 2
    assert counted.sum() == pytest.approx(model.sum(), rel=0.08)


def test_errors_are_those_of_the_theory() -> None:
    """One cylinder: the likelihood's error by the number of points per width of its wall."""
    radius, height, count, sigma = 0.4, 0.8, 100_000, 0.01
    wall = Revolved(ORIGIN, LineProfile(0.0, radius, None))
    stack = Stack(np.array([-0.4, 0.4]), (Run((wall,)),))
    rho = count / (np.pi * radius**2 * height)
    model = model_of(stack, sigma, Density(np.log([rho])), 1e-9, 1.0)
    found = precision(even_body(model))
    on_wall = rho * 2 * np.pi * radius * height
    assert found.together == 1
    assert spreads(model, found, 0, 0)[0] == pytest.approx(np.sqrt(sigma / 0.903 / on_wall), rel=0.02)
    assert found.breaks == pytest.approx(
        np.sqrt(sigma / 0.903 / (rho * np.pi * radius**2)) * np.ones(2), rel=0.02
    )
    sharp = precision(even_body(replace(model, sigma=1e-9)))
    assert sharp.gap == pytest.approx(model.parameters / on_wall, rel=1e-3)
    assert spreads(model, sharp, 0, 0)[0] == pytest.approx(np.sqrt(model.parameters) / on_wall, rel=0.02)


def even_body(model: ExactModel) -> ExactBody:
    """Stands for a body of which only points and model matter."""
    points = np.random.default_rng(1).uniform(-0.4, 0.4, (20_000, 3))

    class Body:
        pass

    body = Body()
    body.points, body.model = points, model  # type: ignore[attr-defined]
    return body  # type: ignore[return-value]


SQUARE = np.array([[-1.0, -1], [1, -1], [1, 1], [-1, 1]])
OUTLINES: list[Outline] = [
    Circle(np.array([1.0, 2]), 3.0),
    Ellipse(np.array([1.0, 2]), 3.0, 1.0, 0.4),
    Ellipse(np.array([1.0, 2]), 1.0, 3.0, 0.4),
    Rectangle(np.array([1.0, 2]), 3.0, 1.0, 0.4),
    RoundedRectangle(np.array([1.0, 2]), 3.0, 2.0, 0.4, 0.5),
    Stadium(np.array([1.0, 2]), 3.0, 1.0, 0.4),
    RegularPolygon(np.array([1.0, 2]), 3.0, 0.4, 5),
    Polygon(SQUARE),
    RoundedPolygon(SQUARE, 0.3),
    LineArc(SQUARE, np.array([0.3, 0, -0.2, 0]), np.array([True, False, True, False])),
    spline_loop(np.column_stack([2 * np.cos(np.arange(8) * np.pi / 4), np.sin(np.arange(8) * np.pi / 4)])),
]


@pytest.mark.parametrize("outline", OUTLINES, ids=lambda outline: outline.kind)
def test_section_paths_lie_on_their_walls(outline: Outline) -> None:
    wall = Swept(outline, 0.5, np.array([1.0, 0]), np.array([0.3, -0.1]), 0.2, 0.7)
    check_path(wall, 1.3)
    assert ring_area(section_path(wall, 0.5)[:-1]) == pytest.approx(outline.area, rel=2e-3)


@pytest.mark.parametrize(
    "profile",
    [
        LineProfile(0.0, 2.0, 0.3),
        ArcProfile(0.0, None, 2.0),
        ArcProfile(0.0, 3.0, 2.0, -1),
        SplineProfile(np.array([0.0, 0, 0, 0, 1, 2, 2, 2, 2]), np.array([1.0, 2, 1.5, 1.2, 3])),
    ],
    ids=["cone", "sphere", "torus", "spline"],
)
def test_revolved_paths_lie_on_their_walls(profile: LineProfile | ArcProfile | SplineProfile) -> None:
    check_path(Revolved(np.array([1.0, 2]), profile), 0.7)


def test_lofted_path_lies_on_its_wall() -> None:
    check_path(loft(), 0.7)


def loft() -> Wall:
    angle = np.arange(8) * np.pi / 4
    ring = np.column_stack([np.cos(angle), 0.7 * np.sin(angle)])
    poles = np.stack([ring, 1.2 * ring, 0.9 * ring + [0.2, 0], 1.1 * ring])
    return lofted(poles, np.array([0.0, 0, 0, 0, 2, 2, 2, 2]))


def check_path(wall: Wall, height: float) -> None:
    path = section_path(wall, height)
    assert path[0] == pytest.approx(path[-1], abs=1e-9)
    points = np.column_stack([path, np.full(len(path), height)])
    assert np.abs(wall.foot(points).distance).max() < 1e-6


def test_points_near_a_height_keep_their_distance() -> None:
    rng = np.random.default_rng(1)
    points = rng.uniform([-1.6, -1.6, 0.2], [1.6, 1.6, 1.8], (4000, 3))
    for wall in (Revolved(ORIGIN, LineProfile(0.0, 1.0, 0.4)), Revolved(ORIGIN, ArcProfile(0.0, None, 2.0))):
        flat, half = nearby(points, Run((wall,)), 1.0, 0.2, 1.8)
        slab = points[np.abs(points[:, 2] - 1.0) <= half]
        assert len(flat) == len(slab) > 400
        moved = np.column_stack([flat, np.ones(len(flat))])
        before, after = wall.foot(slab).distance, wall.foot(moved).distance
        close = np.abs(before) < 0.2
        assert after[close] == pytest.approx(before[close], abs=0.02)


def named(wall: Wall, low: float = 0.0, high: float = 1.0) -> dict[str, float]:
    return {one.name: one.value for one in dimensions(wall, low, high)}


def test_dimensions_of_walls() -> None:
    assert named(Revolved(ORIGIN, LineProfile(0.0, 2.0, -1.0))) == pytest.approx(
        {"radius below": 2, "radius above": 1, "half angle": np.pi / 4}
    )
    assert named(Revolved(ORIGIN, ArcProfile(0.0, None, 2.0))) == {"radius": 2}
    assert named(Revolved(ORIGIN, ArcProfile(0.0, 3.0, 2.0))) == {
        "radius of the ring": 3,
        "radius of the tube": 2,
    }
    spline = SplineProfile(np.array([0.0, 0, 0, 0, 1, 1, 1, 1]), np.full(4, 1.5))
    assert named(Revolved(ORIGIN, spline)) == pytest.approx(
        {"radius below": 1.5, "above": 1.5, "least": 1.5, "largest": 1.5, "poles": 4}
    )
    box = Rectangle(ORIGIN, 4.0, 2.0, 0.3)
    tapered = Swept(box, 1.0, ORIGIN, np.array([0.0, 1]), -0.5, 0.2, ("drift", "taper", "twist"))
    assert named(tapered) == pytest.approx(
        {"width": 6, "depth": 3, "turned by": 0.1, "slant": np.pi / 4, "grows to": 2 / 3, "twist": 0.2}
    )
    kinds = [list(named(Swept(outline, 0.0, ORIGIN, ORIGIN))) for outline in OUTLINES]
    assert kinds[5:] == [
        ["radius", "between the arcs", "turned by"],
        ["corners", "radius to the corners", "turned by"],
        ["corners", "area"],
        ["corners", "fillets", "area"],
        ["lines", "arcs", "area"],
        ["poles", "area"],
    ]
    assert named(loft(), 0, 2)["around"] == 8


def test_dimensions_in_words() -> None:
    assert dimension_value(Dimension("radius", 0.5), 0.0012, 10.0, 0.0, "mm") == "5.000 mm"
    assert dimension_error(Dimension("radius", 0.5), 0.0012, 10.0) == "0.012"
    assert dimension_value(Dimension("area", 0.5, "area"), np.nan, 10.0, 0.0, "cm") == "50.00 cm²"
    assert dimension_error(Dimension("area", 0.5, "area"), np.nan, 10.0) == ""
    turned = Dimension("turned by", np.radians(170), "angle", np.pi)
    assert dimension_value(turned, np.radians(0.5), 10.0, np.radians(5), "mm") == f"{MINUS}5.00°"
    assert dimension_value(Dimension("corners", 5, "count"), 0.0, 10.0, 0.0, "mm") == "5"


def test_runs_and_breaks_in_words(tube: Reconstruction) -> None:
    model = body_of(tube).model
    cylinder = model.stack.runs[1].walls[0]
    assert run_words(Run((cylinder, cylinder, cylinder), holes=1)) == f"2 {TIMES} cylinder, hole cylinder"
    assert [break_words(model, k) for k in range(3)] == ["flat end", "step", "flat end"]
    rounded = replace(model, joins=("pole", "cross", "step"))
    assert [break_words(rounded, k) for k in range(3)] == ["pole", "cross", "flat end"]


@given(st.lists(st.floats(0, 1), min_size=1, max_size=12), st.floats(0.001, 0.2))
def test_spaced_labels_are_apart_and_in_order(places: list[float], apart: float) -> None:
    rising = np.sort(np.array(places))
    moved: Floats = spaced(rising, apart)
    assert (np.diff(moved) >= apart - 1e-9).all()
    assert moved.mean() == pytest.approx(rising.mean())
    if (np.diff(rising) >= apart).all():
        assert moved == pytest.approx(rising)
