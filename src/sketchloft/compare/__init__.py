"""Comparison of slice-and-loft with the methods it is meant to improve on (paper, sections 4 and 5.3)."""

from sketchloft.compare.comparison import METHODS, Comparison, Method, Row
from sketchloft.compare.methods import LoftedModel
from sketchloft.compare.side_by_side import ComparisonParams, compare, parse_radii
from sketchloft.compare.slice_and_loft import slice_and_loft

__all__ = [
    "METHODS",
    "Comparison",
    "ComparisonParams",
    "LoftedModel",
    "Method",
    "Row",
    "compare",
    "parse_radii",
    "slice_and_loft",
]
