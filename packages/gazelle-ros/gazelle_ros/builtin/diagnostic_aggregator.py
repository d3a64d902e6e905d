"""``diagnostic_aggregator/aggregator_node``: statuses of all nodes, sorted into groups."""

from __future__ import annotations

import threading
from collections.abc import Mapping, Sequence

from gazelle_ros.base.errors import RosError
from gazelle_ros.base.parameter_values import positive
from gazelle_ros.builtin.arguments import run_node
from gazelle_ros.builtin.diagnostic_analyzers import (
    STALE,
    AnalyzerGroup,
    GenericAnalyzer,
    Status,
    analyzers_of,
)
from gazelle_ros.builtin.diagnostics import ERROR
from gazelle_ros.builtin.parameters import warn_of_others
from gazelle_ros.msgs import diagnostic_msgs
from gazelle_ros.node import Node
from gazelle_ros.time import Time


class DiagnosticAggregator:
    """Publisher of ``/diagnostics_agg`` and ``/diagnostics_toplevel_state``.

    Args:
        node: On the graph, with the parameters ``~analyzers``, ``~base_path``, ``~pub_rate``,
            ``~other_as_errors``.

    Raises:
        RosError: A parameter is wrong.
    """

    def __init__(self, node: Node) -> None:
        self._node, self._lock = node, threading.Lock()
        warn_of_others(node, ("analyzers", "base_path", "pub_rate", "other_as_errors"))
        values = node.get_param("~analyzers", {})
        if not isinstance(values, Mapping):
            raise RosError(f"{node.resolve('~analyzers')} must be a namespace, not {values!r:.60}")
        base = str(node.get_param("~base_path", "")).strip("/")
        path = f"/{base}" if base else ""
        self._period = 1.0 / positive("pub_rate", node.get_param("~pub_rate", 1.0))
        self._others_are_errors = node.get_param("~other_as_errors", False) is True
        self.groups: AnalyzerGroup = analyzers_of(node.resolve("~analyzers"), values, path)
        self._others = GenericAnalyzer(f"{path}/Other", {"regex": [".*"]}, discard_stale=True)
        array = diagnostic_msgs.msg.DiagnosticArray
        self._all = node.advertise("/diagnostics_agg", array, queue_size=1)
        self._state = node.advertise("/diagnostics_toplevel_state", Status, queue_size=1)
        node.subscribe("/diagnostics", array, self._take, queue_size=1000)

    def run(self, stop: threading.Event) -> None:
        """Publish until shutdown."""
        while not self._node.closed and not stop.wait(self._period):
            self.publish()

    def publish(self) -> None:
        """Publish all groups, and the worst level of them."""
        now = self._node.clock.now()
        with self._lock:
            found = self.groups.report(now / 1e9)
            others = self._others.report(now / 1e9)
        if len(others) > 1:
            if self._others_are_errors:
                for each in others:
                    each.level = max(each.level, ERROR)
            found += others
        report = diagnostic_msgs.msg.DiagnosticArray(status=found)
        report.header.stamp = Time(nsecs=now)
        self._all.publish(report)
        levels = [each.level for each in found]
        mixed = not levels or (max(levels) == STALE and min(levels) < STALE)
        self._state.publish(Status(level=ERROR if mixed else max(levels), name="toplevel_state"))

    def _take(self, message: diagnostic_msgs.msg.DiagnosticArray) -> None:
        now = self._node.clock.now() / 1e9
        with self._lock:
            for status in message.status:
                if not self.groups.take(status, now):
                    self._others.take(status, now)


def main(arguments: Sequence[str]) -> int:
    """Sort statuses into groups until shutdown; returns the exit code."""
    return run_node(arguments, "diagnostic_aggregator", DiagnosticAggregator)
