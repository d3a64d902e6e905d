"""Tasks that fill statuses, and their publisher."""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from gazelle_ros.compat import rospy
from gazelle_ros.drop_in.diagnostic_updater.status import (
    ERROR,
    OK,
    DiagnosticArray,
    DiagnosticStatusWrapper,
)

_LOOK_S = 0.25  # between two looks at ~diagnostic_period

Fill = Callable[[Any], Any]
"""Takes a status, fills it and returns it."""


class DiagnosticTask:
    """Something that fills a status; subclasses define ``run``.

    Args:
        name: Of the status.
    """

    def __init__(self, name: str) -> None:
        self.name = name

    def getName(self) -> str:  # noqa: N802  # ROS's name
        """Return the name."""
        return self.name

    def run(self, stat: DiagnosticStatusWrapper) -> Any:
        """Fill a status, and return it."""
        return stat


class FunctionDiagnosticTask(DiagnosticTask):
    """A function that fills a status.

    Args:
        name: Of the status.
        fn: The function.
    """

    def __init__(self, name: str, fn: Fill) -> None:
        super().__init__(name)
        self.fn = fn

    def run(self, stat: DiagnosticStatusWrapper) -> Any:
        """Call the function."""
        return self.fn(stat)


class CompositeDiagnosticTask(DiagnosticTask):
    """Several tasks that fill one status: the worst level counts."""

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.tasks: list[DiagnosticTask] = []

    def addTask(self, t: DiagnosticTask) -> None:  # noqa: N802  # ROS's name
        """Add a task."""
        self.tasks.append(t)

    def run(self, stat: DiagnosticStatusWrapper) -> Any:
        """Run each task, and merge their statuses."""
        together, before = DiagnosticStatusWrapper(), DiagnosticStatusWrapper()
        before.summary(stat)
        for task in self.tasks:
            stat.summary(before)
            stat = task.run(stat)
            together.mergeSummary(stat)
        stat.summary(together)
        return stat


@dataclass
class NamedTask:
    """A task as it is kept.

    Attributes:
        name: Of the status.
        fn: Fills it.
    """

    name: str
    fn: Fill

    def run(self, stat: DiagnosticStatusWrapper) -> Any:
        """Fill a status."""
        stat.name = self.name
        return self.fn(stat)


class DiagnosticTaskVector:
    """Tasks in their order."""

    def __init__(self) -> None:
        self.tasks: list[NamedTask] = []
        self.lock = threading.RLock()

    def add(self, *args: Any) -> None:
        """Add a task, or a name and a function."""
        task = NamedTask(*args) if len(args) == 2 else NamedTask(args[0].getName(), args[0].run)
        with self.lock:
            self.tasks.append(task)
            self.addedTaskCallback(task)

    def addedTaskCallback(self, task: NamedTask) -> None:  # noqa: N802  # ROS's name
        """Handle a new task."""

    def removeByName(self, name: str) -> bool:  # noqa: N802  # ROS's name
        """Remove the first task of a name; returns whether there was one."""
        with self.lock:
            found = next((task for task in self.tasks if task.name == name), None)
            if found is not None:
                self.tasks.remove(found)
        return found is not None


class Updater(DiagnosticTaskVector):
    """Publishes the statuses of its tasks on ``/diagnostics``, every ``~diagnostic_period`` (1) seconds.

    Attributes:
        verbose: Log what is not OK.
    """

    def __init__(self) -> None:
        super().__init__()
        self.publisher = rospy.Publisher("/diagnostics", DiagnosticArray, queue_size=10)
        self.last_time = self._looked = rospy.get_rostime()
        self.period = 1.0
        self.verbose = False
        self.hwid = ""
        self._warned = False

    def setHardwareID(self, hwid: str) -> None:  # noqa: N802  # ROS's name
        """Set what the statuses call the device."""
        self.hwid = hwid

    def update(self) -> None:
        """Publish the status, if it is due."""
        now = rospy.get_rostime()
        if now >= self._looked + rospy.Duration(_LOOK_S):
            self.period, self._looked = rospy.get_param_cached("~diagnostic_period", 1), now
        if now >= self.last_time + rospy.Duration(self.period):
            self.force_update()

    def force_update(self) -> None:
        """Publish now."""
        self.last_time = rospy.get_rostime()
        with self.lock:
            found = [self._run(task) for task in self.tasks]
        if not self.hwid and not self._warned and not any(status.level for status in found):
            rospy.logwarn("diagnostic_updater: no hardware id is set; setHardwareID('none') is one")
            self._warned = True
        self.publish(found)

    def _run(self, task: NamedTask) -> Any:
        status = DiagnosticStatusWrapper(
            level=ERROR, name=task.name, message="No message was set", hardware_id=self.hwid
        )
        task.run(status)
        if self.verbose and status.level:
            rospy.logwarn(f"'{status.name}' is at level {status.level}: {status.message}")
        return status

    def broadcast(self, lvl: int, msg: str) -> None:
        """Publish one level and message as the status of all tasks."""
        self.publish([self._as_status(task, lvl, msg) for task in self.tasks])

    @staticmethod
    def _as_status(task: NamedTask, level: int, message: str) -> Any:
        return DiagnosticStatusWrapper(name=task.name, level=level, message=message)

    def publish(self, msg: Any) -> None:
        """Publish a status, or a list of them; the node's name is put before their names."""
        found = msg if isinstance(msg, list) else [msg]
        for status in found:
            status.name = f"{rospy.get_name()[1:]}: {status.name}"
        message = DiagnosticArray(status=found)
        message.header.stamp = rospy.get_rostime()
        self.publisher.publish(message)

    def addedTaskCallback(self, task: NamedTask) -> None:  # noqa: N802  # ROS's name
        """Publish that the task begins."""
        self.publish(self._as_status(task, OK, "Node starting up"))
