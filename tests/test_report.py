"""The pictures of the stages and the HTML report."""

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
from sketchloft.brep.tessellate import tessellate
from sketchloft.direction import DirectionParams
from sketchloft.errors import OutputError, UsageError
from sketchloft.frame import Frame
from sketchloft.measurement import Measurement, measure
from sketchloft.mesh import Mesh
from sketchloft.pipeline import BodyModel
from sketchloft.report.cloud_figure import cloud_figure
from sketchloft.report.directions_figure import directions_figure
from sketchloft.report.distance_figure import distance_figure
from sketchloft.report.evidence import slice_evidence, total_rms
from sketchloft.report.evidence_figure import evidence_figure
from sketchloft.report.faces import coloured_faces, face_legend, joined
from sketchloft.report.html import write_report
from sketchloft.report.loft_figure import loft_figure
from sketchloft.report.markup import escaped
from sketchloft.report.overview_figure import overview_figure
from sketchloft.report.palette import BODIES, CLOUD, CURVES, EDGE, FACES
from sketchloft.report.pose import Pose, pose_of
from sketchloft.report.sections_figure import sections_figure
from sketchloft.report.side_figure import side_figure
from sketchloft.report.thinning import thinned
from sketchloft.report.views import round_length
from sketchloft.report.words import (
    MINUS,
    TIMES,
    axis_name,
    counted,
    direction_words,
    number,
    place,
    shape_size,
)
from sketchloft.ring import ring_area
from sketchloft.sample import GOALS, sample_goal
from sketchloft.shapes.circle import Circle
from sketchloft.shapes.ellipse import Ellipse
from sketchloft.shapes.rectangle import Rectangle
from sketchloft.shapes.spline import fit_spline

NASTY = '<script>alert("1 & 2")</script>\x07 $a^ \udce4 漢'
VOID = {"meta", "img", "br", "hr", "link", "input"}


@pytest.fixture(autouse=True, scope="module")
def coarse() -> Iterator[None]:
    """Small pictures, for speed."""
    with pytest.MonkeyPatch.context() as patch:
        for room in ("overview_figure", "loft_figure", "directions_figure", "error_map"):
            patch.setattr(f"sketchloft.report.{room}.PIXELS", 120)
        patch.setattr("sketchloft.report.markup.DPI", 40)
        yield


def lofted(name: str, n: int, axis: tuple[float, float, float]) -> Reconstruction:
    return reconstruct(sample_goal(GOALS[name], n, seed=1), Params("paper", direction=DirectionParams(axis)))


def only(result: Reconstruction) -> BodyModel:
    """The one body of a reconstruction by the method paper."""
    (body,) = result.bodies
    assert isinstance(body, BodyModel)
    return body


@pytest.fixture(scope="module")
def shaft() -> Reconstruction:
    """A cylinder with points that are not finite or repeated, and a nasty name."""
    points = sample_goal(GOALS["cylinder"], 1500, seed=1).points
    extra = np.array([[np.nan, 0, 0], [0, np.inf, 0]])
    return reconstruct(PointCloud(np.concatenate([points, extra, points[:3]]), name=NASTY), Params("paper"))


@pytest.fixture(scope="module")
def ell() -> Reconstruction:
    return lofted("l-shape", 1500, (0, 0, 1))


@pytest.fixture(scope="module")
def pair() -> Reconstruction:
    one = sample_goal(GOALS["cone"], 1200, seed=1).points
    two = sample_goal(GOALS["box"], 800, seed=2).points
    cloud = PointCloud(np.concatenate([one, two + np.array([30, 0, 0])]), unit="cm", name="pair")
    return reconstruct(cloud, Params("paper", direction=DirectionParams((0, 0, 1))))


@pytest.fixture(scope="module")
def measured(shaft: Reconstruction) -> Measurement:
    model = tessellate(shaft.bodies[0].solid)
    return measure(model, Mesh(1.01 * model.vertices, model.triangles), n=500)


