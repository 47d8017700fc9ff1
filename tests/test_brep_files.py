"""Models in files: what the text holds, what comes back, and what is refused."""

from __future__ import annotations

import functools
import json
import os
import re
import struct
import subprocess
import sys
import xml.etree.ElementTree as ET
import zipfile
from pathlib import Path

import numpy as np
import pytest

from sketchloft.brep.check import check_closed
from sketchloft.brep.facts import solid_facts
from sketchloft.brep.files import check_outputs, load_mesh, read_model, write_model
from sketchloft.brep.format import MODEL_FORMATS, ModelFormat
from sketchloft.brep.model import METRES, Fineness, Model, NamedSolid
from sketchloft.brep.place import placed
from sketchloft.brep.primitives import fuse
from sketchloft.brep.solid import Solid, loft_solid
from sketchloft.brep.step_file import write as write_step
from sketchloft.brep.tessellate import tessellate
from sketchloft.cloud import UNITS, Unit
from sketchloft.errors import InputError, OutputError
from sketchloft.mesh import Mesh
from sketchloft.sample.primitives import Ball, Prism
from skins import prism, wavy

SQUARE = ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5))
COARSE = Fineness(chord=2e-3, angle=0.5)
NAME = "Vögelhäuschen 鳥 \N{BIRD} it's #1"
SOLIDS = [one for one in MODEL_FORMATS if one.reads == "solids"]
SUFFIXES = [suffix for one in MODEL_FORMATS for suffix in one.suffixes]


@functools.cache
def vase() -> Solid:
    return loft_solid(wavy())


@functools.cache
def box() -> Solid:
    return fuse([Prism(SQUARE, 2.0, 3.0)])


def bodies() -> list[NamedSolid]:
    return [NamedSolid(NAME, vase()), NamedSolid("box", box())]


def step_text(tmp_path: Path, unit: Unit = "mm", solids: list[NamedSolid] | None = None) -> str:
    path = tmp_path / "model.step"
    write_model(path, bodies() if solids is None else solids, unit)
    return re.sub(r"\s*\n\s*", "", path.read_text("ascii"))


# ---- the STEP text --------------------------------------------------------------------------
def test_step_holds_schema_products_solids_and_surfaces(tmp_path: Path) -> None:
    text = step_text(tmp_path)
    assert "FILE_SCHEMA(('AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM_LF" in text
    assert text.count("MANIFOLD_SOLID_BREP(") == 2
    assert text.count("= CLOSED_SHELL(") == 2
    assert text.count("B_SPLINE_SURFACE_WITH_KNOTS(") == 7  # one a band
    assert text.count("= ADVANCED_FACE(") == (7 + 2) + 6
    assert text.count("= PLANE(") >= 2 + 6
    names = re.findall(r"= PRODUCT\('((?:[^']|'')*)'", text)
    assert names[1] == "box"
    assert names[0] == r"V\X2\00F6\X0\gelh\X2\00E4\X0\uschen \X2\9CE5\X0\ \X4\0001F426\X0\ it''s #1"


@pytest.mark.parametrize(
    ("unit", "entity"),
    [
        ("mm", "LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.)"),
        ("cm", "LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.CENTI.,.METRE.)"),
        ("m", "LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT($,.METRE.)"),
        ("in", "CONVERSION_BASED_UNIT('INCH'"),
    ],
)
def test_step_numbers_are_those_of_the_cloud_in_its_unit(tmp_path: Path, unit: Unit, entity: str) -> None:
    text = step_text(tmp_path, unit, [NamedSolid("box", box())])
    assert entity in text.replace(" ", "")
    points = re.findall(r"VERTEX_POINT\('',(#\d+)\)", text)
    places = dict(re.findall(r"(#\d+) = CARTESIAN_POINT\('',\((.*?)\)\)", text))
    assert {tuple(map(float, places[at].split(","))) for at in points} == {
        (x, y, z) for x, y in SQUARE for z in (2.0, 5.0)
    }


