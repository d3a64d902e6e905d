"""Joints that follow others: ``libroboticsgroup_gazebo_mimic_joint_plugin.so`` and its kin."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.description import Parameters
from gazelle.errors import SimulationError
from gazelle.plugins.pid import Gains, GazeboPid
from gazelle.simulation import (
    JointHandle,
    ModelPlugin,
    PluginSystem,
    Robot,
    Setting,
    absolute,
    namespace_of,
)

# Time in which a motor makes up for most of what it lacks [s].
_HASTE = 0.1


class MimicJoint(ModelPlugin):
    """Puts a joint at a multiple of another's position, plus an offset, at every step.

    With ``hasPID`` it is moved there with at most ``maxEffort``: by a PID controller if there
    are gains in the parameter ``gazebo_ros_control/pid_gains/JOINT``, else by a motor.
    """

    update_rate = 0.0

    joint: JointHandle
    mimic: JointHandle
    pid: GazeboPid | None = None

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, find the joints."""
        self.system = MimicSystem
        self.joint = robot.joints[parameters.require("joint", str)]
        self.mimic = robot.joints[parameters.require("mimicJoint", str)]
        self.engine = robot.simulation.engine
        self.multiplier = parameters.get("multiplier", 1.0)
        self.offset = parameters.get("offset", 0.0)
        self.spared = parameters.get("sensitiveness", 0.0)
        self._effort = parameters.get("maxEffort", 1.0)
        if self._effort <= 0.0:
            raise SimulationError("maxEffort must be positive", source=parameters.source)
        self._nworld = robot.simulation.nworld
        self._physics = robot.simulation.physics
        tag = parameters.find("hasPID")
        # An empty tag says yes.
        self.pushed = tag is not None and (not tag.text or tag.value(bool))
        if self.pushed:
            self.mimic.add_motor(self._effort)
            name = f"gazebo_ros_control/pid_gains/{parameters.require('mimicJoint', str)}"
            full = absolute(namespace_of(robot, parameters), name)
            robot.settings[name] = Setting(full, {}, self._take_gains)

    def _take_gains(self, given: Mapping[str, Any]) -> None:
        """Control by PID from now on."""
        gains = Gains.of_ros_control(given, self._effort)
        self.pid = GazeboPid(gains, self._nworld)
        self.mimic.set_properties(motor_effort=0.0)

    def control(self, error: Floats) -> None:
        """Apply the effort of the PID controller for errors [m or rad], shape (nworld,)."""
        if self.pid is None:
            return
        efforts = self.pid.update(-error, self._physics.time_step)
        self.mimic.effort = np.where(np.abs(error) >= self.spared, efforts, 0.0)

    def reset(self, worlds: Worlds | None) -> None:
        """Discard integrals."""
        if self.pid is not None:
            self.pid.reset(worlds)

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return the integrals."""
        return {} if self.pid is None else self.pid.state()

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        if self.pid is not None:
            self.pid.restore(state)


class MimicSystem(PluginSystem[MimicJoint]):
    """Mimic joints of all robots.

    Args:
        plugins: The joints; one may follow a joint that follows another itself.
    """

    def __init__(self, plugins: Sequence[MimicJoint]) -> None:
        super().__init__(plugins)
        rounds: list[list[MimicJoint]] = [[]]
        for each in plugins:
            if any(each.joint.name == other.mimic.name for other in rounds[-1]):
                rounds.append([])
            rounds[-1].append(each)
        self._rounds = [_Followers(some) for some in rounds]

    def update(self, time: float) -> None:  # noqa: ARG002  they act at every step
        """Update all: those that follow others come after these."""
        for each in self._rounds:
            each.update()


class _Followers:
    """Mimic joints that do not follow each other.

    Args:
        plugins: The joints.
    """

    def __init__(self, plugins: Sequence[MimicJoint]) -> None:
        self._plugins = plugins
        joints = plugins[0].engine.joints
        self._leaders = joints[tuple(each.joint.name for each in plugins)]
        self._followers = joints[tuple(each.mimic.name for each in plugins)]
        self._pushed = np.array([each.pushed for each in plugins])
        motors = tuple(each.mimic.name for each in plugins if each.pushed)
        self._motors = joints[motors] if motors else None
        self._multiplier = np.array([each.multiplier for each in plugins])
        self._offset = np.array([each.offset for each in plugins])
        self._spared = np.array([each.spared for each in plugins])

    def update(self) -> None:
        """Place, drive and push them."""
        target = self._leaders.position() * self._multiplier + self._offset
        error = np.clip(target, *self._followers.limits()) - self._followers.position()
        pace = self._leaders.velocity() * self._multiplier
        placed = (np.abs(error) >= self._spared) & ~self._pushed
        if placed.any():
            self._followers.place(target, pace, placed)
        if self._motors is not None:
            self._motors.set_motor_velocity((pace + error / _HASTE)[:, self._pushed])
        for column in np.flatnonzero(self._pushed).tolist():
            self._plugins[column].control(error[:, column])
