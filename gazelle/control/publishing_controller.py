"""Base of controllers that measure and publish, and move nothing."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Worlds
from gazelle.control.control_law import ControlLaw
from gazelle.control.controller import Controller
from gazelle.control.ports import StatePort
from gazelle.control.publishing import PublishingSchedule


class PublishingController(Controller):
    """Publishes its ports at a rate; a subclass opens them in ``init``.

    Attributes:
        ports: Published outputs.
        schedule: Times of publishing.
    """

    ports: Sequence[StatePort[Any]]
    schedule: PublishingSchedule

    def starting(self, time: float) -> None:  # noqa: ARG002  the manager's clock is exact
        """Publish at the next update."""
        self.schedule.start(self.now_ns)

    def update(self, time: float, period: float) -> None:  # noqa: ARG002  as above
        """Publish when it is due."""
        if self.schedule.is_due(self.now_ns):
            for port in self.ports:
                port.publish()

    def law(self) -> ControlLaw:
        """Return a law without effect on joints."""
        return ControlLaw(self.nworld)

    def wake_ns(self) -> float:
        """Return the next time to publish."""
        fresh = self.schedule.next_ns == 0.0
        needed = fresh or any(port.has_subscribers for port in self.ports)
        return self.schedule.next_ns if needed else math.inf

    def catch_up(self, updates: int, period: float) -> None:  # noqa: ARG002  its schedule knows
        """Advance the schedule past native updates: nothing had subscribers."""
        self.schedule.skip(self.now_ns, updates)

    def reset(self, worlds: Worlds | None) -> None:
        """Publish at once if time started again."""
        if worlds is None:
            self.schedule.start(self.now_ns)

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return the next due time."""
        return self.schedule.state()

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        self.schedule.restore(state)
