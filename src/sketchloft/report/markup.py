"""Markup: pieces of HTML; whatever text goes in comes out escaped."""

from __future__ import annotations

import base64
import html
import io
from collections.abc import Mapping, Sequence

from matplotlib.figure import Figure

__all__ = ["bullets", "escaped", "figures", "paragraph", "picture", "section", "table"]

DPI = 120.0
"""Pixels per inch of embedded pictures; about twice the width at which a screen shows them."""


def escaped(text: str) -> str:
    """Text as HTML shows it literally, also within attributes; half characters become question marks."""
    whole = text.encode("utf-8", "replace").decode("utf-8")
    return html.escape("".join(c if c.isprintable() else " " for c in whole))


def paragraph(text: str, kind: str = "") -> str:
    """One paragraph of text."""
    return f"<p{_class(kind)}>{escaped(text)}</p>"


def section(title: str, *content: str, level: int = 2, anchor: str = "") -> str:
    """Heading and what stands under it, pieces of HTML."""
    place = f' id="{escaped(anchor)}"' if anchor else ""
    return "\n".join([f"<section{place}>", f"<h{level}>{escaped(title)}</h{level}>", *content, "</section>"])


def bullets(items: Sequence[str], kind: str = "") -> str:
    """List of sentences."""
    return f"<ul{_class(kind)}>" + "".join(f"<li>{escaped(item)}</li>" for item in items) + "</ul>"


def figures(values: Mapping[str, tuple[str, str]]) -> str:
    """Key figures by name, each with a remark that may be empty, as cards."""
    cards = (
        f"<div><dt>{escaped(name)}</dt><dd>{escaped(value)}</dd><dd>{escaped(remark)}</dd></div>"
        for name, (value, remark) in values.items()
    )
    return '<dl class="figures">' + "".join(cards) + "</dl>"


def table(head: Sequence[str], rows: Sequence[Sequence[str]], *, caption: str, numbers: Sequence[int]) -> str:
    """Table of text.

    Parameters
    ----------
    head : sequence of str
    rows : sequence of sequence of str
        The first cell of each is its heading.
    caption : str
    numbers : sequence of int
        Columns that hold numbers; they are set flush right.
    """
    kinds = [_class("number" if i in numbers else "") for i in range(len(head))]
    top = "".join(
        f'<th scope="col"{kind}>{escaped(name)}</th>' for name, kind in zip(head, kinds, strict=True)
    )
    body = "\n".join(f"<tr>{_row(row, kinds)}</tr>" for row in rows)
    return (
        f"<figure><figcaption>{escaped(caption)}</figcaption>\n"
        f'<div class="table" tabindex="0"><table><thead><tr>{top}</tr></thead>\n'
        f"<tbody>\n{body}\n</tbody></table></div></figure>"
    )


def picture(figure: Figure, alt: str, caption: str) -> str:
    """Figure as an embedded PNG, with words for those who cannot see it and a caption."""
    image = io.BytesIO()
    figure.savefig(image, format="png", dpi=DPI, metadata={"Software": None})
    data = base64.b64encode(image.getvalue()).decode("ascii")
    return (
        f'<figure class="picture"><img alt="{escaped(alt)}" src="data:image/png;base64,{data}">'
        f"<figcaption>{escaped(caption)}</figcaption></figure>"
    )


def _row(cells: Sequence[str], kinds: Sequence[str]) -> str:
    first, *rest = (escaped(cell) for cell in cells)
    return f'<th scope="row"{kinds[0]}>{first}</th>' + "".join(
        f"<td{kind}>{cell}</td>" for cell, kind in zip(rest, kinds[1:], strict=True)
    )


def _class(kind: str) -> str:
    return f' class="{kind}"' if kind else ""
