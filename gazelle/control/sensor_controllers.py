"""Controllers that publish sensors of the robot."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Worlds
from gazelle.control.control_law import ControlLaw
from gazelle.control.controller import Controller
from gazelle.control.parameters import ControllerParameters
from gazelle.control.publishing import PublishingSchedule
from gazelle.control.values import ImuSample, StampedWrench


class SensorController(Controller):
    """Publishes each sensor of its interface below the sensor's name, at ``publish_rate``."""

    kind: type[Any]

    def init(self, parameters: ControllerParameters) -> None:
        """Read ``publish_rate``, open the ports."""
        names = self.hardware.interface(self.interfaces[0]).resources
        self._schedule = PublishingSchedule(parameters.number("publish_rate"))
        measures: list[Callable[[], Any]] = self.resources(self.interfaces[0], names)
        self._ports = [
            self.add_output(name, self.kind, measure, topic=name, queue_size=4)
            for name, measure in zip(names, measures, strict=True)
        ]

    def starting(self, time: float) -> None:  # noqa: ARG002  the manager's clock is exact
        """Publish at the next update."""
        self._schedule.start(self.now_ns)

    def update(self, time: float, period: float) -> None:  # noqa: ARG002  as above
        """Publish when it is due."""
        if self._schedule.is_due(self.now_ns):
            for port in self._ports:
                port.publish()

    def law(self) -> ControlLaw:
        """Return a law without effect on joints."""
        return ControlLaw(self.nworld)

    def wake_ns(self) -> float:
        """Return the next time to publish."""
        fresh = self._schedule.next_ns == 0.0
        needed = fresh or any(port.wanted for port in self._ports)
        return self._schedule.next_ns if needed else math.inf

    def catch_up(self, updates: int, period: float) -> None:  # noqa: ARG002  its schedule knows
        """Advance the schedule past native updates: nothing had subscribers."""
        self._schedule.skip(self.now_ns, updates)

    def reset(self, worlds: Worlds | None) -> None:
        """Publish at once if time started again."""
        if worlds is None:
            self._schedule.start(self.now_ns)

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return the next due time."""
        return self._schedule.state()

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        self._schedule.restore(state)


class ImuSensorController(SensorController):
    """Publishes the robot's IMUs."""

    kind = ImuSample


class ForceTorqueSensorController(SensorController):
    """Publishes the robot's force-torque sensors."""

    kind = StampedWrench
