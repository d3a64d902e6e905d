"""Curves of what plugins and sensors publish."""

from __future__ import annotations

import dataclasses
from collections import deque
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.viewer.page.context import PageContext

NONE = "none"
_KEPT = 600  # moments
_FEW = 6  # curves
COLORS = ("#3a6ea5", "#d9822b", "#4b965f", "#965aa5", "#c0392b", "#3ca0aa", "#8c8c2a", "#777777")
"""Colours of curves, seen on white and on black."""


class PlotLayer:
    """Plots the numbers of one output port over simulated time.

    Args:
        context: Of the page.
    """

    def __init__(self, context: PageContext) -> None:
        self._context = context
        self._times: deque[float] = deque(maxlen=_KEPT)
        self._rows: deque[dict[str, float]] = deque(maxlen=_KEPT)
        self._chart: Any = None
        self._curves: tuple[str, ...] = ()
        self._end: Callable[[], None] | None = None
        self._folder = context.gui.add_folder("Plot", expand_by_default=False)
        with self._folder:
            self._port: Any = context.gui.add_dropdown("Output", (NONE,))
        context.on_user_change(self._port, self._choose)
        self._fresh = 0
        self._shown = 0
        self.renew()

    def read(self) -> None:
        """Do nothing: plotted values arrive by themselves."""

    def show(self, _state: None) -> None:
        """Draw the new values."""
        if self._fresh == self._shown or not self._rows:
            return
        self._shown = self._fresh
        times, rows = list(self._times), list(self._rows)
        count = min(len(times), len(rows))
        times, rows = times[-count:], rows[-count:]
        curves = tuple(rows[-1])[:_FEW]
        data = [np.array(times), *(_column(rows, name) for name in curves)]
        if self._chart is None or curves != self._curves:
            self._draw(curves, data)
        else:
            self._chart.data = tuple(data)

    def renew(self) -> None:
        """List the ports again."""
        ports = tuple(
            f"{robot.name}: {name}"
            for robot in self._context.simulation.robots.values()
            for name in robot.outputs
        )
        if self._port.value not in (NONE, *ports):
            self._port.value = NONE
            self.forget()
        self._port.options = (NONE, *ports)

    def forget(self) -> None:
        """Plot nothing, and let the port sleep again."""
        if self._end is not None:
            self._end()
            self._end = None
        self._times.clear()
        self._rows.clear()
        if self._chart is not None:
            self._chart.remove()
            self._chart = None

    def _choose(self) -> None:
        self.forget()
        robot, _, name = self._port.value.partition(": ")
        robots = self._context.simulation.robots
        if robot in robots and name in robots[robot].outputs:
            self._end = robots[robot].outputs[name].subscribe(self._on_value)

    def _on_value(self, value: Any) -> None:
        """Add a published value; between two steps."""
        world = int(self._context.chosen[0])
        numbers = dict(numbers_of(value, self._context.simulation.nworld, world))
        if numbers:
            self._times.append(self._context.simulation.time)
            self._rows.append(numbers)
            self._fresh += 1

    def _draw(self, curves: tuple[str, ...], data: list[Floats]) -> None:
        if self._chart is not None:
            self._chart.remove()
        from viser import uplot

        series = [uplot.Series(label="time [s]")]
        series += [
            uplot.Series(label=name, stroke=color, width=1.5)
            for name, color in zip(curves, COLORS, strict=False)
        ]
        self._curves = curves
        with self._folder:
            self._chart = self._context.gui.add_uplot(
                tuple(data), tuple(series), scales={"x": uplot.Scale(time=False)}, aspect=1.6
            )


def numbers_of(value: Any, nworld: int, world: int, name: str = "") -> Iterator[tuple[str, float]]:
    """Yield the numbers in a value, by name: of an array with a world axis those of one world.

    >>> dict(numbers_of({"x": 1, "y": [2.0, 3.0]}, 1, 0))
    {'x': 1.0, 'y[0]': 2.0, 'y[1]': 3.0}
    """
    dot = f"{name}." if name else ""
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        for each in dataclasses.fields(value):
            yield from numbers_of(getattr(value, each.name), nworld, world, f"{dot}{each.name}")
    elif isinstance(value, dict):
        for key, inner in value.items():
            yield from numbers_of(inner, nworld, world, f"{dot}{key}")
    elif isinstance(value, bool | int | float | np.number):
        yield name, float(value)
    elif isinstance(value, list | tuple | np.ndarray):
        yield from _numbers_of_array(value, nworld, world, name)


def _numbers_of_array(
    value: Any, nworld: int, world: int, name: str
) -> Iterator[tuple[str, float]]:
    try:
        array = np.asarray(value, np.float64)
    except (TypeError, ValueError, OverflowError):
        return
    if array.ndim > 1 and len(array) == nworld:
        array = array[world]
    elif array.ndim == 1 and len(array) == nworld and nworld > 1:
        array = array[world : world + 1]
    flat = array.ravel()[:_FEW]
    for number, item in enumerate(flat.tolist()):
        yield (name if len(flat) == 1 else f"{name}[{number}]"), item


def _column(rows: list[dict[str, float]], name: str) -> Floats:
    return np.array([row.get(name, np.nan) for row in rows])