@pytest.fixture(scope="module")
def page(shaft: Reconstruction, measured: Measurement, tmp_path_factory: pytest.TempPathFactory) -> bytes:
    path = tmp_path_factory.mktemp("report") / "report.html"
    write_report(shaft, path, unit="mm", measurement=measured)
    return path.read_bytes()


@pytest.fixture(scope="module")
def pair_page(pair: Reconstruction, tmp_path_factory: pytest.TempPathFactory) -> bytes:
    """With pictures of the stages that are not rendered, for speed."""
    path = tmp_path_factory.mktemp("report") / "pair.html"
    with pytest.MonkeyPatch.context() as patch:
        for room in ("body_story", "slices_story"):
            patch.setattr(f"sketchloft.report.{room}.picture", lambda *_: '<img alt="a stage" src="#part-0">')
        write_report(pair, path, unit="cm")
    return path.read_bytes()


class Page(HTMLParser):
    """Reads a page, and fails where elements are not closed in the order they were opened."""

    def __init__(self, page: bytes) -> None:
        super().__init__()
        self.open: list[str] = []
        self.tags: list[str] = []
        self.links: list[str] = []
        self.anchors: list[str] = []
        self.alts: list[str] = []
        self.rows: list[list[str]] = []
        self.words: list[str] = []
        self.feed(page.decode("utf-8"))
        self.close()
        assert not self.open
        self.text = " ".join(" ".join(self.words).split())

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        for name, value in attrs:
            assert value is not None
            if name in ("src", "href", "srcset", "action", "data", "poster"):
                self.links.append(value)
            elif name == "id":
                self.anchors.append(value)
            elif name == "alt":
                self.alts.append(value)
        if tag == "tr":
            self.rows.append([])
        if tag in ("td", "th"):
            self.rows[-1].append("")
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        if self.open and self.open[-1] in ("td", "th"):
            self.rows[-1][-1] += data
        if "style" not in self.open:
            self.words.append(data)


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


def test_pages_are_well_formed_and_whole(page: bytes, pair_page: bytes) -> None:
    for one in (page, pair_page):
        found = Page(one)
        assert one.startswith(b"<!DOCTYPE html>")
        assert found.tags.count("h1") == 1
        assert len(set(found.anchors)) == len(found.anchors)
        assert all(alt for alt in found.alts)
        assert found.tags.count("img") == len(found.alts)
    assert Page(page).tags.count("img") == 8
    assert Page(pair_page).tags.count("img") == 1 + 2 * 6


def test_pages_refer_to_nothing_outside(page: bytes, pair_page: bytes) -> None:
    for one in (page, pair_page):
        found = Page(one)
        assert not {"script", "link", "iframe", "object", "base", "form"} & set(found.tags)
        for link in found.links:
            assert link.startswith("data:image/png;base64,") or link[1:] in found.anchors
        assert not re.search(rb"https?:|url\(|@import|file:", one)


def test_names_are_escaped(page: bytes) -> None:
    assert b"<script" not in page
    assert '<script>alert("1 & 2")</script> $a^ ? 漢' in Page(page).text
    assert escaped("a\"<&>'\n\0") == "a&quot;&lt;&amp;&gt;&#x27;  "


def test_key_figures_are_there(page: bytes, shaft: Reconstruction, measured: Measurement) -> None:
    found, body = Page(page), only(shaft)
    assert "Valid solid" in found.text
    for figure in (
        f"{number(body.facts.volume, 5)} mm³",
        f"{number(body.facts.area, 5)} mm²",
        f"{body.facts.faces['BSplineSurface']} B-spline, 2 plane",
        "read 1,505",
        "not finite, left out 2",
        "repeated, left out 3",
        "used 1,500",
        f"{number(measured.errors.rms, 3)} mm",
        "smaller than the goal's",
    ):
        assert figure in found.text, figure
    assert "input: 2 of 1505 points are not finite and were left out" in found.text


