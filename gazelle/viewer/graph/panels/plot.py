"""Plot of any numbers of any topics over time, as rqt_plot draws them."""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.errors import Error, did_you_mean
from gazelle.viewer.graph.context import GraphContext
from gazelle.viewer.graph.panels.panel import GraphPanel
from gazelle.viewer.page.plots import COLORS, numbers_of
from gazelle_ros import load_message
from gazelle_ros.messages.yaml import to_dict
from gazelle_ros.tools.errors import ToolError
from gazelle_ros.tools.fields import FieldAccess, parse_path, value_at

_KEPT = 5000
_FEW = 8  # curves of one field
_NOTHING = "none"


class _PlottedField:
    """A field of a topic, and its numbers over time."""

    def __init__(self, context: GraphContext, text: str, topic: str, kind: str) -> None:
        self.text, self.error = text, ""
        self._steps = field_steps(text.removeprefix(topic))
        self._rows: deque[tuple[float, dict[str, float]]] = deque(maxlen=_KEPT)
        self._lock = threading.Lock()
        self._subscriber = context.node.subscribe(topic, load_message(kind), self._take, 100)

    def _take(self, message: Any) -> None:
        try:
            value = value_at(message, self._steps)
        except ToolError as error:
            self.error = str(error)
            return
        numbers = dict(numbers_of(to_dict(value), 1, 0))
        self.error = "" if numbers else f"{self.text} is not a number"
        with self._lock:
            self._rows.append((time.monotonic(), numbers))

    def curves(self, since: float) -> dict[str, tuple[Floats, Floats]]:
        """Return times [s] and values since a time, by name."""
        with self._lock:
            rows = [row for row in self._rows if row[0] >= since]
        if not rows:
            return {}
        times = np.array([when for when, _ in rows])
        return {
            f"{self.text}.{name}" if name else self.text: (
                times, np.array([numbers.get(name, np.nan) for _, numbers in rows])
            )
            for name in list(rows[-1][1])[:_FEW]
        }  # fmt: skip

    def close(self) -> None:
        """Unsubscribe."""
        self._subscriber.close()


class PlotPanel(GraphPanel):
    """Curves of fields; a field that is a message shows all its numbers.

    Args:
        context: Of the page.
    """

    title = "Plot"
    period = 0.25

    def __init__(self, context: GraphContext) -> None:
        super().__init__(context)
        self._fields: dict[str, _PlottedField] = {}
        self._waiting: list[str] = []
        self._chart: Any = None
        self._curves: tuple[str, ...] = ()

    def build(self) -> None:
        """Add the choice of fields."""
        gui = self.context.gui
        self._text: Any = gui.add_text("Field", "", hint="Such as /odom/twist/twist/linear/x")
        self.context.on_user_click(gui.add_button("Add"), self._add_typed)
        self._drop: Any = gui.add_dropdown("Remove", (_NOTHING,))
        self.context.on_user_change(self._drop, lambda: self._remove(self._drop.value))
        self._span: Any = gui.add_number("Seconds", 20.0, min=1.0, max=600.0, step=1.0)
        self._pause: Any = gui.add_checkbox("Pause", initial_value=False)
        self._fault: Any = gui.add_markdown("", visible=False)
        self.inputs = {"seconds": self._span}

    def use(self, arguments: Sequence[str]) -> None:
        """Plot the fields of a command line, ``/topic/a /topic/b`` or ``/topic/a:b``."""
        for word in arguments:
            if word.startswith("-"):
                continue
            first, *others = word.split(":")
            stem = first.rpartition("/")[0]
            self._waiting += [first, *(f"{stem}/{each}" for each in others)]

    @property
    def settings(self) -> dict[str, Any]:
        """Fields and seconds."""
        return {**super().settings, "fields": [*self._fields, *self._waiting]}

    def restore(self, settings: Mapping[str, Any]) -> None:
        """Plot the fields of a saved layout."""
        super().restore(settings)
        fields = settings.get("fields", [])
        self._waiting += [str(each) for each in fields if each not in self._fields]

    def add(self, text: str) -> None:
        """Plot a field.

        Raises:
            Error: No topic of the graph is the beginning of it, or it is malformed.
        """
        types = dict(self.context.node.master.topic_types())
        topic = topic_of(text, list(types))
        if text not in self._fields:
            self._fields[text] = _PlottedField(self.context, text, topic, types[topic])
            self._offer()

    def refresh(self) -> None:
        """Draw the curves."""
        self._add_waiting()
        faults = [each.error for each in self._fields.values() if each.error]
        faults += [f"waiting for {each}" for each in self._waiting]
        self._fault.content = "\n\n".join(faults)
        self._fault.visible = bool(faults)
        if self._pause.value:
            return
        now = time.monotonic()
        curves: dict[str, tuple[Floats, Floats]] = {}
        for field in tuple(self._fields.values()):
            curves |= field.curves(now - self._span.value)
        if curves:
            self._draw(tuple(curves), _aligned(curves, now))
        elif self._chart is not None:
            self._chart.remove()
            self._chart = None

    def close(self) -> None:
        """Unsubscribe."""
        for field in self._fields.values():
            field.close()

    def _add_waiting(self) -> None:
        """Plot fields that were requested before their topic existed."""
        for text in tuple(self._waiting):
            try:
                self.add(text)
            except Error:
                continue
            self._waiting.remove(text)

    def _add_typed(self) -> None:
        self.add(self._text.value.strip())
        self._text.value = ""

    def _remove(self, text: str) -> None:
        if text in self._fields:
            self._fields.pop(text).close()
            self._offer()

    def _offer(self) -> None:
        self._drop.options = (_NOTHING, *self._fields)
        self._drop.value = _NOTHING

    def _draw(self, names: tuple[str, ...], data: list[Floats]) -> None:
        if self._chart is not None and names == self._curves:
            self._chart.data = tuple(data)
            return
        if self._chart is not None:
            self._chart.remove()
        from viser import uplot

        series = [uplot.Series(label="time [s]")]
        series += [
            uplot.Series(label=name, stroke=COLORS[number % len(COLORS)], width=1.5, spanGaps=True)
            for number, name in enumerate(names)
        ]
        self._curves = names
        self._chart = self.context.gui.add_uplot(
            tuple(data),
            tuple(series),
            scales={"x": uplot.Scale(time=False)},
            aspect=2.0,
        )


def topic_of(text: str, topics: Sequence[str]) -> str:
    """Return the topic at the beginning of a path such as ``/odom/twist/linear/x``, the longest match.

    Raises:
        Error: There is none.
    """
    fitting = [each for each in topics if text == each or text.startswith(f"{each}/")]
    if not fitting:
        hint = did_you_mean(text, topics)
        raise Error(f"no topic is the beginning of '{text}'", hint=hint)
    return max(fitting, key=len)


def field_steps(path: str) -> list[FieldAccess]:
    """Return the steps of a path; ``/data/0`` is as good as ``/data[0]``, as for rqt_plot."""
    text = ""
    for part in path.split("/"):
        text += f"[{part}]" if part.isdigit() else f"/{part}"
    return parse_path(text)


def _aligned(curves: Mapping[str, tuple[Floats, Floats]], now: float) -> list[Floats]:
    """Return common times before now [s], and each curve's values at them, NaN where it has none."""
    times = np.unique(np.concatenate([when for when, _ in curves.values()]))
    data = [times - now]
    for when, values in curves.values():
        row = np.full(len(times), np.nan)
        row[np.searchsorted(times, when)] = values
        data.append(row)
    return data
