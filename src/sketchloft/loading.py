"""Loading: modules that take their time to load, all at once."""

from __future__ import annotations

import gc
import importlib
from collections.abc import Iterable

__all__ = ["load"]


def load(modules: Iterable[str]) -> None:
    """Load modules by name.

    Notes
    -----
    Nothing is looked through for garbage meanwhile, nor soon after: the kernel alone makes thousands of
    types, to look through which, time and again, takes a third as long as to load it, and none is garbage.
    """
    looked_through = gc.isenabled()
    gc.disable()
    try:
        for module in modules:
            importlib.import_module(module)
    finally:
        if looked_through:
            if not gc.get_freeze_count():  # else somebody has a use for what is frozen
                gc.freeze()
                gc.unfreeze()  # whatever there is is old now
            gc.enable()
