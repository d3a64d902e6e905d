"""Panel with the curve of a training that the page shows copies of."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.viewer.page.context import PageContext

_KEPT = 500  # points; of more, every other one is left out
_CURVES = {"success_rate": "success [share]", "return": "return"}
_COLORS = {"success_rate": "#4b965f", "return": "#3a6ea5"}


@dataclass
class TrainingCurve:
    """Points of a training's curve, added by its thread and read by that of a page.

    Attributes:
        total: Control steps at the end.
        points: Control steps, and the means over the latest episodes at that time.
    """

    total: int = 0
    points: deque[tuple[int, dict[str, float]]] = field(default_factory=deque)

    def add(self, steps: int, summary: dict[str, float]) -> None:
        """Add a point after a given number of control steps; the summary is `EpisodeLog.summary`'s."""
        if len(self.points) >= _KEPT:
            self.points = deque(list(self.points)[::2])
        self.points.append((steps, dict(summary)))


class TrainingPanel:
    """Steps, success and return of a training as text and as curves over control steps.

    Args:
        context: Of the page.
        curve: The points.
    """

    def __init__(self, context: PageContext, curve: TrainingCurve) -> None:
        self._context, self._curve = context, curve
        self._charts: dict[str, Any] = {}
        self._shown = -1
        self._folder = context.gui.add_folder("Training")
        with self._folder:
            self._text: Any = context.gui.add_markdown("No episode has ended.")

    def read(self) -> list[tuple[int, dict[str, float]]]:
        """Return the points."""
        return list(self._curve.points)

    def show(self, state: list[tuple[int, dict[str, float]]]) -> None:
        """Draw the points, if there are new ones."""
        if not state or state[-1][0] == self._shown:
            return
        self._shown = state[-1][0]
        self._text.content = progress_text(self._curve.total, *state[-1])
        for name, label in _CURVES.items():
            steps, values = column(state, name)
            if len(steps) > 1:
                self._draw(name, label, (steps, values))

    def renew(self) -> None:
        """Do nothing: models do not matter here."""

    def _draw(self, name: str, label: str, data: tuple[Floats, Floats]) -> None:
        if name in self._charts:
            self._charts[name].data = data
            return
        from viser import uplot

        series = (
            uplot.Series(label="steps"),
            uplot.Series(label=label, stroke=_COLORS[name], width=1.5),
        )
        with self._folder:
            self._charts[name] = self._context.gui.add_uplot(
                data, series, scales={"x": uplot.Scale(time=False)}, title=label, aspect=2.0
            )


def progress_text(total: int, steps: int, summary: dict[str, float]) -> str:
    """Return how far a training is, as Markdown."""
    lines = [f"{steps:,} of {total:,} steps"]
    if "success_rate" in summary:
        lines.append(f"success **{summary['success_rate']:.0%}** of the latest goals")
    if "return" in summary:
        lines.append(f"return **{summary['return']:.4g}** of an episode")
    return "  \n".join(lines)


def column(points: list[tuple[int, dict[str, float]]], name: str) -> tuple[Floats, Floats]:
    """Return steps and values of the points that have one of this name, shapes (n,)."""
    found = [(steps, summary[name]) for steps, summary in points if name in summary]
    table = np.array(found, np.float64).reshape(-1, 2)
    return table[:, 0], table[:, 1]
