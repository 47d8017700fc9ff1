"""Page: the frame around the report, with its style and table of contents."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from importlib import resources

from sketchloft.report.markup import escaped

__all__ = ["page"]


def page(title: str, top: str, contents: Mapping[str, str], parts: Sequence[str], foot: str) -> str:
    """Whole HTML document that refers to nothing outside itself.

    Parameters
    ----------
    title : str
    top : str
        HTML that stands before the table of contents.
    contents : mapping of str to str
        Title of each entry by the anchor that it leads to.
    parts : sequence of str
        HTML that follows.
    foot : str
    """
    style = resources.files("sketchloft.report").joinpath("report.css").read_text(encoding="utf-8")
    entries = "".join(f'<li><a href="#{escaped(a)}">{escaped(t)}</a></li>' for a, t in contents.items())
    return "\n".join(
        [
            "<!DOCTYPE html>",
            '<html lang="en">',
            '<head><meta charset="utf-8">',
            '<meta name="viewport" content="width=device-width, initial-scale=1">',
            f"<title>{escaped(title)}</title>",
            f"<style>\n{style}</style></head>",
            "<body><main>",
            f"<header><p>sketchloft report</p><h1>{escaped(title)}</h1></header>",
            top,
            f'<nav aria-label="Contents"><ol>{entries}</ol></nav>',
            *parts,
            f"<footer>{escaped(foot)}</footer>",
            "</main></body></html>",
            "",
        ]
    )
