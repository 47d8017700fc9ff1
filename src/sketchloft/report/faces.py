"""Faces: the triangles of solids coloured by the kind of surface they lie on."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

import numpy as np
from matplotlib.colors import to_rgb
from matplotlib.patches import Patch

from sketchloft.brep.face_kinds import face_kinds
from sketchloft.brep.solid import Solid
from sketchloft.brep.tessellate import tessellate_faces
from sketchloft.cloud import Floats
from sketchloft.mesh import Mesh
from sketchloft.report.palette import FACES, OTHER_FACE
from sketchloft.report.words import FACE_WORDS

__all__ = ["CREASE", "coloured_faces", "face_legend", "joined"]

CHORD, ANGLE = 1e-3, 0.2
"""How closely triangles follow the surface: no farther off than half a pixel of a picture."""
CREASE = 15.0
"""Edges between triangles of one face are smoother than this, in degrees; sharper ones are edges of faces."""
SHADE = 0.94
"""Every other face is darker by this, so that neighbours of one kind are told apart."""


def coloured_faces(solid: Solid, centre: Floats) -> tuple[Mesh, Floats]:
    """Triangles of a solid about a centre, and the colour (t, 3) of each by its face's kind."""
    mesh, face = tessellate_faces(solid, CHORD, ANGLE)
    paint = np.array([to_rgb(FACES.get(kind, OTHER_FACE)) for kind in face_kinds(solid)])
    paint[1::2] *= SHADE
    return Mesh(mesh.vertices - centre, mesh.triangles), paint[face]


def joined(meshes: Sequence[Mesh]) -> Mesh:
    """Several meshes as one, so that they hide each other in a view."""
    sizes = np.array([len(mesh.vertices) for mesh in meshes])
    starts = np.cumsum(sizes) - sizes
    triangles = [mesh.triangles + start for mesh, start in zip(meshes, starts, strict=True)]
    return Mesh(np.concatenate([mesh.vertices for mesh in meshes]), np.concatenate(triangles))


def face_legend(solids: Sequence[Solid]) -> list[Patch]:
    """One patch of colour per kind of face, with its number, the most frequent first."""
    counts = Counter(kind for solid in solids for kind in face_kinds(solid))
    return [
        Patch(
            facecolor=FACES.get(kind, OTHER_FACE), edgecolor="0.4", linewidth=0.5, label=_counted(kind, count)
        )
        for kind, count in sorted(counts.items(), key=lambda item: (-item[1], item[0]))
    ]


def _counted(kind: str, count: int) -> str:
    return f"{count} {FACE_WORDS.get(kind, kind)} face{'s' if count > 1 else ''}"
