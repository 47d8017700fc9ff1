"""The layout of the house: imports run one way."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import sketchloft

EXACT = Path(sketchloft.__file__).parent / "exact"
ORDER = ["model", "fit", "section", "changes", "start", "search"]


@pytest.mark.parametrize("package", ORDER)
def test_packages_of_the_exact_method_build_on_those_before_them(package: str) -> None:
    files = sorted((EXACT / package).glob("*.py"))
    assert len(files) > 1
    for file in files:
        used = set(re.findall(r"sketchloft\.exact\.(\w+)", file.read_text("utf-8")))
        assert used <= set(ORDER[: ORDER.index(package) + 1]), file.name


def test_every_package_has_its_place() -> None:
    assert sorted(path.parent.name for path in EXACT.glob("*/__init__.py")) == sorted(ORDER)
