"""Joints that follow others: ``libroboticsgroup_gazebo_mimic_joint_plugin.so`` and its kin."""

from __future__ import annotations

import numpy as np

from gazelle.description import Parameters
from gazelle.errors import SimulationError
from gazelle.simulation import ModelPlugin, Robot

# Time in which a motor makes up for most of what it lacks [s].
_HASTE = 0.1


class MimicJoint(ModelPlugin):
    """Puts a joint at a multiple of another's position, plus an offset, at every step.

    With ``hasPID`` a motor of at most ``maxEffort`` goes there instead; the original's gains
    stand on the parameter server, which a motor that holds needs not.
    """

    update_rate = 0.0

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, find the joints."""
        self._joint = robot.joints[parameters.require("joint", str)]
        self._mimic = robot.joints[parameters.require("mimicJoint", str)]
        self._engine = robot.simulation.engine
        self._multiplier = parameters.get("multiplier", 1.0)
        self._offset = parameters.get("offset", 0.0)
        self._spared = parameters.get("sensitiveness", 0.0)
        effort = parameters.get("maxEffort", 1.0)
        if effort <= 0.0:
            raise SimulationError("maxEffort must be positive", source=parameters.source)
        tag = parameters.find("hasPID")
        # An empty tag says yes.
        self._by_motor = tag is not None and (not tag.text or tag.value(bool))
        if self._by_motor:
            self._mimic.add_motor(effort)

    def on_update(self, time: float) -> None:  # noqa: ARG002  it acts at every step
        """Follow."""
        name = self._mimic.name
        lower = self._engine.parameter("joint_lower", name)
        upper = self._engine.parameter("joint_upper", name)
        wanted = self._joint.positions()[:, :1] * self._multiplier + self._offset
        target = np.clip(wanted, lower, upper)
        lack = target - self._mimic.positions()[:, :1]
        if self._by_motor:
            pace = self._joint.velocities()[:, :1] * self._multiplier
            self._mimic.drive((pace + lack / _HASTE)[:, 0])
            return
        chosen = np.flatnonzero(np.abs(lack[:, 0]) >= self._spared)
        if chosen.size:
            pace = self._joint.velocities()[:, :1] * self._multiplier
            self._engine.set_joint_position(name, target[chosen], chosen)
            self._engine.set_joint_velocity(name, pace[chosen], chosen)
