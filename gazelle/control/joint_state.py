"""``joint_state_controller``: publishes what the robot's joints do."""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.control.interfaces import JOINT_STATE
from gazelle.control.measurements import JointStates
from gazelle.control.parameters import ControllerParameters
from gazelle.control.publishing import PublishingSchedule
from gazelle.control.publishing_controller import PublishingController
from gazelle.errors import ControlWarning


class JointStateController(PublishingController):
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
        self.ports = [
            self.add_output(
                "joint_states", JointStates, self._measure, topic="joint_states", queue_size=4
            )
        ]
        self.schedule = PublishingSchedule(rate)

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

    def _measure(self) -> JointStates:
        measured = (self._joints.position, self._joints.velocity, self._joints.effort)
        position, velocity, effort = (
            np.concatenate((own, np.broadcast_to(extra, (self.nworld, len(extra)))), axis=1)
            for own, extra in zip(measured, self._extra_values, strict=True)
        )
        return JointStates(self.now_ns, self._names, position, velocity, effort)


def _fault_of(entry: object) -> str:
    """Return the fault in an entry of ``extra_joints``; empty if there is none."""
    if not isinstance(entry, Mapping) or not isinstance(entry.get("name"), str):
        return f"it needs a name: {entry!r}"
    for key in ("position", "velocity", "effort"):
        if not isinstance(entry.get(key, 0.0), float):
            return f"{key} of '{entry['name']}' must be a float, as 0.0, not {entry[key]!r}"
    return ""