def test_every_slice_candidate_and_parameter_has_a_row(page: bytes, shaft: Reconstruction) -> None:
    rows, body = Page(page).rows, only(shaft)
    slices = [row for row in rows if len(row) == 10 and row[0] != "slice"]
    assert [row[0].lstrip("• ") for row in slices] == [str(i) for i in range(len(body.sections))]
    assert [int(row[2].replace(",", "")) for row in slices] == [len(one.points) for one in body.worked]
    assert slices[0][0].startswith("•")
    taken = [row for row in rows if row[-1] == "taken"]
    assert [row[0] for row in taken] == ["z"]
    assert ["edge points", "probe radius", "auto"] in rows


def test_several_bodies(pair_page: bytes, pair: Reconstruction) -> None:
    found = Page(pair_page)
    assert len(pair.bodies) == 2
    assert "2 valid solids" in found.text
    assert "pair-1, pair-2" in found.text
    for i, body in enumerate(pair.bodies):
        assert f"Body {i + 1}: {body.name}" in found.text
        assert any(row[0] == body.name and f"{number(body.facts.volume, 5)} cm³" in row for row in found.rows)


def test_a_given_direction_is_said(pair_page: bytes) -> None:
    found = Page(pair_page)
    assert "The direction was given: z." in found.text
    assert "Nothing was left out on the way." in found.text


def test_same_input_same_bytes(
    shaft: Reconstruction, measured: Measurement, page: bytes, tmp_path: Path
) -> None:
    write_report(shaft, tmp_path / "again.html", unit="mm", measurement=measured)
    assert (tmp_path / "again.html").read_bytes() == page


def test_nothing_half_written(shaft: Reconstruction, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sketchloft.report.html._parts", lambda *_: iter(()))
    monkeypatch.setattr("sketchloft.report.html.verdict", lambda *_: "")
    with pytest.raises(OutputError, match="cannot be written"):
        write_report(shaft, tmp_path / "nowhere" / "report.html", unit="mm")
    (tmp_path / "report.html").write_bytes(b"old")

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "replace", full)
    with pytest.raises(OutputError, match="No space left"):
        write_report(shaft, tmp_path / "report.html", unit="mm")
    assert [(one.name, one.read_bytes()) for one in tmp_path.iterdir()] == [("report.html", b"old")]


# The pictures


@pytest.mark.parametrize(
    ("draw", "colours"),
    [
        (lambda r: overview_figure(r, unit="mm"), [FACES["Plane"]]),
        (lambda r: cloud_figure(r, only(r), unit="mm"), [CLOUD, EDGE]),
        (lambda r: distance_figure(r, only(r), unit="mm"), []),
        (lambda r: side_figure(r, only(r), unit="mm"), [CLOUD, EDGE]),
        (lambda r: sections_figure(r, only(r), unit="mm"), [EDGE]),
        (lambda r: loft_figure(r, only(r), unit="mm"), [CURVES["circle"], FACES["Plane"]]),
        (lambda r: evidence_figure(only(r), unit="mm"), [EDGE, CURVES["circle"]]),
    ],
    ids=["overview", "cloud", "distance", "side", "sections", "loft", "evidence"],
)
def test_pictures_show_something(
    shaft: Reconstruction, draw: Callable[[Reconstruction], Figure], colours: list[str]
) -> None:
    picture = pixels(draw(shaft))
    assert 0.01 < (picture.min(axis=2) < 0.9).mean() < 0.8
    assert all(shows(picture, colour) for colour in colours)


def test_overview_tells_bodies_apart(pair: Reconstruction) -> None:
    picture = pixels(overview_figure(pair, unit="cm"))
    assert all(shows(picture, colour) for colour in BODIES[:2])
    assert not shows(picture, CLOUD, 0.05)


def test_distance_figure_marks_every_plane(shaft: Reconstruction) -> None:
    body = only(shaft)
    ax = distance_figure(shaft, body, unit="mm").axes[0]
    assert ax.get_xlabel() == "z [mm]"
    assert ax.get_ylabel() == "distance to the central axis [mm]"
    drawn = next(one for one in ax.collections if one.get_label() == "slice planes")
    at = np.sort([np.asarray(path.vertices)[0, 0] for path in drawn.get_paths()])
    assert at == pytest.approx(body.planes.heights + shaft.cloud.centre[2])


