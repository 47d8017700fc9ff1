"""STL: binary files to write, binary and ASCII ones to read."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from sketchloft.brep.format import Meshes
from sketchloft.brep.model import Model
from sketchloft.cloud import Floats
from sketchloft.errors import InputError
from sketchloft.mesh import Mesh

__all__ = ["read_mesh", "write"]

_HEAD = 84
_FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_VERTEX = re.compile(rb"^\s*vertex\s+(.*)$", re.IGNORECASE | re.MULTILINE)


def write(model: Model, meshes: Meshes) -> bytes:
    """Make a binary STL of all bodies; coordinates are rounded to single precision."""
    corners = np.concatenate([mesh.corners for mesh in meshes()])
    facets = np.zeros(len(corners), _FACET)
    facets["corners"] = corners
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    facets["normal"] = np.divide(normals, lengths, out=np.zeros_like(normals), where=lengths > 0)
    head = f"sketchloft, coordinates in {model.written_unit}".encode("ascii").ljust(80, b"\0")
    return head + np.uint32(len(facets)).tobytes() + facets.tobytes()


def read_mesh(path: Path) -> Mesh:
    """Read an STL file; corners at the same place become one vertex.

    Raises
    ------
    InputError
        If it is neither ASCII nor binary STL, holds no triangle, or was cut short.
    """
    data = path.read_bytes()
    count = int.from_bytes(data[80:_HEAD], "little") if len(data) >= _HEAD else -1
    if len(data) == _HEAD + count * _FACET.itemsize:
        corners = np.frombuffer(data, _FACET, offset=_HEAD)["corners"].astype(np.float64)
    elif data.lstrip()[:5].lower() == b"solid" and b"\0" not in data[:1000]:
        corners = _ascii_corners(data)
    elif count >= 0 and len(data) > _HEAD:
        raise InputError(
            f"is cut short or no STL file: {len(data)} bytes, {_HEAD + count * _FACET.itemsize} expected "
            f"for the {count} triangles that it announces; copy it again"
        )
    else:
        raise InputError("is not an STL file: neither ASCII nor binary; export it again")
    if not len(corners):
        raise InputError("holds no triangle; export it again")
    if not np.isfinite(corners).all():
        raise InputError("holds coordinates that are not finite; export it again")
    vertices, place = np.unique(corners.reshape(-1, 3) + 0.0, axis=0, return_inverse=True)
    return Mesh(vertices, place.reshape(-1, 3))


def _ascii_corners(data: bytes) -> Floats:
    if b"endsolid" not in data[-400:].lower():
        raise InputError("is cut short: an ASCII STL file ends with endsolid; copy it again")
    try:
        values = np.array(b" ".join(_VERTEX.findall(data)).split(), dtype=np.float64)
    except ValueError:
        raise InputError("holds a vertex that is not three numbers; export it again") from None
    if len(values) % 9:
        raise InputError(f"holds {len(values)} coordinates, expected 9 for each triangle; export it again")
    return values.reshape(-1, 3, 3)
