"""The README is the manual, so what it shows must run."""

import re
import shlex
from pathlib import Path

import pytest

from sketchloft.cli import _exit_code

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def blocks(language: str) -> list[str]:
    return re.findall(rf"```{language}\n(.*?)```", README, re.DOTALL)


@pytest.mark.slow
def test_the_worked_example_runs_word_for_word(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    commands = [
        line for block in blocks("sh") for line in block.splitlines() if line.startswith("sketchloft ")
    ]
    assert len(commands) >= 3
    for command in commands:
        assert _exit_code(shlex.split(command)[1:]) == 0, command
    (program,) = blocks("python")
    exec(compile(program, "README.md", "exec"), {})
    assert "lamp.step" in capsys.readouterr().out
    for file in ("lamp.ply", "goal.step", "lamp.step", "lamp.stl", "lamp.html", "error.png"):
        assert (tmp_path / file).stat().st_size > 1000


@pytest.mark.parametrize("document", ["README.md", "CONTRIBUTING.md"])
def test_every_file_that_is_named_exists(document: str) -> None:
    text = (ROOT / document).read_text(encoding="utf-8")
    named = [
        *re.findall(r"\]\(([^)]+)\)", text),
        *re.findall(r"python ((?:examples|benchmarks)/\w+\.py)", text),
    ]
    for file in named:
        assert (ROOT / file).exists(), file


def test_every_make_target_that_is_named_exists() -> None:
    targets = re.findall(r"^([a-z-]+):", (ROOT / "Makefile").read_text(encoding="utf-8"), re.MULTILINE)
    for target in re.findall(r"`?make ([a-z-]+)", README):
        assert target in targets
