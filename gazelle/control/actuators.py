"""Actuators behind the joints of a robot: what transmissions make of what joints do."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gazelle.array_types import Floats, Indices
from gazelle.control.interfaces import HardwareInterface, JointStateInterface
from gazelle.control.transmissions import (
    DifferentialTransmission,
    FourBarLinkageTransmission,
    LinearTransmission,
    SimpleTransmission,
)
from gazelle.description import TRANSMISSION_WIDTHS, Transmission
from gazelle.errors import ControlError, did_you_mean

ACTUATOR_STATE = "hardware_interface/ActuatorStateInterface"

_PREFIX = "transmission_interface/"


@dataclass(frozen=True, slots=True)
class ActuatorDrive:
    """A transmission of a robot.

    Attributes:
        joints: Names, in the order of the transmission's formulas.
        actuators: Names, likewise.
        law: Between them.
    """

    joints: tuple[str, ...]
    actuators: tuple[str, ...]
    law: LinearTransmission


def drive_of(transmission: Transmission) -> ActuatorDrive:
    """Return the drive of a ``<transmission>``, with its reductions and offsets.

    Where there are roles (``joint1``, ``actuator2``), they say which joint and which actuator is which,
    else their order does.

    Raises:
        ControlError: Its type is not known, it has too many or too few joints or actuators, roles
            that is impossible, or a reduction of zero.
    """
    kind = transmission.type.removeprefix(_PREFIX)
    width = TRANSMISSION_WIDTHS.get(_PREFIX + kind)
    if width is None:
        raise ControlError(
            f"transmission '{transmission.name}' is of the type '{transmission.type}', which is not known",
            source=transmission.source,
            hint=did_you_mean(_PREFIX + kind, TRANSMISSION_WIDTHS),
        )
    if len(transmission.joints) != width or len(transmission.actuators) != width:
        raise ControlError(
            f"transmission '{transmission.name}' has {len(transmission.joints)} joints and {len(transmission.actuators)} "
            f"actuators; a {kind} has {width} of each",
            source=transmission.source,
        )
    joints = _order(transmission, transmission.joint_roles, "joint", width)
    motors = _order(transmission, transmission.actuator_roles, "actuator", width)
    reductions = [transmission.actuators[i][1] for i in motors]
    offsets = [transmission.offsets[i] if transmission.offsets else 0.0 for i in joints]
    own = [
        transmission.joint_reductions[i] if transmission.joint_reductions else 1.0 for i in joints
    ]
    try:
        law: LinearTransmission
        if kind == "SimpleTransmission":
            law = SimpleTransmission(reductions[0], offsets[0])
        elif kind == "DifferentialTransmission":
            law = DifferentialTransmission(reductions, own, offsets)
        else:
            law = FourBarLinkageTransmission(reductions, own, offsets)
    except ControlError as error:
        text = f"transmission '{transmission.name}': {error.message}"
        raise ControlError(text, source=transmission.source) from None
    names = tuple(transmission.joints[i][0] for i in joints)
    return ActuatorDrive(names, tuple(transmission.actuators[i][0] for i in motors), law)


def _order(transmission: Transmission, roles: Sequence[str], what: str, width: int) -> list[int]:
    """Return the indices of the first and the second joint or actuator in the file."""
    if width == 1 or not any(roles):
        return [*range(width)]
    expected = [f"{what}{number}" for number in range(1, width + 1)]
    if sorted(roles) != expected:
        raise ControlError(
            f"the roles of transmission '{transmission.name}' must be {' and '.join(expected)}, not "
            f"{', '.join(repr(each) for each in roles)}",
            source=transmission.source,
        )
    return [list(roles).index(each) for each in expected]


class ActuatorStateInterface(HardwareInterface):
    """Positions, velocities and efforts of actuators, from those of joints; nothing until they are read.

    Args:
        drives: Transmissions, no actuator in two of them.
        states: Of the joints.

    Raises:
        ControlError: Two transmissions have an actuator of one name.
    """

    def __init__(self, drives: Sequence[ActuatorDrive], states: JointStateInterface) -> None:
        names = [name for drive in drives for name in drive.actuators]
        for name in names:
            if names.count(name) > 1:
                raise ControlError(f"two transmissions have an actuator '{name}'")
        super().__init__(ACTUATOR_STATE, names, claims=False)
        self._states = states
        self._drives = [(drive.law, states.columns(drive.joints)) for drive in drives]

    @property
    def position(self) -> Floats:
        """Position [m or rad], shape (nworld, actuators)."""
        joints = self._states.position
        return self._side_by_side(
            [law.actuator_position(joints[:, at]) for law, at in self._drives]
        )

    @property
    def velocity(self) -> Floats:
        """Velocity [m/s or rad/s], shape (nworld, actuators)."""
        joints = self._states.velocity
        return self._side_by_side(
            [law.actuator_velocity(joints[:, at]) for law, at in self._drives]
        )

    @property
    def effort(self) -> Floats:
        """Effort [N or N m], shape (nworld, actuators)."""
        joints = self._states.effort
        return self._side_by_side([law.actuator_effort(joints[:, at]) for law, at in self._drives])

    def _side_by_side(self, parts: Sequence[Floats]) -> Floats:
        nothing = np.zeros((len(self._states.position), 0))
        return np.concatenate([nothing, *parts], axis=1)

    def handles(self, names: Sequence[str]) -> ActuatorHandles:
        """Return handles to read some actuators."""
        self.check(names)
        columns = np.array([self.resources.index(name) for name in names], np.intp)
        return ActuatorHandles(tuple(names), self, columns)


class ActuatorHandles:
    """Some actuators of a robot, in the order of a controller.

    Args:
        names: Of the actuators.
        states: Of all.
        columns: Their columns.
    """

    def __init__(
        self, names: tuple[str, ...], states: ActuatorStateInterface, columns: Indices
    ) -> None:
        self.names = names
        self._states, self._columns = states, columns

    @property
    def position(self) -> Floats:
        """Position [m or rad], shape (nworld, n)."""
        return self._states.position[:, self._columns]

    @property
    def velocity(self) -> Floats:
        """Velocity [m/s or rad/s], shape (nworld, n)."""
        return self._states.velocity[:, self._columns]

    @property
    def effort(self) -> Floats:
        """Effort [N or N m], shape (nworld, n)."""
        return self._states.effort[:, self._columns]
