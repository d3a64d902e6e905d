"""HTML of panels: tables and texts, with everything from the graph escaped."""

from __future__ import annotations

import re
from collections.abc import Sequence
from html import escape

_BORDER = "border-bottom:1px solid var(--mantine-color-default-border)"
_CELL = f"padding:2px 6px;text-align:left;vertical-align:top;{_BORDER}"
_WRAP, _WHOLE = "overflow-wrap:break-word", "white-space:nowrap"
_BOX = "padding:0 0.7em 0.5em;font-size:0.8em;overflow:auto"

_BREAKS, _BREAK = re.compile(r"[/_]"), r"\g<0><wbr>"
"""Names of topics and types may be broken behind these."""

Row = tuple[Sequence[str], str]
"""Texts of the cells, and the CSS colour of the row; "" for the page's."""


def table(
    head: Sequence[str], rows: Sequence[Row], wide: Sequence[str] = (), height_px: int = 420
) -> str:
    """Return a table as HTML.

    Args:
        head: Titles of the columns.
        rows: Below them.
        wide: Titles of the columns whose texts may be broken into lines.
        height_px: Largest height; longer tables scroll.
    """
    titles = "".join(f'<th style="{_CELL};{_WHOLE}">{escape(each)}</th>' for each in head)
    styles = [f"{_CELL};{_WRAP if each in wide else _WHOLE}" for each in head]
    lines = "".join(_line(cells, styles, color) for cells, color in rows)
    return (
        f'<div style="{_BOX};max-height:{height_px}px"><table style="border-collapse:collapse;'
        f'width:100%"><tr>{titles}</tr>{lines}</table></div>'
    )


def preformatted(text: str, height_px: int = 300) -> str:
    """Return a text with its line breaks as HTML."""
    style = f"{_BOX};max-height:{height_px}px;white-space:pre-wrap;font-family:monospace"
    return f'<div style="{style}">{escape(text)}</div>'


def framed(markup: str, height_px: int = 480) -> str:
    """Return markup in a box that scrolls."""
    return f'<div style="{_BOX};max-height:{height_px}px">{markup}</div>'


def _line(cells: Sequence[str], styles: Sequence[str], color: str) -> str:
    tone = f' style="color:{color}"' if color else ""
    inner = "".join(
        f'<td style="{style}">{_BREAKS.sub(_BREAK, escape(each))}</td>'
        for each, style in zip(cells, styles, strict=True)
    )
    return f"<tr{tone}>{inner}</tr>"