def test_step_header_is_ours_and_its_time_can_be_set(tmp_path: Path) -> None:
    text = step_text(tmp_path, "mm", [NamedSolid("box", box())])
    assert "FILE_NAME('box','2000-01-01T00:00:00',(''),('')," in text
    assert "'sketchloft'" in text
    model = Model((NamedSolid("box", box()),))
    assert b"'2026-05-04T03:02:01'" in write_step(model, tuple, time_stamp="2026-05-04T03:02:01")


# ---- round trips ----------------------------------------------------------------------------
@pytest.mark.parametrize("unit", UNITS)
@pytest.mark.parametrize("form", SOLIDS, ids=lambda form: form.name)
def test_solids_come_back_whole(tmp_path: Path, form: ModelFormat, unit: Unit) -> None:
    path = tmp_path / f"modèle{form.suffixes[0]}"
    write_model(path, bodies(), unit)
    model = read_model(path)
    expected = [solid_facts(body.solid) for body in bodies()]
    assert len(model.bodies) == 2
    for body, facts in zip(model.bodies, expected, strict=True):
        check_closed(body.solid)
        found = solid_facts(body.solid)
        assert (found.faces, found.edges) == (facts.faces, facts.edges)
        assert found.volume == pytest.approx(facts.volume, rel=1e-6)
        assert found.area == pytest.approx(facts.area, rel=1e-6)
    names = [body.name for body in model.bodies]
    if path.suffix == ".step":
        assert names == [NAME, "box"]
        assert model.unit == unit
    elif path.suffix == ".iges":
        assert names == ["Vogelhauschen _ _ it's #1", "box"]
        assert model.unit == unit
    else:
        assert names == ["solid 1", "solid 2"]
        assert model.unit is None


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e5])
@pytest.mark.parametrize("offset", [0.0, 1e4])
@pytest.mark.parametrize("unit", ["mm", "m"])
def test_step_is_valid_and_to_scale_at_any_size(
    tmp_path: Path, size: float, offset: float, unit: Unit
) -> None:
    path = tmp_path / "model.step"
    solid = placed(vase(), size, np.array([1.0, -0.5, 0.3]) * offset * size)
    write_model(path, [NamedSolid("vase", solid)], unit)
    back = read_model(path).bodies[0].solid
    check_closed(back)
    found, expected = solid_facts(back), solid_facts(vase())
    assert found.volume == pytest.approx(expected.volume * size**3, rel=1e-7)
    assert np.ptp(found.bounds, axis=0) == pytest.approx(np.ptp(expected.bounds, axis=0) * size, rel=1e-6)


def test_stl_comes_back_with_the_same_triangles(tmp_path: Path) -> None:
    path = tmp_path / "model.stl"
    write_model(path, [NamedSolid("vase", vase())], fineness=COARSE)
    mesh, back = tessellate(vase(), COARSE.chord, COARSE.angle), load_mesh(path)
    assert len(back.vertices) == len(mesh.vertices)
    assert back.corners == pytest.approx(mesh.corners, abs=1e-7)
    assert path.read_bytes()[:80].startswith(b"sketchloft, coordinates in mm")


def _ascii_stl(mesh: Mesh) -> str:
    facets = []
    for corners in mesh.corners:
        loop = "".join(f"      vertex {x:.9e} {y:.9e} {z:.9e}\n" for x, y, z in corners)
        facets.append(f"  facet normal 0 0 0\n    outer loop\n{loop}    endloop\n  endfacet\n")
    return f"solid thing\n{''.join(facets)}endsolid thing\n"


def test_ascii_stl_is_read(tmp_path: Path) -> None:
    mesh = tessellate(box())
    path = tmp_path / "box.STL"
    path.write_text(_ascii_stl(mesh))
    back = load_mesh(path)
    assert len(back.vertices) == 8
    assert back.volume == pytest.approx(3)


