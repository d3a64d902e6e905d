"""Diagnostics of a node on ``/diagnostics``, with the interface of ROS 1's ``diagnostic_updater``."""

from __future__ import annotations

from gazelle_ros.drop_in.diagnostic_updater.status import (
    ERROR,
    OK,
    WARN,
    DiagnosticArray,
    DiagnosticStatus,
    DiagnosticStatusWrapper,
)
from gazelle_ros.drop_in.diagnostic_updater.topics import (
    DiagnosedPublisher,
    FrequencyStatus,
    FrequencyStatusParam,
    HeaderlessTopicDiagnostic,
    Heartbeat,
    TimeStampStatus,
    TimeStampStatusParam,
    TopicDiagnostic,
)
from gazelle_ros.drop_in.diagnostic_updater.updater import (
    CompositeDiagnosticTask,
    DiagnosticTask,
    DiagnosticTaskVector,
    FunctionDiagnosticTask,
    Updater,
)

__all__ = [
    "ERROR",
    "OK",
    "WARN",
    "CompositeDiagnosticTask",
    "DiagnosedPublisher",
    "DiagnosticArray",
    "DiagnosticStatus",
    "DiagnosticStatusWrapper",
    "DiagnosticTask",
    "DiagnosticTaskVector",
    "FrequencyStatus",
    "FrequencyStatusParam",
    "FunctionDiagnosticTask",
    "HeaderlessTopicDiagnostic",
    "Heartbeat",
    "TimeStampStatus",
    "TimeStampStatusParam",
    "TopicDiagnostic",
    "Updater",
]
