"""Words: how numbers, directions, shapes and faces are called in pictures and in the report."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from sketchloft.cloud import Floats, Unit
from sketchloft.shapes.circle import Circle
from sketchloft.shapes.ellipse import Ellipse
from sketchloft.shapes.rectangle import Rectangle
from sketchloft.shapes.recognise import Shape

__all__ = ["FACE_WORDS", "axis_name", "count_words", "direction_words", "number", "probe_words", "shape_size"]

FACE_WORDS = {
    "BSplineSurface": "B-spline",
    "Plane": "plane",
    "CylindricalSurface": "cylinder",
    "ConicalSurface": "cone",
    "SphericalSurface": "sphere",
    "ToroidalSurface": "torus",
}
"""What faces are called, by kind of surface."""


def number(value: float, digits: int = 4) -> str:
    """Value with so many significant digits, a real minus, and powers of ten for the very large and small."""
    if not np.isfinite(value):
        return "∞" if value > 0 else "−∞" if value < 0 else "not a number"
    size = abs(value)
    text = f"{value:#.{digits}g}" if size else "0"
    if size and not 1e-3 <= size < 10**6:
        mantissa, _, exponent = f"{value:.{digits - 1}e}".partition("e")
        text = f"{mantissa}·10{_raised(int(exponent))}"
    elif size >= 10 ** (digits - 1):
        text = f"{value:.0f}"
    return text.rstrip(".").replace("-", "−")


def count_words(counts: Mapping[str, int], words: Mapping[str, str] | None = None) -> str:
    """ "21 B-spline, 2 plane" of counts by kind, the most frequent first."""
    ordered = sorted(counts.items(), key=lambda item: (-item[1], item[0]))
    return ", ".join(f"{count} {(words or {}).get(kind, kind)}" for kind, count in ordered)


def axis_name(direction: Floats) -> str:
    """ "x", "y", "z", with a minus in front if against it, or "" for other directions."""
    along = int(np.argmax(np.abs(direction)))
    if abs(direction[along]) < 1 - 1e-9:
        return ""
    return ("−" if direction[along] < 0 else "") + "xyz"[along]


def direction_words(direction: Floats) -> str:
    """Name of an axis, or the vector."""
    vector = ", ".join(f"{c + 0.0:.3f}".replace("-", "−") for c in direction)
    return axis_name(direction) or f"({vector})"


def probe_words(radius: float, unit: Unit) -> str:
    """Probe radius; an infinite one gives the convex hull."""
    return f"{number(radius, 3)} {unit}" if np.isfinite(radius) else "∞ (hull)"


def shape_size(shape: Shape, unit: Unit) -> str:
    """Dimensions of a section's shape."""
    if isinstance(shape, Circle):
        return f"radius {number(shape.radius)} {unit}"
    if isinstance(shape, Ellipse):
        return f"semi-axes {_by(shape.semi_axes)} {unit}"
    if isinstance(shape, Rectangle):
        return f"sides {_by(2 * shape.half_sides)} {unit}"
    across = np.ptp(shape.evaluate(np.arange(256) / 256), axis=0)
    return f"{_by(across)} {unit} across, {shape.parameters} control points"


def _by(lengths: Floats) -> str:
    return " × ".join(number(length) for length in lengths.tolist())


def _raised(exponent: int) -> str:
    return str(exponent).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