def test_glb_is_in_metres_and_y_up(tmp_path: Path) -> None:
    path = tmp_path / "model.glb"
    write_model(path, bodies(), "cm", COARSE)
    data = path.read_bytes()
    magic, version, length = struct.unpack_from("<4sII", data)
    assert (magic, version, length) == (b"glTF", 2, len(data))
    size, kind = struct.unpack_from("<I4s", data, 12)
    assert kind == b"JSON"
    tree = json.loads(data[20 : 20 + size])
    binary = data[28 + size :]
    assert tree["buffers"][0]["byteLength"] == len(binary) == struct.unpack_from("<I", data, 20 + size)[0]
    root, *nodes = tree["nodes"]
    assert [node["name"] for node in nodes] == [NAME, "box"]
    assert root["children"] == [1, 2]
    x, _, _, w = root["rotation"]
    assert 2 * np.degrees(np.arctan2(x, w)) == pytest.approx(-90)
    for node, body in zip(nodes, bodies(), strict=True):
        primitive = tree["meshes"][node["mesh"]]["primitives"][0]
        arrays = []
        for number, dtype in ((primitive["attributes"]["POSITION"], "<f4"), (primitive["indices"], "<u4")):
            view = tree["bufferViews"][tree["accessors"][number]["bufferView"]]
            part = binary[view["byteOffset"] : view["byteOffset"] + view["byteLength"]]
            arrays.append(np.frombuffer(part, dtype).reshape(-1, 3))
        mesh = tessellate(body.solid, COARSE.chord, COARSE.angle)
        places = arrays[0] + np.array(node["translation"])
        assert np.array_equal(arrays[1], mesh.triangles)
        assert places == pytest.approx(mesh.vertices * METRES["cm"], abs=1e-9)
        box_ = tree["accessors"][primitive["attributes"]["POSITION"]]
        assert box_["min"] == pytest.approx(arrays[0].min(axis=0))
        assert box_["max"] == pytest.approx(arrays[0].max(axis=0))


@pytest.mark.parametrize(
    ("unit", "word"), [("mm", "millimeter"), ("cm", "centimeter"), ("m", "meter"), ("in", "inch")]
)
def test_3mf_holds_named_objects_in_the_unit(tmp_path: Path, unit: Unit, word: str) -> None:
    path = tmp_path / "model.3mf"
    write_model(path, [NamedSolid('a "b" <c> & ß', box()), NamedSolid("d", box())], unit)
    with zipfile.ZipFile(path) as package:
        assert package.testzip() is None
        assert package.namelist()[0] == "[Content_Types].xml"
        for part in package.namelist():
            ET.fromstring(package.read(part))
        tree = ET.fromstring(package.read("3D/3dmodel.model"))
    assert tree.get("unit") == word
    space = {"m": "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"}
    objects = tree.findall("m:resources/m:object", space)
    assert [one.get("name") for one in objects] == ['a "b" <c> & ß', "d"]
    assert [item.get("objectid") for item in tree.findall("m:build/m:item", space)] == ["1", "2"]
    vertices = [[float(one.attrib[k]) for k in "xyz"] for one in objects[0].findall(".//m:vertex", space)]
    corners = [
        [int(one.attrib[f"v{k}"]) for k in (1, 2, 3)] for one in objects[0].findall(".//m:triangle", space)
    ]
    assert Mesh(np.array(vertices), np.array(corners)).volume == pytest.approx(3)


def test_meshes_of_two_files_can_be_had_in_one_unit(tmp_path: Path) -> None:
    paths = [tmp_path / "metres.step", tmp_path / "inches.iges", tmp_path / "plain.brep"]
    units: tuple[Unit, ...] = ("m", "in", "mm")
    for path, unit in zip(paths, units, strict=True):
        write_model(path, [NamedSolid("box", box())], unit)
    for path in paths:
        assert load_mesh(path).volume == pytest.approx(3)
    assert load_mesh(paths[0], unit="mm").volume == pytest.approx(3e9)
    assert load_mesh(paths[1], unit="mm").volume == pytest.approx(3 * 25.4**3)
    assert load_mesh(paths[2], unit="in").volume == pytest.approx(3)  # no unit of its own
    both = tmp_path / "both.step"
    write_model(both, [NamedSolid("a", box()), NamedSolid("b", fuse([Ball((9.0, 0.0, 0.0), 1.0)]))])
    assert load_mesh(both, 1e-4).volume == pytest.approx(3 + 4 / 3 * np.pi, rel=1e-3)


