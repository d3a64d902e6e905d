"""Interfaces of a robot's hardware for controllers: joints and sensors.

They are those of ros_control's ``hardware_interface``, for many worlds at once.

A kind of one's own is a subclass of ``HardwareInterface``, or an object of one of these classes under a
name of one's own, registered by ``RobotHardware.register``; controllers request it by that name.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Floats, Indices
from gazelle.errors import ControlError, did_you_mean

JOINT_STATE = "hardware_interface/JointStateInterface"
EFFORT = "hardware_interface/EffortJointInterface"
POSITION = "hardware_interface/PositionJointInterface"
VELOCITY = "hardware_interface/VelocityJointInterface"
POS_VEL = "hardware_interface/PosVelJointInterface"
POS_VEL_ACC = "hardware_interface/PosVelAccJointInterface"
IMU = "hardware_interface/ImuSensorInterface"
FORCE_TORQUE = "hardware_interface/ForceTorqueSensorInterface"

COMMAND_FIELDS: Mapping[str, tuple[str, ...]] = {
    EFFORT: ("effort",),
    POSITION: ("position",),
    VELOCITY: ("velocity",),
    POS_VEL: ("position", "velocity"),
    POS_VEL_ACC: ("position", "velocity", "acceleration"),
}
"""Fields of each kind of command."""


def cpp_name(interface: str) -> str:
    """Return an interface's name in C++: ``hardware_interface::EffortJointInterface``."""
    return interface.replace("/", "::")


class HardwareInterface:
    """Something that controllers read or command, resource by resource.

    Args:
        name: Such as ``hardware_interface/EffortJointInterface``.
        resources: Names of what it is of.
        claims: Whether a controller has a resource for itself. Commands are claimed, reading is not.
    """

    def __init__(self, name: str, resources: Sequence[str], *, claims: bool) -> None:
        self.name, self.resources, self.claims = name, tuple(resources), claims

    def check(self, names: Sequence[str]) -> None:
        """Check that resources exist.

        Raises:
            ControlError: There is none of a name.
        """
        for name in names:
            if name not in self.resources:
                raise ControlError(
                    f"could not find resource '{name}' in '{cpp_name(self.name)}'",
                    hint=did_you_mean(name, self.resources),
                )

    def handles(self, names: Sequence[str]) -> Any:
        """Return the handles of some resources for a controller.

        Raises:
            ControlError: There is none of a name.
        """
        self.check(names)
        return names


@checked(ControlError, after=True)
class JointStateInterface(HardwareInterface):
    """Positions, velocities and efforts of joints.

    Args:
        names: Of the joints.
        nworld: Number of worlds.
    """

    def __init__(self, names: Sequence[str], nworld: int) -> None:
        super().__init__(JOINT_STATE, names, claims=False)
        shape = (nworld, len(self.resources))
        self._arrays: dict[str, Floats] = {
            "position": np.ones(shape), "velocity": np.zeros(shape), "effort": np.ones(shape)
        }  # fmt: skip

    # Native code has the addresses of the arrays: what is assigned is copied.

    @property
    def position(self) -> Floats:
        """Position [m or rad], shape (nworld, joints)."""
        return self._arrays["position"]

    @position.setter
    def position(self, values: Floats) -> None:
        self._arrays["position"][:] = values

    @property
    def velocity(self) -> Floats:
        """Velocity [m/s or rad/s], shape (nworld, joints)."""
        return self._arrays["velocity"]

    @velocity.setter
    def velocity(self, values: Floats) -> None:
        self._arrays["velocity"][:] = values

    @property
    def effort(self) -> Floats:
        """Effort [N or N m], shape (nworld, joints)."""
        return self._arrays["effort"]

    @effort.setter
    def effort(self, values: Floats) -> None:
        self._arrays["effort"][:] = values

    def columns(self, names: Sequence[str]) -> Indices:
        """Return the columns of joints in the arrays, shape (n,)."""
        self.check(names)
        return np.array([self.resources.index(name) for name in names], np.intp)

    def handles(self, names: Sequence[str]) -> JointHandles:
        """Return handles to read some joints."""
        return JointHandles(tuple(names), self, self.columns(names), {})