def test_contact_sheet_names_each_slice(ell: Reconstruction) -> None:
    body = only(ell)
    figure = sections_figure(ell, body, unit="mm", most=5)
    titles = [ax.get_title().strip() for ax in figure.axes if ax.axison]
    assert len(titles) == 5
    assert titles[0].startswith("slice 0: ")
    assert titles[-1] == f"slice {len(body.sections) - 1}: {body.sections[-1].shape.kind}"


def test_probe_rests_on_two_edge_points(ell: Reconstruction) -> None:
    body = only(ell)
    figure = sections_figure(ell, body, unit="mm", most=1)
    ball, edge = figure.axes[0].patches[0], body.edges[0]
    distance = np.linalg.norm(pose_of(ell, body).in_plan(edge.points) - ball.center, axis=1)  # type: ignore[attr-defined]
    assert np.sort(distance)[:2] == pytest.approx(edge.probe_radius)


def test_directions_side_by_side(ell: Reconstruction) -> None:
    sliced = [lofted("l-shape", 1500, axis) for axis in ((1, 0, 0), (0, 1, 0))]
    figure = directions_figure([*sliced, ell], unit="mm")
    above = [ax for ax in figure.axes if ax.get_title().startswith("sliced")]
    assert [ax.get_title().strip() for ax in above] == [f"sliced along {a}" for a in "xyz"]
    assert [ax.title.get_fontweight() for ax in above] == ["normal", "normal", "bold"]
    said = [next(t.get_text() for t in ax.texts if t.get_text().startswith("target")) for ax in above]
    targets = [float(re.findall(r"[\d.]+", text)[0]) for text in said]
    assert targets[2] < min(targets[:2])
    assert "chosen automatically" in said[2]
    with pytest.raises(UsageError, match="one for each direction"):
        directions_figure([], unit="mm")


def test_faces_have_the_colour_of_their_kind(shaft: Reconstruction) -> None:
    body = only(shaft)
    mesh, colours = coloured_faces(body.solid, shaft.cloud.centre)
    assert mesh.volume == pytest.approx(body.facts.volume, rel=0.01)
    first, last = (
        section.shape.evaluate(np.arange(256) / 256) for section in body.sections[:: len(body.sections) - 1]
    )
    share = np.array(to_rgb(FACES["Plane"]))
    plane = np.isclose(colours / colours[:, :1], share / share[0]).all(axis=1)
    assert mesh.areas[plane].sum() == pytest.approx(ring_area(first) + ring_area(last), rel=0.01)
    labels = [patch.get_label() for patch in face_legend([body.solid])]
    assert labels == [f"{body.facts.faces['BSplineSurface']} B-spline faces", "2 plane faces"]
    both = joined([mesh, mesh])
    assert both.volume == pytest.approx(2 * mesh.volume)


# What they are made of


def test_evidence_of_a_slice(shaft: Reconstruction) -> None:
    body = only(shaft)
    slices = slice_evidence(body)
    one, shape = slices[3], body.sections[3].shape
    distance = shape.distance(body.edges[3].points)
    assert one.rms == pytest.approx(np.sqrt((distance**2).mean()))
    assert one.scatter == pytest.approx(distance.std())
    everything = np.concatenate(
        [s.shape.distance(e.points) for s, e in zip(body.sections, body.edges, strict=True)]
    )
    assert total_rms(slices) == pytest.approx(np.sqrt((everything**2).mean()))
    assert [s.index for s in slices if s.is_key][0 :: len(slices)] == [0]
    exact = replace(one, rms=1.0, mean=-1.0)
    assert exact.scatter == 0


