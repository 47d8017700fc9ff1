"""Picture: a matplotlib figure without a window, and how it reaches its file."""

from __future__ import annotations

import os
from pathlib import Path

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from sketchloft.errors import OutputError
from sketchloft.output import beside

__all__ = ["new_figure", "save_figure"]


def new_figure(width: float, height: float) -> Figure:
    """Make an empty figure of a size in inches that draws itself without a display."""
    figure = Figure(figsize=(width, height), layout="constrained", facecolor="white")
    FigureCanvasAgg(figure)
    return figure


def save_figure(figure: Figure, path: str | os.PathLike[str], *, dpi: float = 144.0) -> None:
    """Write a figure as PNG, whole or not at all.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
    path : path-like
        Replaced if it exists.
    dpi : float
        Pixels per inch.

    Raises
    ------
    OutputError
        If the extension is not .png, or the file cannot be written.
    """
    path = Path(path)
    if path.suffix.lower() != ".png":
        raise OutputError(
            f"{path}: cannot write a picture with the extension {path.suffix or '(none)'}; choose .png"
        )
    with beside(path) as parts:
        figure.savefig(next(parts), dpi=dpi, metadata={"Software": None})
