"""Loading: modules come in, and the collector is as it was."""

from __future__ import annotations

import gc
import sys

import pytest

from sketchloft.loading import load


@pytest.mark.parametrize("collects", [True, False])
def test_the_collector_is_left_as_it_was(collects: bool) -> None:
    before = gc.isenabled()
    try:
        (gc.enable if collects else gc.disable)()
        load(("colorsys", "sketchloft.ring"))
        assert gc.isenabled() == collects
        with pytest.raises(ModuleNotFoundError):
            load(("this_is_none",))
        assert gc.isenabled() == collects
    finally:
        (gc.enable if before else gc.disable)()
    assert {"colorsys", "sketchloft.ring"} <= set(sys.modules)