@pytest.mark.parametrize(
    ("direction", "right", "up", "labels"),
    [
        ((0, 0, 1), (1, 0, 0), (0, 1, 0), ("x [mm]", "y [mm]", "z [mm]")),
        ((1, 0, 0), (0, 1, 0), (0, 0, 1), ("y [mm]", "z [mm]", "x [mm]")),
        ((0, 1, 0), (0, 0, 1), (1, 0, 0), ("z [mm]", "x [mm]", "y [mm]")),
        ((0, 0, -1), (0, 1, 0), (1, 0, 0), ("y [mm]", "x [mm]", f"{MINUS}z [mm]")),
    ],
)
def test_plan_shows_the_axes_of_the_cloud(
    direction: tuple[int, ...], right: tuple[int, ...], up: tuple[int, ...], labels: tuple[str, ...]
) -> None:
    z = np.array(direction, dtype=float)
    x = np.cross(up, z) * 0.6 + np.array(up) * 0.8
    frame = Frame(np.stack([x, np.cross(z, x), z]))
    centre = np.array([10.0, 20.0, 30.0])
    pose = Pose(frame, centre)
    there = np.array([[1.0, 2.0, 3.0], [-4.0, 5.0, 0.5]])
    local = frame.to_local(there)
    assert pose.labels("mm") == labels
    assert pose.in_plan(local[:, :2])[:, 0] == pytest.approx((there + centre) @ right)
    assert pose.in_plan(local[:, :2])[:, 1] == pytest.approx((there + centre) @ up)
    assert pose.height(local[:, 2]) == pytest.approx((there + centre) @ direction)
    assert pose.in_space(local) == pytest.approx(there)


def test_slanted_direction_has_plain_labels() -> None:
    z = np.array([0.6, 0.0, 0.8])
    y = np.array([0.0, 1.0, 0.0])
    pose = Pose(Frame(np.stack([np.cross(y, z), y, z])), np.zeros(3))
    assert pose.labels("m") == ("across [m]", "across [m]", "height along the slicing direction [m]")
    assert direction_words(z) == "(0.600, 0.000, 0.800)"
    assert axis_name(-np.eye(3)[1]) == f"{MINUS}y"


def test_numbers_in_words() -> None:
    assert [number(v) for v in (0, 1.23456, -12345.6, 0.5, 1e-5, 2.5e7)] == [
        "0", "1.235", f"{MINUS}12346", "0.5000", "1.000·10⁻⁵", "2.500·10⁷",
    ]  # fmt: skip
    assert [number(np.inf), number(-np.inf)] == ["∞", f"{MINUS}∞"]
    assert [place(v, 20) for v in (0.00001, -0.00001, -3.98765)] == ["0.000", "0.000", f"{MINUS}3.988"]
    assert place(123456.7, 1e7) == "123457"
    assert [counted(1, "face"), counted(2000, "face"), counted(2, "body", "bodies")] == [
        "1 face", "2,000 faces", "2 bodies",
    ]  # fmt: skip


@given(st.floats(min_value=1e-12, max_value=1e12))
def test_round_length_is_round_and_no_longer(length: float) -> None:
    found = round_length(length)
    assert found <= length * (1 + 1e-9)
    assert length < 2.0001 * found
    assert f"{found:e}"[:8] in ("1.000000", "2.000000", "3.000000", "5.000000")


def test_sizes_of_shapes() -> None:
    ring = np.stack([np.cos(np.arange(64) * np.pi / 32), np.sin(np.arange(64) * np.pi / 32)], axis=1)
    assert shape_size(Circle(np.zeros(2), 2.0), "mm") == "radius 2.000 mm"
    assert (
        shape_size(Ellipse(np.zeros(2), np.array([2.0, 1.0]), 0.0), "cm")
        == f"semi-axes 2.000 {TIMES} 1.000 cm"
    )
    assert (
        shape_size(Rectangle(np.zeros(2), np.array([2.0, 1.0]), 0.0), "m") == f"sides 4.000 {TIMES} 2.000 m"
    )
    assert shape_size(fit_spline(ring, 8), "in").endswith(" in², 8 control points")


def test_thinning_keeps_an_even_sample() -> None:
    points = np.arange(100.0)
    assert np.array_equal(thinned(points, 200), points)
    assert np.array_equal(thinned(points, 40), points[::3])
