"""Palette: one colour for each kind of thing, the same in all pictures, safe for the colour-blind."""

from __future__ import annotations

__all__ = [
    "BODIES",
    "CLOUD",
    "CURVES",
    "EDGE",
    "FACES",
    "GRID",
    "INK",
    "KEY",
    "MUTED",
    "OTHER_FACE",
    "PLANE",
    "PROBE",
    "QUIET",
    "SURFACE",
]

INK = "#1f2933"
MUTED = "#5f6c7b"
GRID = "#e4e8ed"
QUIET = "#c3cbd5"

# The red and the blue of the error map: the paper draws the cloud red, surface and edge points blue.
CLOUD = "#d6604d"
SURFACE = "#2166ac"
EDGE = SURFACE
PLANE = "#9a9da1"
KEY = "#e08214"
PROBE = "#009e73"

CURVES = {"circle": "#0072b2", "ellipse": "#009e73", "rectangle": "#e69f00", "spline": "#b65a91"}
"""Section curves by kind of shape (after Okabe and Ito, Color Universal Design, 2008)."""

FACES = {
    "BSplineSurface": "#a9c1dd",
    "Plane": "#eed9a6",
    "CylindricalSurface": "#94cdbb",
    "ConicalSurface": "#e5ad80",
    "SphericalSurface": "#cfa9c9",
    "ToroidalSurface": "#c9cf8e",
    "SurfaceOfRevolution": "#8fa6d6",
    "SurfaceOfLinearExtrusion": "#c4b3a2",
}
"""Faces by kind of surface, light enough to carry light and shadow."""
OTHER_FACE = "#c8c8c8"

BODIES = (
    "#77aadd", "#ee8866", "#44bb99", "#eedd88", "#b49ad0",
    "#99ddff", "#ffaabb", "#bbcc33", "#aaaa00", "#bbbbbb",
)  # fmt: skip
"""Bodies by number (after P. Tol, Colour schemes, 2021, "light")."""
