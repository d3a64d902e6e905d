"""A robot of one's own, with its controllers on a ROS graph, without a simulation."""

from __future__ import annotations

import contextlib
import threading
import warnings
from collections.abc import Callable
from typing import Any

from gazelle.bridges.control.binding import ManagerBinding
from gazelle.control import ControllerManager
from gazelle.errors import ControlError, ControlWarning, Error
from gazelle_ros import Node, Time
from gazelle_ros.base.closing import Closeable
from gazelle_ros.clock import SECOND
from gazelle_ros.errors import NodeClosedError, TimeMovedBackwardsError


class LiveGraph:
    """A node for a robot with the node's clock.

    Args:
        node: On the graph.
        manager: Of the robot's controllers.
        period_ns: Of control [ns].
    """

    def __init__(self, node: Node, manager: ControllerManager, period_ns: int) -> None:
        self.node, self.world = node, 0
        self._call, self._manager, self._period_ns = manager.call, manager, period_ns

    def now(self) -> Time:
        """Return the time."""
        return Time(nsecs=self.node.clock.now())

    def stamp(self, nanoseconds: int) -> Time:
        """Return a time of the robot's as a time of the graph."""
        return Time(nsecs=nanoseconds)

    def own_ns(self, time: Time) -> int:
        """Return a time of the graph as controllers count it [ns].

        Their now is that of their next period. A loop that is late has not seen it yet: what is over by
        the node's clock would still be to come for them, such as a trajectory that ends just now.
        """
        last = self._manager.now_ns
        late = self.node.clock.now() - (last + self._period_ns) if last else 0
        return time.to_nsec() - max(0, late)

    def post(self, work: Callable[[], Any]) -> None:
        """Call a function between two control periods."""
        self._call(work)


class HardwareLoop(Closeable):
    """Reads a robot, updates its controllers and commands it, again and again, on a ROS graph.

    ::

        manager = ControllerManager(MyRobot(), namespace="/arm")
        with HardwareLoop(Node("arm"), manager, rate=100.0) as loop:
            loop.run()

    Args:
        node: On the graph; its time, simulated or the wall's, is that of the controllers.
        manager: With the robot's hardware.
        rate: Of control periods [Hz].

    Attributes:
        graph: Graph node of the robot.
    """

    def __init__(self, node: Node, manager: ControllerManager, rate: float = 100.0) -> None:
        if not rate > 0.0:
            raise ControlError(f"the rate of control periods must be positive, not {rate}")
        self._node, self._manager = node, manager
        self._period_ns = round(SECOND / rate)
        self._last_ns = 0
        self._over = threading.Event()
        self._thread: threading.Thread | None = None
        self.graph = LiveGraph(node, manager, self._period_ns)
        self._binding = ManagerBinding(self.graph, manager)
        node.on_shutdown.append(lambda _reason: self._over.set())

    def step(self, period: float | None = None) -> None:
        """Advance by one control period.

        Args:
            period: Period of the controllers [s]; the time since the last update if None.
        """
        now = self._node.clock.now()
        if period is None:
            passed = now - self._last_ns if 0 < self._last_ns < now else self._period_ns
            period = passed / SECOND
        self._last_ns, time = now, now / SECOND
        hardware, manager = self._manager.hardware, self._manager

        def work() -> None:
            hardware.read(time, period)
            manager.update(now, period)
            hardware.write(time, period)

        manager.call(work)

    def run(self) -> None:
        """Run until ``close``, or until the node ends."""
        clock = self._node.clock
        due = clock.now()
        while not self._over.is_set() and not self._node.closed:
            try:
                self.step()
            except NodeClosedError:
                break
            due += self._period_ns
            with contextlib.suppress(TimeMovedBackwardsError):
                clock.sleep(due - clock.now(), self._over.is_set)
            if abs(due - clock.now()) > self._period_ns:
                due = clock.now()  # too late to be made up for, or simulated time began again

    def start(self) -> HardwareLoop:
        """Start ``run`` in a thread of its own; returns this."""
        if self._thread is None:
            self._thread = threading.Thread(target=self._work, name="control", daemon=True)
            self._thread.start()
        return self

    def _work(self) -> None:
        try:
            self.run()
        except Error as error:
            warnings.warn(ControlWarning(f"the control loop ends: {error}"), stacklevel=2)

    def close(self) -> None:
        """Stop the loop, and remove the controllers from the graph; the node stays."""
        self._over.set()
        if self._thread is not None:
            self._thread.join()
        self._binding.close()
