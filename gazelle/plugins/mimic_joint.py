"""Joints that follow others: ``libroboticsgroup_gazebo_mimic_joint_plugin.so`` and its kin."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Worlds
from gazelle.description import Parameters
from gazelle.errors import SimulationError
from gazelle.plugins.pid import Gains, GazeboPid
from gazelle.simulation import ModelPlugin, Robot, Setting, absolute, namespace_of

# Time in which a motor makes up for most of what it lacks [s].
_HASTE = 0.1


class MimicJoint(ModelPlugin):
    """Puts a joint at a multiple of another's position, plus an offset, at every step.

    With ``hasPID`` it is moved there with at most ``maxEffort``: by a PID controller if there
    are gains in the parameter ``gazebo_ros_control/pid_gains/JOINT``, else by a motor.
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
        self._effort = parameters.get("maxEffort", 1.0)
        if self._effort <= 0.0:
            raise SimulationError("maxEffort must be positive", source=parameters.source)
        self._nworld = robot.simulation.nworld
        self._physics = robot.simulation.physics
        self._pid: GazeboPid | None = None
        tag = parameters.find("hasPID")
        # An empty tag says yes.
        self._pushed = tag is not None and (not tag.text or tag.value(bool))
        if self._pushed:
            self._mimic.add_motor(self._effort)
            name = f"gazebo_ros_control/pid_gains/{parameters.require('mimicJoint', str)}"
            full = absolute(namespace_of(robot, parameters), name)
            robot.settings[name] = Setting(full, {}, self._take_gains)

    def _take_gains(self, given: Mapping[str, Any]) -> None:
        """Control by PID from now on."""
        gains = Gains.of_ros_control(given, self._effort)
        self._pid = GazeboPid(gains, self._nworld)
        self._mimic.set_properties(motor_effort=0.0)

    def on_update(self, time: float) -> None:  # noqa: ARG002  it acts at every step
        """Follow the other joint."""
        name = self._mimic.name
        lower = self._engine.parameter("joint_lower", name)
        upper = self._engine.parameter("joint_upper", name)
        desired = self._joint.positions()[:, :1] * self._multiplier + self._offset
        target = np.clip(desired, lower, upper)
        error = target - self._mimic.positions()[:, :1]
        if self._pid is not None:
            efforts = self._pid.update(-error[:, 0], self._physics.time_step)
            self._mimic.effort = np.where(np.abs(error[:, 0]) >= self._spared, efforts, 0.0)
            return
        if self._pushed:
            pace = self._joint.velocities()[:, :1] * self._multiplier
            self._mimic.drive((pace + error / _HASTE)[:, 0])
            return
        chosen = np.flatnonzero(np.abs(error[:, 0]) >= self._spared)
        if chosen.size:
            pace = self._joint.velocities()[:, :1] * self._multiplier
            self._engine.joints[name].set_position(target[chosen], chosen)
            self._engine.joints[name].set_velocity(pace[chosen], chosen)

    def reset(self, worlds: Worlds | None) -> None:
        """Discard integrals."""
        if self._pid is not None:
            self._pid.reset(worlds)

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return the integrals."""
        return {} if self._pid is None else self._pid.state()

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        if self._pid is not None:
            self._pid.restore(state)
