"""3MF: a zip of XML, for printing."""

from __future__ import annotations

import io
import zipfile
from xml.sax.saxutils import quoteattr

from sketchloft.brep.format import Meshes
from sketchloft.brep.model import Model
from sketchloft.cloud import Unit
from sketchloft.mesh import Mesh

__all__ = ["write"]

_UNITS: dict[Unit, str] = {"mm": "millimeter", "cm": "centimeter", "m": "meter", "in": "inch"}
_EPOCH = (1980, 1, 1, 0, 0, 0)  # of zip; a fixed date, so that the same model gives the same bytes
_XML = '<?xml version="1.0" encoding="UTF-8"?>\n'
_PACKAGE = "http://schemas.openxmlformats.org/package/2006"
_PRINTING = "http://schemas.microsoft.com/3dmanufacturing"
_TYPES = (
    f'{_XML}<Types xmlns="{_PACKAGE}/content-types">'
    '<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>'
    '<Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/>'
    "</Types>"
)
_RELATIONS = (
    f'{_XML}<Relationships xmlns="{_PACKAGE}/relationships">'
    f'<Relationship Target="/3D/3dmodel.model" Id="model" Type="{_PRINTING}/2013/01/3dmodel"/>'
    "</Relationships>"
)


def write(model: Model, meshes: Meshes) -> bytes:
    """Make a 3MF file: one named object per body, numbers in the model's unit.

    References
    ----------
    3MF Consortium, 3MF Core Specification 1.3, chapters 2 (package), 3 (units) and 4 (mesh).
    """
    named = zip(model.bodies, meshes(), strict=True)
    objects = [_object(i, body.name, mesh) for i, (body, mesh) in enumerate(named, start=1)]
    items = "".join(f'<item objectid="{i}"/>' for i in range(1, len(objects) + 1))
    text = (
        f'{_XML}<model unit="{_UNITS[model.written_unit]}" xml:lang="en-US" xmlns="{_PRINTING}/core/2015/02">'
        '<metadata name="Application">sketchloft</metadata>'
        f"<resources>{''.join(objects)}</resources><build>{items}</build></model>"
    )
    parts = {"[Content_Types].xml": _TYPES, "_rels/.rels": _RELATIONS, "3D/3dmodel.model": text}
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as package:
        for name, content in parts.items():
            entry = zipfile.ZipInfo(name, _EPOCH)
            entry.compress_type = zipfile.ZIP_DEFLATED
            package.writestr(entry, content)
    return stream.getvalue()


def _object(number: int, name: str, mesh: Mesh) -> str:
    # One format string repeated: the loop over the points runs inside it.
    places, corners = tuple(mesh.vertices.ravel().tolist()), tuple(mesh.triangles.ravel().tolist())
    vertices = '<vertex x="%.9g" y="%.9g" z="%.9g"/>' * len(mesh.vertices) % places
    triangles = '<triangle v1="%d" v2="%d" v3="%d"/>' * len(mesh.triangles) % corners
    return (
        f'<object id="{number}" type="model" name={quoteattr(name)}><mesh>'
        f"<vertices>{vertices}</vertices><triangles>{triangles}</triangles></mesh></object>"
    )
