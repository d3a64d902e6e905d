"""What ``/gazebo`` publishes: the clock, all models and links, and how fast the run is."""

from __future__ import annotations

import functools
import struct
import time
from collections.abc import Sequence
from typing import Any

import numpy as np

from gazelle.bridges.gazebo.context import Context
from gazelle.bridges.gazebo.entities import State
from gazelle.bridges.outbox import Outbox
from gazelle.ros import load_message
from gazelle.simulation import Plugin

# How often the performance is published, in simulated time [Hz].
_PERFORMANCE_RATE = 5.0
_COUNT = struct.Struct("<I")
_STAMP = struct.Struct("<II")


class ClockBeat(Plugin):
    """Publishes ``/clock`` while somebody listens.

    Args:
        context: Of the door.
        rate: At most [Hz]; 0 means every step.
    """

    def __init__(self, context: Context, rate: float) -> None:
        self.update_rate = rate
        self._context = context
        self._publisher = context.node.advertise(
            "/clock", load_message("rosgraph_msgs/Clock"), 10, on_connect=self._greet
        )
        self._outbox = Outbox(self._publisher)

    @property
    def active(self) -> bool:
        """Whether somebody listens."""
        return self._publisher.has_listener

    def on_update(self, time: float) -> None:  # noqa: ARG002  the context knows the time
        """Tick."""
        self.publish()

    def publish(self) -> None:
        """Tell the time."""
        if self._publisher.has_listener:
            now = self._context.now()
            self._outbox.add(_STAMP.pack(now.secs, now.nsecs))

    def flush(self) -> None:
        """Send what waits to be sent."""
        self._outbox.flush()

    def close(self) -> None:
        """Stop."""
        self._publisher.close()

    def _greet(self, _peer: str) -> None:
        """Tell who comes the time, also while the simulation is paused."""

        def work() -> None:
            self.publish()
            self.flush()

        self._context.simulation.requests.post(work)


class StatesBeat(Plugin):
    """Publishes ``model_states`` and ``link_states`` at every step while somebody listens."""

    update_rate = 0.0

    def __init__(self, context: Context) -> None:
        self._context = context
        self._models = context.node.advertise(
            "~model_states", load_message("gazebo_msgs/ModelStates"), 10
        )
        self._links = context.node.advertise(
            "~link_states", load_message("gazebo_msgs/LinkStates"), 10
        )
        self._outboxes = Outbox(self._models), Outbox(self._links)

    @property
    def active(self) -> bool:
        """Whether somebody listens."""
        return self._models.has_listener or self._links.has_listener

    def on_update(self, time: float) -> None:  # noqa: ARG002  messages carry no time
        """Publish."""
        self.publish()

    def publish(self) -> None:
        """Tell where everything is."""
        entities = self._context.entities
        if self._models.has_listener:
            robots = self._context.simulation.robots
            states = [entities.model_state(robot) for robot in robots.values()]
            self._outboxes[0].add(packed(tuple(robots), states))
        if self._links.has_listener:
            links = entities.links()
            names = tuple(link.name for link in links)
            states = [entities.link_state(link) for link in links]
            self._outboxes[1].add(packed(names, states))

    def flush(self) -> None:
        """Send what waits to be sent."""
        for outbox in self._outboxes:
            outbox.flush()

    def close(self) -> None:
        """Stop."""
        self._models.close()
        self._links.close()


def packed(names: tuple[str, ...], states: Sequence[State]) -> bytes:
    """A ``ModelStates`` or ``LinkStates``, serialised: it goes out at every step."""
    count = _COUNT.pack(len(states))
    poses, twists = np.empty((len(states), 7), "<f8"), np.empty((len(states), 6), "<f8")
    for pose, twist, state in zip(poses, twists, states, strict=True):
        pose[:3], pose[3:] = state.position, state.quaternion
        twist[:3], twist[3:] = state.linear, state.angular
    return b"".join((_names(names), count, poses.tobytes(), count, twists.tobytes()))


@functools.lru_cache(maxsize=8)
def _names(names: tuple[str, ...]) -> bytes:
    """An array of strings, serialised."""
    encoded = [name.encode() for name in names]
    return b"".join([_COUNT.pack(len(names)), *(_COUNT.pack(len(e)) + e for e in encoded)])


class PerformanceBeat(Plugin):
    """Publishes ``performance_metrics`` while somebody listens."""

    update_rate = _PERFORMANCE_RATE

    def __init__(self, context: Context) -> None:
        self._context = context
        self._publisher = context.node.advertise(
            "~performance_metrics", load_message("gazebo_msgs/PerformanceMetrics"), 10
        )
        self._wall = time.monotonic()
        self._simulated = context.simulation.time

    @property
    def active(self) -> bool:
        """Whether somebody listens."""
        return self._publisher.has_listener

    def on_update(self, time: float) -> None:
        """Measure since the last time and publish."""
        self._publish(time)

    def reset(self, worlds: Any) -> None:
        """Measure anew from here."""
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
        one = load_message("gazebo_msgs/SensorPerformanceMetric")
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
