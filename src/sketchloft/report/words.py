"""Words: how numbers, directions, shapes and faces are called in pictures and in the report."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats, Unit
from sketchloft.ring import ring_area
from sketchloft.shapes.circle import Circle
from sketchloft.shapes.ellipse import Ellipse
from sketchloft.shapes.recognise import Shape
from sketchloft.shapes.rectangle import Rectangle

__all__ = [
    "FACE_WORDS",
    "MINUS",
    "TIMES",
    "axis_name",
    "counted",
    "direction_words",
    "number",
    "place",
    "probe_words",
    "shape_size",
]

MINUS, TIMES = "\N{MINUS SIGN}", "\N{MULTIPLICATION SIGN}"
AROUND = np.arange(256) / 256

FACE_WORDS = {
    "BSplineSurface": "B-spline",
    "Plane": "plane",
    "CylindricalSurface": "cylinder",
    "ConicalSurface": "cone",
    "SphericalSurface": "sphere",
    "ToroidalSurface": "torus",
    "SurfaceOfRevolution": "revolved",
    "SurfaceOfLinearExtrusion": "extruded",
}
"""What faces are called, by kind of surface."""


def number(value: float, digits: int = 4) -> str:
    """Value with so many significant digits, a real minus, and powers of ten for the very large and small."""
    if np.isinf(value):
        return f"{MINUS * (value < 0)}∞"
    size = abs(value)
    text = f"{value:#.{digits}g}" if size else "0"
    if size and not 1e-3 <= size < 10**6:
        mantissa, _, exponent = f"{value:.{digits - 1}e}".partition("e")
        text = f"{mantissa}·10{_raised(int(exponent))}"
    elif size >= 10 ** (digits - 1):
        text = f"{value:.0f}"
    return text.rstrip(".").replace("-", MINUS)


def place(value: float, size: float) -> str:
    """Coordinate, with as many decimals as tell apart about a ten-thousandth of a size."""
    decimals = 4 - round(float(np.log10(size)))
    if not 0 <= decimals <= 8:
        return number(value, 5)
    return f"{round(value, decimals) + 0.0:.{decimals}f}".replace("-", MINUS)


def counted(count: int, name: str, several: str = "") -> str:
    """Number and noun: "1 body", "2 bodies" for several = "bodies"; else with an s."""
    return f"{count:,} {name if count == 1 else several or name + 's'}"


def axis_name(direction: Floats) -> str:
    """Letter of an axis, with a minus in front if against it; nothing for other directions."""
    along = int(np.argmax(np.abs(direction)))
    if abs(direction[along]) < 1 - 1e-9:
        return ""
    return (MINUS if direction[along] < 0 else "") + "xyz"[along]


def direction_words(direction: Floats) -> str:
    """Name of an axis, or the vector."""
    vector = ", ".join(f"{c + 0.0:.3f}".replace("-", MINUS) for c in direction)
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
    area = number(ring_area(shape.evaluate(AROUND)))
    return f"area {area} {unit}², {shape.parameters} control points"


def _by(lengths: Floats) -> str:
    return f" {TIMES} ".join(number(length) for length in lengths.tolist())


def _raised(exponent: int) -> str:
    return str(exponent).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
