"""Joints under control: what ``libJointControlPlugin.so`` does."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.description import Parameters
from gazelle.errors import SimulationError, did_you_mean
from gazelle.plugins.pid import Gains, GazeboPid
from gazelle.simulation import JointHandle, ModelPlugin, Robot, Stopwatch
from gazelle.states import restore_all, states_of

_TYPES = ("force", "position", "velocity")


@dataclass(slots=True)
class _Controller:
    """One joint's share of a ``<controller>``; no PID for a force."""

    joint: JointHandle
    type: str
    target: float
    pid: GazeboPid | None

    def effort(self, interval: float) -> Floats:
        """Return the controller's output, shape (nworld,)."""
        if self.type == "position":
            values = self.joint.positions()[:, 0]
        else:
            values = self.joint.velocities()[:, 0]
        if self.pid is None:
            return np.full_like(values, self.target)
        return self.pid.update(values - self.target, interval)


class JointControl(ModelPlugin):
    """Holds joints at positions or velocities by PID, or turns them with constant efforts.

    Controllers of one joint add up.
    """

    update_rate = 0.0

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the controllers, find their joints."""
        self._clock = robot.simulation.clock
        self._controllers = [
            controller
            for tags in parameters.find_all("controller")
            for controller in _controllers(robot, tags)
        ]
        pids = enumerate(each.pid for each in self._controllers)
        self._pids = {str(i): pid for i, pid in pids if pid is not None}
        self._watch = Stopwatch(robot.simulation.clock)

    def on_update(self, time: float) -> None:  # noqa: ARG002  the clock of the simulation counts
        """Control the joints."""
        interval = self._watch.lap()
        efforts: dict[str, Floats] = {}
        joints: dict[str, JointHandle] = {}
        for each in self._controllers:
            joints[each.joint.name] = each.joint
            efforts[each.joint.name] = efforts.get(each.joint.name, 0.0) + each.effort(interval)
        for name, joint in joints.items():
            joint.effort = efforts[name]

    def reset(self, worlds: Worlds | None) -> None:
        """Discard sums and errors."""
        for pid in self._pids.values():
            pid.reset(worlds)
        if worlds is None:
            self._watch.restart()

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return integrals and errors."""
        return {**states_of(self._pids), "time": np.array(self._watch.start_ns)}

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        self._watch.start_ns = int(np.asarray(state["time"]))
        restore_all(self._pids, state)


def _controllers(robot: Robot, tags: Parameters) -> list[_Controller]:
    kind = tags.attributes.get("type", "")
    if kind not in _TYPES:
        raise SimulationError(
            f"a controller of type '{kind}' is not known",
            source=tags.source,
            hint=did_you_mean(kind, _TYPES),
        )
    p, i, d = tags.numbers("pid_gains", (0.0, 0.0, 0.0))
    target, nworld = tags.get("target", 0.0), robot.simulation.nworld
    return [
        _Controller(
            joint,
            kind,
            target,
            None if kind == "force" else GazeboPid(Gains(p, i, d), nworld),
        )
        for name in tags.find_all("joint")
        for joint in _joints(robot, name)
    ]


def _joints(robot: Robot, tag: Parameters) -> list[JointHandle]:
    """Return the joint of a name, or those that a regular expression matches in full."""
    name = tag.text
    try:
        matching = [joint for known, joint in robot.joints.items() if re.fullmatch(name, known)]
    except re.error:
        matching = []
    return [robot.joints[name]] if name in robot.joints or not matching else matching
