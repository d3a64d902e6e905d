"""The nodes ``result_graph`` and ``action_graph``: rows of numbers of a topic, as a plot that grows.

Those of turtlebot3_machine_learning open windows; these write a picture, again and again.
"""

from __future__ import annotations

import sys
import threading
from collections import deque
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from gazelle.viewer.plots import plot_series
from gazelle_ros import Node
from gazelle_ros.base.interrupts import stopping
from gazelle_ros.base.path_texts import expanded
from gazelle_ros.builtin.arguments import parse_arguments
from gazelle_ros.msgs import std_msgs

_LOOK_S = 1.0
_STEPS = 1000


def result_graph(arguments: Sequence[str]) -> int:
    """Draw score and largest value of each ``result``; the exit code is 0."""
    return _plot(arguments, "result", ("score", "max_q"), "results", None)


def action_graph(arguments: Sequence[str]) -> int:
    """Draw the latest actions, scores and rewards of ``get_action``; the exit code is 0."""
    return _plot(arguments, "get_action", ("action", "score", "reward"), "steps", _STEPS)


class TopicPlot:
    """Rows of a ``std_msgs/Float32MultiArray``, a panel for each of their numbers.

    Args:
        node: On the graph.
        topic: Its name.
        names: Of the numbers, where the messages do not label them.
        horizontal: Quantity of the horizontal axis.
        keep: Number of latest rows to draw; all if None.
        file: The picture.
    """

    def __init__(
        self,
        node: Node,
        topic: str,
        names: Sequence[str],
        horizontal: str,
        keep: int | None,
        file: Path,
    ) -> None:
        self.file = file
        self._names, self._horizontal = tuple(names), horizontal
        self._lock = threading.Lock()
        self._rows: deque[tuple[float, ...]] = deque(maxlen=keep)
        self._received = self._drawn = 0
        kind = std_msgs.msg.Float32MultiArray
        node.subscribe(topic, kind, self._receive, keep)

    def _receive(self, message: std_msgs.msg.Float32MultiArray) -> None:
        labels = tuple(message.layout.dim[0].label.split(",")) if message.layout.dim else ()
        with self._lock:
            names = labels if len(labels) == len(message.data) else self._names
            if len(names) != len(message.data):
                return
            if names != self._names:
                self._names = names
                self._rows.clear()
            self._rows.append(tuple(message.data))
            self._received += 1

    def draw(self) -> bool:
        """Write the picture if there is something new; whether there was.

        Raises:
            FormatError: It cannot be written.
            MissingExtraError: Matplotlib is not installed.
        """
        with self._lock:
            rows, names, received = list(self._rows), self._names, self._received
        if received == self._drawn:
            return False
        columns = np.array(rows, np.float64).T
        count = np.arange(received - len(rows) + 1, received + 1, dtype=np.float64)
        series = {name: (count, column) for name, column in zip(names, columns, strict=True)}
        plot_series(series, self._horizontal, self.file)
        self._drawn = received
        return True


def _plot(
    arguments: Sequence[str], topic: str, names: Sequence[str], horizontal: str, keep: int | None
) -> int:
    found = parse_arguments(arguments, f"{topic}_plot")
    with found.start() as node, stopping() as stop:
        node.on_shutdown.append(lambda _reason: stop.set())
        file = expanded(str(node.get_param("~file", f"{topic}.png")))
        plot = TopicPlot(node, topic, names, horizontal, keep, file)
        sys.stderr.write(f"{node.resolve(topic)} is drawn to {file.resolve()}\n")
        while not stop.is_set() and not node.closed:
            plot.draw()
            stop.wait(_LOOK_S)
        plot.draw()
    return 0
