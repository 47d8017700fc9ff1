"""GLB: binary glTF 2.0, for viewers and the web."""

from __future__ import annotations

import json
import struct
from typing import Any

import numpy as np

from sketchloft.brep.format import Meshes
from sketchloft.brep.model import METRES, Model
from sketchloft.mesh import Mesh

__all__ = ["write"]

_FLOAT, _UINT32 = 5126, 5125
_ARRAY, _ELEMENTS = 34962, 34963
_Y_UP = [-float(np.sqrt(0.5)), 0.0, 0.0, float(np.sqrt(0.5))]  # turns z up into y up


def write(model: Model, meshes: Meshes) -> bytes:
    """Make a GLB file: one named node per body, in metres and y up as glTF wants them.

    References
    ----------
    The Khronos Group, glTF 2.0 Specification, sections 3.4 (units), 3.7 (meshes), 4 (GLB).
    """
    scale = METRES[model.written_unit]
    tree: dict[str, Any] = {
        "asset": {"version": "2.0", "generator": "sketchloft"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"name": "model", "rotation": _Y_UP, "children": []}],
        "materials": [{"pbrMetallicRoughness": {"metallicFactor": 0.1, "roughnessFactor": 0.7}}],
        "meshes": [],
        "accessors": [],
        "bufferViews": [],
    }
    content = b""
    for body, mesh in zip(model.bodies, meshes(), strict=True):
        content += _add(tree, body.name, mesh, scale, len(content))
    tree["buffers"] = [{"byteLength": len(content)}]
    text = json.dumps(tree, ensure_ascii=False, separators=(",", ":")).encode("utf-8")
    text += b" " * (-len(text) % 4)
    chunks = _chunk(b"JSON", text) + _chunk(b"BIN\0", content)
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def _chunk(kind: bytes, content: bytes) -> bytes:
    return struct.pack("<I4s", len(content), kind) + content


def _add(tree: dict[str, Any], name: str, mesh: Mesh, scale: float, offset: int) -> bytes:
    """Enter a body in the tree and return its part of the buffer, which starts at `offset`."""
    # Single precision is kept for the shape: where the body lies is up to its node.
    centre = (mesh.vertices.min(axis=0) + mesh.vertices.max(axis=0)) / 2
    places = ((mesh.vertices - centre) * scale).astype("<f4")
    corners = mesh.triangles.astype("<u4")
    first = len(tree["accessors"])
    tree["bufferViews"] += [
        {"buffer": 0, "byteOffset": offset, "byteLength": places.nbytes, "target": _ARRAY},
        {
            "buffer": 0,
            "byteOffset": offset + places.nbytes,
            "byteLength": corners.nbytes,
            "target": _ELEMENTS,
        },
    ]
    tree["accessors"] += [
        {
            "bufferView": first,
            "componentType": _FLOAT,
            "count": len(places),
            "type": "VEC3",
            "min": places.min(axis=0).tolist(),
            "max": places.max(axis=0).tolist(),
        },
        {"bufferView": first + 1, "componentType": _UINT32, "count": corners.size, "type": "SCALAR"},
    ]
    primitive = {"attributes": {"POSITION": first}, "indices": first + 1, "material": 0}
    tree["meshes"].append({"name": name, "primitives": [primitive]})
    node = {"name": name, "mesh": len(tree["meshes"]) - 1, "translation": (centre * scale).tolist()}
    tree["nodes"][0]["children"].append(len(tree["nodes"]))
    tree["nodes"].append(node)
    return places.tobytes() + corners.tobytes()
