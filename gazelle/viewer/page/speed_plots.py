"""Curves of the real-time factor and of the time that a step takes."""

from __future__ import annotations

import time
from collections import deque
from typing import Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.viewer.page.context import PageContext

_PERIOD = 0.5  # between two points [s]
_KEPT = 120  # points: a minute
_CURVES = {"real-time factor": "#3a6ea5", "step [ms]": "#d9822b"}


class SpeedPlots:
    """Plots both over the last minute of wall time.

    The time of a step is the mean over half a second, with sensors and plugins.

    Args:
        context: Of the page.
    """

    def __init__(self, context: PageContext) -> None:
        self._context = context
        self._points: deque[tuple[float, float, float]] = deque(maxlen=_KEPT)
        self._before: tuple[float, float, float] | None = None
        self._begin = time.monotonic()
        self._charts: dict[str, Any] = {}
        self._folder = context.gui.add_folder("Last minute")

    def read(self) -> Floats | None:
        """Return time [s], factor and step time [ms] of each point, shape (3, n); None without a new one."""
        simulation, wall = self._context.simulation, time.monotonic()
        if self._before is not None and wall - self._before[0] < _PERIOD:
            return None
        before, self._before = self._before, (wall, simulation.time, simulation.loop.spent)
        if before is None or wall - before[0] > 10.0 * _PERIOD:  # no page was open
            return None
        passed, gain, spent = (now - then for now, then in zip(self._before, before, strict=True))
        if gain < 0.0 or spent <= 0.0:  # reset, paused, or a state of a log
            return None
        steps = gain / simulation.engine.time_step
        cost = 1000.0 * spent / steps if steps > 0.5 else np.nan
        self._points.append((wall - self._begin, gain / passed, cost))
        return np.array(self._points).T

    def show(self, state: Floats | None) -> None:
        """Draw the curves."""
        if state is None or state.shape[1] < 2:
            return
        for row, name in enumerate(_CURVES, 1):
            data = (state[0], state[row])
            if name in self._charts:
                self._charts[name].data = data
            else:
                self._charts[name] = self._chart(name, data)

    def renew(self) -> None:
        """Do nothing: models do not matter here."""

    def _chart(self, name: str, data: tuple[Floats, Floats]) -> Any:
        from viser import uplot

        series = (
            uplot.Series(label="wall time [s]"),
            uplot.Series(label=name, stroke=_CURVES[name], width=1.5),
        )
        scales = {"x": uplot.Scale(time=False)}
        with self._folder:
            return self._context.gui.add_uplot(data, series, scales=scales, title=name, aspect=2.0)
