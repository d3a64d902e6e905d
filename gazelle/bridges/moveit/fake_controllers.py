"""Controllers that only say that joints are where they shall be, as MoveIt's fake ones do."""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.bridges.moveit.planning_context import LOG, PlanningContext
from gazelle.errors import PlanningError
from gazelle.planning import NoPlanError, PlanOutcome
from gazelle_ros.msgs import sensor_msgs, trajectory_msgs
from gazelle_ros.time import Time

_RATE = 10.0
_LOOK_S = 0.002


class FakeMotion:
    """Plays trajectories on ``~fake_controller_joint_states``.

    Args:
        context: The robot; ``~initial`` has its first postures by group, ``~rate`` is how often
            interpolated positions are sent [Hz].
    """

    def __init__(self, context: PlanningContext) -> None:
        self._context = context
        node = context.node
        self._kind = sensor_msgs.msg.JointState
        self._sender = node.advertise(
            "~fake_controller_joint_states", self._kind, queue_size=100, latch=True
        )
        rate = float(node.get_param("~rate", _RATE))
        self._period = 1.0 / rate if rate > 0.0 else 1.0 / _RATE
        self._begin(node.get_param("~initial", None) or [])

    def _begin(self, postures: Any) -> None:
        """Set initial joint positions."""
        found: dict[str, float] = {}
        for each in postures if isinstance(postures, list) else []:
            try:
                group = self._context.group(str(each.get("group")))
                found |= group.named(str(each.get("pose")))
            except PlanningError as error:
                LOG.warning("initial postures: %s", error)
        if found:
            self._publish_positions(found)

    def play(
        self, kind: str, trajectory: trajectory_msgs.msg.JointTrajectory, stop: Callable[[], bool]
    ) -> None:
        """Play a ``trajectory_msgs/JointTrajectory`` to its end.

        Args:
            kind: ``interpolate``, ``via points`` (each when it is due) or ``last point`` (at once).
            trajectory: With positions.
            stop: Polled; True ends the motion early.

        Raises:
            NoPlanError: It was stopped.
        """
        names = list(trajectory.joint_names)
        times = np.array([each.time_from_start.to_sec() for each in trajectory.points])
        positions = np.array([each.positions for each in trajectory.points])
        if kind != "last point":
            begun = self._context.now()
            due = times
            if kind == "interpolate":
                due = np.arange(0.0, times[-1], self._period)
            for time in due.tolist():
                self._wait(begun + int(time * 1e9), stop)
                self._publish_positions(
                    dict(zip(names, _between(times, positions, time), strict=True))
                )
            self._wait(begun + int(times[-1] * 1e9), stop)
        self._publish_positions(dict(zip(names, positions[-1].tolist(), strict=True)))

    def _wait(self, time: int, stop: Callable[[], bool]) -> None:
        pause = threading.Event()
        while self._context.now() < time:
            if stop() or self._context.node.closed:
                raise NoPlanError("the motion was stopped", PlanOutcome.PREEMPTED)
            pause.wait(_LOOK_S)

    def _publish_positions(self, positions: Mapping[str, float]) -> None:
        message = self._kind(name=[*positions], position=[*positions.values()])
        message.header.stamp = Time(nsecs=self._context.now())
        self._sender.publish(message)


def _between(times: Floats, positions: Floats, time: float) -> list[float]:
    """Return positions at a time, interpolated linearly."""
    return [float(np.interp(time, times, column)) for column in positions.T]
