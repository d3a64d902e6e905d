"""Status of one part of a node."""

from __future__ import annotations

from typing import Any

from gazelle_ros.msgs import diagnostic_msgs

DiagnosticArray = diagnostic_msgs.msg.DiagnosticArray
DiagnosticStatus = diagnostic_msgs.msg.DiagnosticStatus
_KeyValue = diagnostic_msgs.msg.KeyValue
OK, WARN, ERROR = DiagnosticStatus.OK, DiagnosticStatus.WARN, DiagnosticStatus.ERROR


class DiagnosticStatusWrapper(DiagnosticStatus):
    """Message of a status, with methods that fill it."""

    def summary(self, *args: Any) -> None:
        """Set level and message, given as two values or as another status."""
        self.level, message = _pair(args)
        self.message = str(message)

    def clearSummary(self) -> None:  # noqa: N802  # ROS's name
        """Set the level to OK, and no message."""
        self.summary(OK, "")

    def mergeSummary(self, *args: Any) -> None:  # noqa: N802  # ROS's name
        """Merge level and message with those that are there.

        The worse level counts. Messages are joined if both or none are OK, else that of the status
        that is not OK stays.
        """
        level, message = _pair(args)
        if (level > OK) == (self.level > OK):
            self.message += f"; {message}" if self.message else message
        elif level > self.level:
            self.message = message
        self.level = max(level, self.level)

    def add(self, key: str, val: Any) -> None:
        """Add a value under a name."""
        self.values.append(_KeyValue(key, str(val)))


def _pair(args: tuple[Any, ...]) -> tuple[int, str]:
    level, message = args if len(args) == 2 else (args[0].level, args[0].message)
    return level, message
