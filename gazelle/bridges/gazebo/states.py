"""Topics of ``/gazebo``: the clock, states of all models and links, and performance."""

from __future__ import annotations

import struct
import time
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from gazelle.array_types import Worlds
from gazelle.bridges.gazebo.context import GazeboContext
from gazelle.bridges.outbox import Outbox
from gazelle.engines import Motion, Placement
from gazelle.simulation import BasePlugin, LinkHandle, Robot
from gazelle_ros.msgs import gazebo_msgs, rosgraph_msgs

# How often the performance is published, in simulated time [Hz].
_PERFORMANCE_RATE = 5.0
_COUNT = struct.Struct("<I")
_STAMP = struct.Struct("<II")


class ClockPublisher(BasePlugin):
    """Publishes ``/clock`` while it has subscribers.

    Args:
        context: Of the server.
        rate: At most [Hz]; 0 means every step.
    """

    def __init__(self, context: GazeboContext, rate: float) -> None:
        self.update_rate = rate
        self._context = context
        self._publisher = context.node.advertise(
            "/clock", rosgraph_msgs.msg.Clock, 10, on_connect=self._greet
        )
        self._outbox = Outbox(self._publisher)

    @property
    def active(self) -> bool:
        """True if there are subscribers."""
        return self._publisher.has_subscribers

    def on_update(self, time: float) -> None:  # noqa: ARG002  the context knows the time
        """Publish the time."""
        self.publish()

    def publish(self) -> None:
        """Publish the time."""
        if self._publisher.has_subscribers:
            now = self._context.now()
            self._outbox.add(_STAMP.pack(now.secs, now.nsecs))

    def flush(self) -> None:
        """Send what waits to be sent."""
        self._outbox.flush()

    def close(self) -> None:
        """Stop."""
        self._publisher.close()

    def _greet(self, _peer: str) -> None:
        """Send the time to a new subscriber, also while the simulation is paused."""

        def work() -> None:
            self.publish()
            self.flush()

        self._context.simulation.lock.post(work)


class StatesPublisher(BasePlugin):
    """Publishes ``model_states`` and ``link_states`` at every step while it has subscribers."""

    update_rate = 0.0

    def __init__(self, context: GazeboContext) -> None:
        self._context = context
        self._models = context.node.advertise("~model_states", gazebo_msgs.msg.ModelStates, 10)
        self._links = context.node.advertise("~link_states", gazebo_msgs.msg.LinkStates, 10)
        self._outboxes = Outbox(self._models), Outbox(self._links)
        self._tables: tuple[SerializedStates, SerializedStates] | None = None
        events = context.simulation.events
        self._forgetting = [
            event.subscribe(self._forget) for event in (events.spawned, events.deleted)
        ]

    @property
    def active(self) -> bool:
        """True if there are subscribers."""
        return self._models.has_subscribers or self._links.has_subscribers

    def on_update(self, time: float) -> None:  # noqa: ARG002  messages have no time
        """Publish."""
        self.publish()

    def publish(self) -> None:
        """Publish all poses and velocities."""
        tables = self._tables or self._make_tables()
        publishers = (self._models, self._links)
        for publisher, table, outbox in zip(publishers, tables, self._outboxes, strict=True):
            if publisher.has_subscribers:
                outbox.add(table.packed())

    def flush(self) -> None:
        """Send what waits to be sent."""
        for outbox in self._outboxes:
            outbox.flush()

    def close(self) -> None:
        """Stop."""
        for forget in self._forgetting:
            forget()
        self._models.close()
        self._links.close()

    def _forget(self, _robot: Robot) -> None:
        """Discard the tables after models changed."""
        self._tables = None

    def _make_tables(self) -> tuple[SerializedStates, SerializedStates]:
        entities = self._context.entities
        robots = self._context.simulation.robots
        self._tables = (
            SerializedStates(dict(robots), entities.worlds),
            SerializedStates({link.name: link for link in entities.links()}, entities.worlds),
        )
        return self._tables


class SerializedStates:
    """A ``ModelStates`` or ``LinkStates``, serialised: it goes out at every step.

    Args:
        rows: Models or links by name.
        worlds: The one world; None if there is only one.
    """

    def __init__(self, rows: Mapping[str, Robot | LinkHandle], worlds: Worlds | None) -> None:
        self._rows = tuple(rows.values())
        self._worlds = worlds
        count = _COUNT.pack(len(rows))
        self._head, self._count = _strings(rows) + count, count
        self._poses = np.empty((len(rows), 7), "<f8")
        self._twists = np.empty((len(rows), 6), "<f8")
        self._known: list[tuple[Placement | None, Motion | None]] = [(None, None)] * len(rows)

    def packed(self) -> bytes:
        """Return the present poses and velocities of all, serialised."""
        for i, row in enumerate(self._rows):
            place, motion = row.placement(self._worlds), row.motion(self._worlds)
            known = self._known[i]
            # What never moves answers with the very same objects.
            if place is not known[0]:
                self._poses[i, :3], self._poses[i, 3:] = place.position[0], place.quaternion[0]
            if motion is not known[1]:
                self._twists[i, :3], self._twists[i, 3:] = motion.linear[0], motion.angular[0]
            self._known[i] = (place, motion)
        parts = (self._head, self._poses.tobytes(), self._count, self._twists.tobytes())
        return b"".join(parts)


def _strings(names: Iterable[str]) -> bytes:
    """Return an array of strings, serialised."""
    encoded = [name.encode() for name in names]
    return b"".join([_COUNT.pack(len(encoded)), *(_COUNT.pack(len(e)) + e for e in encoded)])


class PerformancePublisher(BasePlugin):
    """Publishes ``performance_metrics`` while it has subscribers."""

    update_rate = _PERFORMANCE_RATE

    def __init__(self, context: GazeboContext) -> None:
        self._context = context
        self._publisher = context.node.advertise(
            "~performance_metrics", gazebo_msgs.msg.PerformanceMetrics, 10
        )
        self._wall = time.monotonic()
        self._simulated = context.simulation.time

    @property
    def active(self) -> bool:
        """True if there are subscribers."""
        return self._publisher.has_subscribers

    def on_update(self, time: float) -> None:
        """Measure since the last time and publish."""
        self._publish(time)

    def reset(self, worlds: Any) -> None:
        """Measure again from here."""
        del worlds
        self._wall, self._simulated = time.monotonic(), self._context.simulation.time

    def close(self) -> None:
        """Stop."""
        self._publisher.close()

    def _publish(self, simulated: float) -> None:
        wall = time.monotonic()
        passed, real = simulated - self._simulated, wall - self._wall
        self._wall, self._simulated = wall, simulated
        message = self._publisher.message_class()
        message.header.stamp = self._context.now()
        message.real_time_factor = passed / real if real > 0.0 else 0.0
        one = gazebo_msgs.msg.SensorPerformanceMetric
        for robot in self._context.simulation.robots.values():
            for unit in robot.sensors.values():
                rate = unit.schedule.rate if unit.awake else 0.0
                message.sensors.append(
                    one(
                        name=unit.name,
                        sim_update_rate=rate,
                        real_update_rate=rate * message.real_time_factor,
                        fps=-1.0,
                    )
                )
        self._publisher.publish(message)
