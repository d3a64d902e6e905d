"""``joint_state_controller``: publishes what the robot's joints do."""

from __future__ import annotations

import math
import warnings
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.control.control_law import ControlLaw
from gazelle.control.controller import Controller
from gazelle.control.interfaces import JOINT_STATE
from gazelle.control.measurements import JointStates
from gazelle.control.parameters import ControllerParameters
from gazelle.control.publishing import PublishingSchedule
from gazelle.errors import ControlWarning


class JointStateController(Controller):
    """Publishes positions, velocities and efforts of all joints, or of those in ``joints``."""

    def init(self, parameters: ControllerParameters) -> None:
        """Read ``publish_rate``, ``joints`` and ``extra_joints``."""
        rate = parameters.number("publish_rate")
        known = self.hardware.interface(JOINT_STATE).resources
        names = parameters.names("joints") if "joints" in parameters else tuple(sorted(known))
        self._joints = self.claim(JOINT_STATE, names)
        extra = self._extra(parameters)
        self._names = (*names, *extra)
        self._extra_values: Floats = np.array([*extra.values()], np.float64).reshape(-1, 3).T
        self._output = self.add_output(
            "joint_states", JointStates, self._measure, topic="joint_states", queue_size=4
        )
        self._schedule = PublishingSchedule(rate)

    def _extra(self, parameters: ControllerParameters) -> dict[str, tuple[float, ...]]:
        """Return the states of extra joints, which the robot does not have."""
        given = parameters.get("extra_joints", [])
        known = set(self.hardware.interface(JOINT_STATE).resources)
        found: dict[str, tuple[float, ...]] = {}
        entries: Sequence[Any] = given if isinstance(given, list | tuple) else [given]
        for entry in entries:
            fault = _fault_of(entry)
            if not fault and entry["name"] in known | {*found}:
                fault = f"joint '{entry['name']}' exists already"
            if fault:
                text = f"controller '{self.name}': an entry of extra_joints is left out: {fault}"
                warnings.warn(ControlWarning(text), stacklevel=2)
                continue
            numbers = (float(entry.get(key, 0.0)) for key in ("position", "velocity", "effort"))
            found[entry["name"]] = tuple(numbers)
        return found

    def starting(self, time: float) -> None:  # noqa: ARG002  the manager's clock is exact
        """Publish at the next update."""
        self._schedule.start(self.now_ns)

    def update(self, time: float, period: float) -> None:  # noqa: ARG002  as above
        """Publish when it is due."""
        if self._schedule.is_due(self.now_ns):
            self._output.publish()

    def law(self) -> ControlLaw:
        """Return a law without effect on joints."""
        return ControlLaw(self.nworld)

    def wake_ns(self) -> float:
        """Return the next time to publish."""
        fresh = self._schedule.next_ns == 0.0
        return self._schedule.next_ns if fresh or self._output.wanted else math.inf

    def catch_up(self, updates: int, period: float) -> None:  # noqa: ARG002  its schedule knows
        """Advance the schedule past native updates: nothing had subscribers."""
        self._schedule.skip(self.now_ns, updates)

    def _measure(self) -> JointStates:
        measured = (self._joints.position, self._joints.velocity, self._joints.effort)
        position, velocity, effort = (
            np.concatenate((own, np.broadcast_to(extra, (self.nworld, len(extra)))), axis=1)
            for own, extra in zip(measured, self._extra_values, strict=True)
        )
        return JointStates(self.now_ns, self._names, position, velocity, effort)

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


def _fault_of(entry: object) -> str:
    """Return the fault in an entry of ``extra_joints``; empty if there is none."""
    if not isinstance(entry, Mapping) or not isinstance(entry.get("name"), str):
        return f"it needs a name: {entry!r}"
    for key in ("position", "velocity", "effort"):
        if not isinstance(entry.get(key, 0.0), float):
            return f"{key} of '{entry['name']}' must be a float, as 0.0, not {entry[key]!r}"
    return ""
