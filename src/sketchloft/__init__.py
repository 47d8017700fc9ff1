"""sketchloft: from a cloud of points drawn in mid-air to a CAD solid."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from sketchloft.brep.files import load_mesh, write_model
    from sketchloft.brep.model import NamedSolid
    from sketchloft.cloud import PointCloud
    from sketchloft.errors import SketchloftError
    from sketchloft.io import read_cloud, write_cloud
    from sketchloft.measurement import Measurement, measure
    from sketchloft.mesh import Mesh
    from sketchloft.pipeline import Params, Reconstruction, reconstruct

__version__ = "0.1.0"

# Loaded when first asked for, so that `sketchloft --help` need not wait for numpy and the CAD kernel.
_HOMES = {
    "Measurement": "sketchloft.measurement",
    "Mesh": "sketchloft.mesh",
    "NamedSolid": "sketchloft.brep.model",
    "Params": "sketchloft.pipeline",
    "PointCloud": "sketchloft.cloud",
    "Reconstruction": "sketchloft.pipeline",
    "SketchloftError": "sketchloft.errors",
    "load_mesh": "sketchloft.brep.files",
    "measure": "sketchloft.measurement",
    "read_cloud": "sketchloft.io",
    "reconstruct": "sketchloft.pipeline",
    "write_cloud": "sketchloft.io",
    "write_model": "sketchloft.brep.files",
}

__all__ = [
    "Measurement",
    "Mesh",
    "NamedSolid",
    "Params",
    "PointCloud",
    "Reconstruction",
    "SketchloftError",
    "load_mesh",
    "measure",
    "read_cloud",
    "reconstruct",
    "write_cloud",
    "write_model",
]


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module 'sketchloft' has no attribute '{name}'")
    return getattr(importlib.import_module(_HOMES[name]), name)