# ---- writing --------------------------------------------------------------------------------
@pytest.mark.parametrize("suffix", SUFFIXES)
def test_same_model_gives_same_bytes_and_stays_as_it_is(tmp_path: Path, suffix: str) -> None:
    facts = solid_facts(vase())
    written = []
    for name in ("a", "b"):
        path = tmp_path / f"{name}{suffix}"
        write_model(path, bodies(), "mm", COARSE)
        written.append(path.read_bytes())
    assert written[0] == written[1]
    assert solid_facts(vase()).volume == facts.volume
    assert {path.name for path in tmp_path.iterdir()} == {f"a{suffix}", f"b{suffix}"}


def test_another_process_gives_the_same_bytes(tmp_path: Path) -> None:
    script = (
        "import sys; from sketchloft.brep.files import write_model\n"
        "from sketchloft.brep.model import NamedSolid\n"
        "from sketchloft.brep.primitives import fuse; from sketchloft.sample.primitives import Prism\n"
        f"write_model(sys.argv[1:], [NamedSolid('box', fuse([Prism({SQUARE}, 2.0, 3.0)]))])"
    )
    outputs = [tmp_path / f"child{one.suffixes[0]}" for one in MODEL_FORMATS]
    run = subprocess.run([sys.executable, "-c", script, *outputs], capture_output=True, check=True)
    assert (run.stdout, run.stderr) == (b"", b"")
    ours = [path.with_stem("own") for path in outputs]
    write_model(ours, [NamedSolid("box", box())])
    for one, other in zip(outputs, ours, strict=True):
        assert one.read_bytes() == other.read_bytes()


