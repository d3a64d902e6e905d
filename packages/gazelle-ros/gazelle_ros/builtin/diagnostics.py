"""Reports of built-in nodes on ``/diagnostics``."""

from __future__ import annotations

from collections.abc import Mapping

from gazelle_ros.msgs import diagnostic_msgs
from gazelle_ros.node import Node
from gazelle_ros.time import Time

OK, WARN, ERROR = 0, 1, 2


class DiagnosticPublisher:
    """Publisher of one status on ``/diagnostics``.

    Args:
        node: On the graph.
        title: Name of the status, behind that of the node.
    """

    def __init__(self, node: Node, title: str) -> None:
        self._node = node
        self._name = f"{node.name.lstrip('/')}: {title}"
        self._publisher = node.advertise(
            "/diagnostics", diagnostic_msgs.msg.DiagnosticArray, queue_size=1
        )

    def publish(self, values: Mapping[str, object], message: str = "ok", level: int = OK) -> None:
        """Publish the status.

        Args:
            values: By name.
            message: For people.
            level: OK, WARN or ERROR.
        """
        status = diagnostic_status(self._name, values, message, level)
        report = diagnostic_msgs.msg.DiagnosticArray(status=[status])
        report.header.stamp = Time(nsecs=self._node.clock.now())
        self._publisher.publish(report)


def diagnostic_status(
    name: str, values: Mapping[str, object], message: str, level: int
) -> diagnostic_msgs.msg.DiagnosticStatus:
    """Return a status; see `DiagnosticPublisher.publish`."""
    return diagnostic_msgs.msg.DiagnosticStatus(
        level=level,
        name=name,
        message=message,
        hardware_id="none",
        values=[
            diagnostic_msgs.msg.KeyValue(key=key, value=str(value)) for key, value in values.items()
        ],
    )