class JointCommandInterface(HardwareInterface):
    """Commands of one kind to joints.

    Args:
        name: Of the interface.
        names: Of the joints, all of them in ``states``.
        states: Of the joints.
        fields: Fields of a command; ``COMMAND_FIELDS`` if None.

    Raises:
        ControlError: ``COMMAND_FIELDS`` does not have the name, and there are no fields.

    Attributes:
        commands: By field, shape (nworld, joints): what controllers want now.
    """

    def __init__(
        self,
        name: str,
        names: Sequence[str],
        states: JointStateInterface,
        fields: Sequence[str] | None = None,
    ) -> None:
        super().__init__(name, names, claims=True)
        self._states = states
        nworld = len(states.position)
        selected = COMMAND_FIELDS.get(name) if fields is None else fields
        if selected is None:
            raise ControlError(
                f"'{name}' is not an interface of commands",
                hint=did_you_mean(name, COMMAND_FIELDS) or "say what its fields are",
            )
        self.commands = {field: np.zeros((nworld, len(self.resources))) for field in selected}

    def handles(self, names: Sequence[str]) -> JointHandles:
        """Return handles to read and command some joints."""
        self.check(names)
        own = np.array([self.resources.index(name) for name in names], np.intp)
        commands = {field: (values, own) for field, values in self.commands.items()}
        return JointHandles(tuple(names), self._states, self._states.columns(names), commands)


@checked(ControlError, after=True)
class JointHandles:
    """Some joints of a robot, in the order of a controller.

    Args:
        names: Of the joints.
        states: Handles of the states.
        columns: Columns of the joints.
        commands: By field, the array of all commands and the columns in it.

    Attributes:
        names: Of the joints.
        states: Arrays of all joints of the robot.
        columns: Columns of these joints, shape (joints,).
        commands: As given.
    """

    def __init__(
        self,
        names: tuple[str, ...],
        states: JointStateInterface,
        columns: Indices,
        commands: Mapping[str, tuple[Floats, Indices]],
    ) -> None:
        self.names = names
        self.states, self.columns, self.commands = states, columns, commands

    def __len__(self) -> int:
        return len(self.names)

    @property
    def position(self) -> Floats:
        """Position [m or rad], shape (nworld, joints)."""
        return self.states.position[:, self.columns]

    @property
    def velocity(self) -> Floats:
        """Velocity [m/s or rad/s], shape (nworld, joints)."""
        return self.states.velocity[:, self.columns]

    @property
    def effort(self) -> Floats:
        """Acting efforts [N or N m], shape (nworld, joints)."""
        return self.states.effort[:, self.columns]

    @property
    def fields(self) -> tuple[str, ...]:
        """Fields of a command; empty for joints that can only be read."""
        return tuple(self.commands)

    def command(self, field: str | None = None) -> Floats:
        """Return the present command, shape (nworld, joints).

        Args:
            field: ``effort``, ``position``, ``velocity`` or ``acceleration``; the only one if None.

        Raises:
            ControlError: A command has no such field, or the joints can only be read.
        """
        values, columns = self._command_of(field)
        return values[:, columns]

    def set_command(
        self, values: Floats | float, field: str | None = None, worlds: Indices | None = None
    ) -> None:
        """Command the joints, until something else is commanded.

        Args:
            values: Shape (n, joints), or what broadcasts to that.
            field: As of ``command``.
            worlds: Worlds; all if None.

        Raises:
            ControlError: As of ``command``, or the values have another shape.
        """
        target, columns = self._command_of(field)
        if worlds is None:
            target[:, columns] = values
        else:
            target[np.ix_(worlds, columns)] = values

    def _command_of(self, field: str | None) -> tuple[Floats, Indices]:
        try:
            return self.commands[self.fields[0] if field is None else field]
        except LookupError:
            known = ", ".join(self.fields)
            raise ControlError(
                f"these joints have no command '{field}', but: {known}"
                if known
                else "these joints can only be read"
            ) from None


class SensorInterface(HardwareInterface):
    """Sensors by name, to be read; see ``measurements`` for what a reading is.

    Args:
        name: ``hardware_interface/ImuSensorInterface`` or ``ForceTorqueSensorInterface``, or one's own.
        sensors: A function for each name that measures, and returns a plain value.
    """

    def __init__(self, name: str, sensors: Mapping[str, Any]) -> None:
        super().__init__(name, tuple(sensors), claims=False)
        self._sensors = dict(sensors)

    def handles(self, names: Sequence[str]) -> Any:
        """Return the functions that measure, in this order."""
        self.check(names)
        return [self._sensors[name] for name in names]