def test_the_kernel_stays_off_standard_output(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    paths = [tmp_path / f"model{suffix}" for suffix in SUFFIXES]
    write_model(paths, bodies(), "m", COARSE)
    for path in paths:
        if any(path.suffix in one.suffixes and one.reads for one in MODEL_FORMATS):
            load_mesh(path, 1e-2, 0.8)
            path.write_bytes(path.read_bytes()[:-1500])
            with pytest.raises(InputError):
                load_mesh(path)
    assert capfd.readouterr() == ("", "")


def test_all_outputs_are_written_or_none(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    good, bad = tmp_path / "model.step", tmp_path / "model.stl"
    good.write_text("before")

    def full(self: Path, data: bytes) -> int:
        if self.suffix == ".stl":
            raise OSError(28, "No space left on device")
        with self.open("wb") as file:
            return file.write(data)

    monkeypatch.setattr(Path, "write_bytes", full)
    with pytest.raises(OutputError, match=r"model\.stl: cannot be written: No space left"):
        write_model([good, bad], bodies(), fineness=COARSE)
    assert good.read_text() == "before"
    assert list(tmp_path.iterdir()) == [good]


def test_outputs_that_cannot_be_are_refused_before_anything_is_written(tmp_path: Path) -> None:
    good = tmp_path / "model.step"
    cases = {
        tmp_path / "model.xyz": r"extension \.xyz .* \.step \.stp \.iges .* \.stl \.glb \.3mf",
        tmp_path / "model": r"extension \(none\)",
        tmp_path / "missing" / "model.stl": "folder .* does not exist",
        tmp_path / "folder.stl": "is a folder",
    }
    (tmp_path / "folder.stl").mkdir()
    for path, message in cases.items():
        with pytest.raises(OutputError, match=message):
            write_model([good, path], bodies())
        with pytest.raises(OutputError, match=message):
            check_outputs([path])
    assert not good.exists()
    check_outputs([good])
    with pytest.raises(OutputError, match="no solid"):
        write_model(good, [])


def test_a_folder_without_permission_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "access", lambda *_: False)  # root may write everywhere
    with pytest.raises(OutputError, match="is not writable"):
        write_model(tmp_path / "model.step", bodies())


# ---- reading what is no model ---------------------------------------------------------------
def test_missing_files_and_unknown_extensions_are_refused(tmp_path: Path) -> None:
    for suffix in (".step", ".iges", ".brep", ".stl"):
        with pytest.raises(InputError, match=rf"none{suffix}: cannot be read: No such file"):
            load_mesh(tmp_path / f"none{suffix}")
    with pytest.raises(InputError, match=r"extension \.ply .* choose one of \.step .* \.stl$"):
        load_mesh(tmp_path / "cloud.ply")
    with pytest.raises(InputError, match=r"extension \.stl .* choose one of \.step"):
        read_model(tmp_path / "mesh.stl")
    (tmp_path / "folder.step").mkdir()
    with pytest.raises(InputError, match="cannot be read: Is a directory"):
        read_model(tmp_path / "folder.step")


@pytest.mark.parametrize("suffix", [".step", ".iges", ".brep", ".stl"])
def test_half_and_garbage_files_are_refused(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"model{suffix}"
    write_model(path, [NamedSolid("vase", vase())], fineness=COARSE)
    whole = path.read_bytes()
    for share in (0.3, 0.5, 0.999):
        path.write_bytes(whole[: int(share * len(whole))])
        with pytest.raises(InputError, match="cut short"):
            load_mesh(path)
    garbage = np.random.default_rng(1).bytes(5000)
    for data in (b"", b"\n", b"hello", garbage, garbage[:50]):
        path.write_bytes(data)
        with pytest.raises(InputError, match=r"model\.\w+: is (not|cut|no)"):
            load_mesh(path)


@pytest.mark.parametrize("suffix", [".step", ".iges", ".brep"])
def test_damaged_files_do_not_bring_the_process_down(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"model{suffix}"
    write_model(path, [NamedSolid("box", loft_solid(prism(np.array(SQUARE))))])
    whole = path.read_bytes()
    rng = np.random.default_rng(3)
    refused = 0
    for _ in range(12):
        data = bytearray(whole)
        at = int(rng.integers(300, len(data) - 500))
        del data[at : at + 150]
        path.write_bytes(data)
        try:
            read_model(path)
        except InputError:
            refused += 1
    assert refused


def test_files_without_a_solid_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "model.step"
    write_model(path, [NamedSolid("box", box())])
    text = path.read_text()
    assert text.count("MANIFOLD_SOLID_BREP('',") == 1
    path.write_text(text.replace("MANIFOLD_SOLID_BREP('',", "SHELL_BASED_SURFACE_MODEL('',("))
    with pytest.raises(InputError, match=r"holds no solid|damaged"):
        read_model(path)
    head = b"solid empty\nendsolid empty\n"
    path.with_suffix(".stl").write_bytes(head)
    with pytest.raises(InputError, match="holds no triangle"):
        load_mesh(path.with_suffix(".stl"))


def test_stl_with_bad_numbers_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "model.stl"
    text = _ascii_stl(tessellate(box()))
    for bad in (text.replace("vertex 5.0", "vertex x5.0", 1), text.replace("vertex 5.0", "vertex", 1)):
        path.write_text(bad)
        with pytest.raises(InputError, match="export it again"):
            load_mesh(path)
    path.write_text(re.sub(r"vertex \S+", "vertex nan", text, count=1))
    with pytest.raises(InputError, match="not finite"):
        load_mesh(path)


def test_formats_are_listed_without_loading_the_kernel() -> None:
    script = (
        "import sys, sketchloft.brep.format as f; "
        "assert f.MODEL_FORMATS[0].name == 'STEP'; assert 'OCP' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", script], check=True)
    for one in MODEL_FORMATS:
        assert one.description
        assert all(suffix == suffix.lower() and suffix.startswith(".") for suffix in one.suffixes)
    assert len(SUFFIXES) == len(set(SUFFIXES))
