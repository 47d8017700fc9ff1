"""The command line as a user runs it: results, exit codes, nothing half-written."""

import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from sketchloft.cli import _exit_code
from sketchloft.remarks import ranges

RNG = np.random.default_rng(0)
CUBE = RNG.random((3000, 3))
PAPER = ["--method", "paper"]
INTERRUPTIBLE = """
import signal
from sketchloft.cli import main
signal.signal(signal.SIGINT, signal.default_int_handler)  # what runs in the background may ignore interrupts
main()
"""
both_methods = pytest.mark.parametrize("method", ["exact", "paper"])


def run(*arguments: str, capsys: pytest.CaptureFixture[str]) -> tuple[int, str, str]:
    code = _exit_code(list(arguments))
    out, err = capsys.readouterr()
    return code, out, err


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def cube(here: Path) -> str:
    np.savetxt(here / "cube.xyz", CUBE)
    return "cube.xyz"


@pytest.mark.skipif(os.name != "posix", reason="sends a signal to a process group")
def test_an_interrupt_ends_the_command_and_who_helps_it(cube: str, here: Path) -> None:
    begun = subprocess.Popen(
        [sys.executable, "-c", INTERRUPTIBLE, "build", cube, "-v", "--workers", "1"],
        stderr=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    assert begun.stderr is not None
    assert begun.stderr.readline().startswith("read: ")
    os.killpg(begun.pid, signal.SIGINT)
    out, said = begun.communicate(timeout=60)  # which waits for whoever holds the pipes
    assert (begun.returncode, out) == (130, "")
    assert said.splitlines()[-1] == "sketchloft: interrupted; nothing was written"
    assert "Traceback" not in said
    assert not list(here.glob("*.step"))


def test_workers_change_no_byte(cube: str, here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for count in ("0", "1"):
        assert run("build", cube, "-o", f"m{count}.step", "--workers", count, capsys=capsys)[0] == 0
    assert (here / "m0.step").read_bytes() == (here / "m1.step").read_bytes()
    assert run("build", cube, "--workers", "-1", capsys=capsys)[0] == 2


@both_methods
def test_sample_build_measure_info(method: str, here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    code, out, _ = run("sample", "lamp", "-n", "3000", "-o", "lamp.ply", "--goal", "goal.step", capsys=capsys)
    assert code == 0
    assert "3000 points" in out
    asked = ("--method", method, "--axis", "z", "-o", "m.step", "-o", "m.stl")
    code, out, err = run("build", "lamp.ply", *asked, capsys=capsys)
    assert (code, err) == (0, "")
    assert "valid solid" in out
    assert "written: m.step, m.stl" in out
    code, out, _ = run("measure", "m.step", "goal.step", "-p", "error.png", "--json", capsys=capsys)
    assert code == 0
    measured = json.loads(out)
    assert measured["unit"] == "mm"
    assert measured["thousandths"]["model_to_goal"]["rms"] < (1 if method == "exact" else 4)
    assert (here / "error.png").stat().st_size > 10_000
    for file, said in (
        ("lamp.ply", "points         3000"),
        ("m.step", "solids         1"),
        ("m.stl", "triangles"),
    ):
        code, out, _ = run("info", file, capsys=capsys)
        assert code == 0
        assert said in out


FOUND = {
    "exact": ("evidence: ", {"runs", "noise"}),
    "paper": ("slice planes: 0.", {"slices", "shapes"}),
}


@pytest.mark.parametrize("method", FOUND)
def test_json_is_the_only_thing_on_standard_output(
    method: str, cube: str, capsys: pytest.CaptureFixture[str]
) -> None:
    said, keys = FOUND[method]
    code, out, err = run("build", cube, "--method", method, "--json", "-v", capsys=capsys)
    assert code == 0
    facts = json.loads(out)
    assert facts["written"] == ["cube.step"]
    assert facts["points"] == {"read": 3000, "not_finite": 0, "repeated": 0, "used": 3000}
    assert facts["bodies"][0]["valid"] is True
    assert facts["bodies"][0]["volume"] == pytest.approx(1, rel=0.03)
    common = {"name", "points", "direction", "faces", "volume", "area", "bounds", "valid"}
    assert set(facts["bodies"][0]) == common | keys
    assert said in err


def test_without_a_method_it_is_exact(cube: str, capsys: pytest.CaptureFixture[str]) -> None:
    code, out, _ = run("build", cube, "--axis", "z", "--json", capsys=capsys)
    assert code == 0
    (body,) = json.loads(out)["bodies"]
    assert body["runs"] == [["rectangle"]]
    assert body["faces"] == {"Plane": 6}
    assert body["volume"] == pytest.approx(1, rel=0.005)


def test_unit_is_written_and_read_back(cube: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("build", cube, "--unit", "in", "-o", "m.step", capsys=capsys)[0] == 0
    code, out, _ = run("info", "m.step", "--json", capsys=capsys)
    assert code == 0
    facts = json.loads(out)
    assert facts["unit"] == "in"
    assert facts["cube"]["volume"] == pytest.approx(1, rel=0.03)


@both_methods
def test_a_report(method: str, cube: str, here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    code, out, _ = run("build", cube, "--method", method, "--report", "report.html", capsys=capsys)
    assert code == 0
    assert "report.html" in out
    assert "<html" in (here / "report.html").read_text(encoding="utf-8")


def test_compare(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    run("sample", "cylinder", "-n", "1500", "--goal", "goal.step", capsys=capsys)
    code, out, _ = run(
        "compare", "cylinder.ply", "--goal", "goal.step", "--radii", "0.001,1.5", "-p", "c.png", capsys=capsys
    )
    assert code == 0
    assert out.count("\nslice and loft") == 2
    assert out.count("\n3D alpha shape") == 2
    assert (here / "c.png").exists()


def test_options_from_a_toml_file(cube: str, here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (here / "options.toml").write_text(
        '[build]\nmethod = "paper"\naxis = "x"\nshapes = "off"\noutput = ["t.step"]\njson = true\n'
    )
    code, out, _ = run("build", cube, "--config", "options.toml", capsys=capsys)
    assert code == 0
    facts = json.loads(out)
    assert facts["written"] == ["t.step"]
    assert facts["bodies"][0]["direction"] == [1, 0, 0]
    assert list(facts["bodies"][0]["shapes"]) == ["spline"]
    code, out, _ = run("build", cube, "--config", "options.toml", "--axis", "y", capsys=capsys)
    assert json.loads(out)["bodies"][0]["direction"] == [0, 1, 0]
    code, out, _ = run("build", cube, "--config", "options.toml", "--method", "exact", capsys=capsys)
    assert json.loads(out)["bodies"][0]["direction"] == [1, 0, 0]
    assert "runs" in json.loads(out)["bodies"][0]


def test_remarks_go_to_standard_error_and_quiet_keeps_them(
    here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    np.savetxt(here / "twice.xyz", np.r_[CUBE, CUBE[:7]])
    assert "7 of 3007 points are repeats" in run("build", "twice.xyz", capsys=capsys)[2]
    assert run("build", "twice.xyz", "-q", capsys=capsys)[2] == ""


def test_settings_that_the_method_has_no_use_for_are_named(
    here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    np.savetxt(here / "cube.xyz", CUBE)
    said = run("build", "cube.xyz", "--loft", "smooth", "--per-slice", "300", capsys=capsys)[2]
    assert "slice planes, loft: what was set for this is for the paper's method" in said
    assert "paper" not in run("build", "cube.xyz", capsys=capsys)[2]


def test_a_folder_is_no_cloud(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("build", ".", capsys=capsys)[0] == 3
    code, _, said = run("build", str(here), capsys=capsys)
    assert (code, "is a folder, expected a file" in said) == (3, True)


BAD_CLOUDS = {
    "empty.xyz": (b"", 3, "is empty"),
    "words.xyz": (b"hello world\n", 3, "neither a row of numbers nor a header"),
    "cut.npy": (b"\x93NUMPY\x01\x00v\x00", 3, "cut"),
    "one.xyz": (b"1 2 3\n", 4, "found 1 distinct points"),
    "equal.xyz": (b"1 2 3\n" * 10_000, 4, "9999 repeated"),
    "nan.xyz": (b"nan nan nan\n" * 100, 4, "100 not finite"),
    "line.xyz": ("\n".join(f"{i} {2 * i} {-i}" for i in range(200)).encode(), 4, "one straight line"),
    "flat.xyz": ("\n".join(f"{i % 20} {i // 20} 5" for i in range(400)).encode(), 4, "lie on a plane"),
    "cloud.foo": (b"1 2 3\n", 3, "no cloud format has the extension .foo"),
}


@pytest.mark.parametrize("name", BAD_CLOUDS)
def test_a_bad_cloud_gets_one_sentence_and_leaves_nothing(
    name: str, here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    content, expected, said = BAD_CLOUDS[name]
    (here / name).write_bytes(content)
    code, out, err = run("build", name, "-o", "model.step", capsys=capsys)
    assert (code, out) == (expected, "")
    assert said in err
    assert err.count("\n") == 1
    assert "Traceback" not in err
    assert [file.name for file in here.iterdir()] == [name]


def test_a_cloud_far_from_the_origin(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    np.savetxt(here / "far.xyz", CUBE + 1e9, fmt="%.6f")
    code, _, err = run("build", "far.xyz", capsys=capsys)
    assert code == 4
    assert "subtract its centre" in err


@pytest.mark.parametrize(
    ("arguments", "expected", "said"),
    [
        (["--axis", "q"], 2, "axis: found 'q'"),
        (["--per-slice", "3"], 2, "per slice: found '3'"),
        (["--method", "best"], 2, "best"),
        ([*PAPER, "--per-slice", "2900"], 5, "slice planes: found 2900 points per slice"),
        (["--probe-radius", "0"], 2, "probe radius"),
        ([*PAPER, "--probe-radius", "0.001"], 5, "edge points, slice 0: a probe of radius 0.001 leaves"),
        (["--shapes", "round"], 2, "shapes: found 'round'"),
        ([*PAPER, "--shapes", "99:circle"], 2, "shapes: found slices 99"),
        (["--bodies", "12"], 2, "bodies: found '12'"),
        (["--unit", "ft"], 2, "ft"),
        (["--loft", "bent"], 2, "bent"),
        (["--nothing"], 2, "--nothing"),
        (["-o", "missing/model.step"], 7, "the folder missing does not exist"),
        (["-o", "model.foo"], 7, "the extension .foo"),
        (["-o", "."], 7, "extension"),
        (["--report", "missing/report.html"], 7, "the folder missing does not exist"),
        (["--config", "missing.toml"], 2, "missing.toml"),
    ],
)
def test_a_bad_option_gets_one_sentence_and_leaves_nothing(
    arguments: list[str], expected: int, said: str, cube: str, capsys: pytest.CaptureFixture[str]
) -> None:
    code, out, err = run("build", cube, *arguments, capsys=capsys)
    assert (code, out) == (expected, "")
    assert said in err
    assert err.count("\n") == 1
    assert [file.name for file in Path.cwd().iterdir()] == [cube]


def test_a_probe_larger_than_the_section_is_said(cube: str, capsys: pytest.CaptureFixture[str]) -> None:
    code, _, err = run("build", cube, *PAPER, "--probe-radius", "50", capsys=capsys)
    assert code == 0
    assert "the probe radius is larger than the section" in err


def test_missing_files_and_folders(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (here / "folder.xyz").mkdir()
    assert run("build", "missing.xyz", capsys=capsys)[0] == 3
    assert run("build", "folder.xyz", capsys=capsys)[0] == 3
    assert run("measure", "missing.step", "missing.stl", capsys=capsys)[0] == 3
    assert run("info", "missing.ply", capsys=capsys)[0] == 3


def test_help_is_quick_because_nothing_heavy_is_loaded() -> None:
    script = "import sys; from sketchloft import cli; cli._exit_code(['--help']); print(sorted(sys.modules))"
    out = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True).stdout
    assert "Usage: sketchloft" in out
    for heavy in ("'numpy'", "'scipy'", "'OCP'", "'matplotlib'", "'polars'", "'sketchloft.pipeline'"):
        assert heavy not in out


def test_the_installed_command_and_its_version() -> None:
    command = Path(sys.executable).with_name("sketchloft")
    out = subprocess.run([command, "--version"], capture_output=True, text=True, check=True).stdout
    assert out.strip() == "0.1.0"


def test_ranges() -> None:
    assert ranges([0, 1, 2, 5, 7, 8]) == "0-2, 5, 7-8"
    assert ranges([4]) == "4"
