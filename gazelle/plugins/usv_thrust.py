"""Propellers of vessels: what ``libusv_gazebo_thrust_plugin.so`` does."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.description import Parameters
from gazelle.engines.limits import NANOSECONDS
from gazelle.errors import SimulationError
from gazelle.rotations import cross, rotate
from gazelle.simulation import Input, ModelPlugin, Robot, absolute, namespace_of
from gazelle.simulation.values import DriveCommand, Number

_IDLE = 0.01
_NEVER = -1


@dataclass(frozen=True, slots=True)
class _Logistic:
    """A generalised logistic function, as it was fitted to the WAM-V's motors [N]."""

    low: float
    high: float
    growth: float
    skew: float
    offset: float
    middle: float

    def __call__(self, command: Floats) -> Floats:
        rising = self.offset + np.exp(-self.growth * (command - self.middle))
        return np.asarray(self.low + (self.high - self.low) / rising ** (1.0 / self.skew))


_AHEAD = _Logistic(0.01, 59.82, 5.0, 0.38, 0.56, 0.28)
_ASTERN = _Logistic(-199.13, -0.09, 8.84, 5.34, 0.99, -0.57)


@dataclass(frozen=True, slots=True)
class ThrustCurve:
    """Thrust as a function of the command.

    Attributes:
        logistic: By the curve of the WAM-V's motors; else in proportion.
        most_command: Command of the largest force.
        ahead: Largest force ahead [N].
        astern: Largest force astern [N], above 0.
    """

    logistic: bool
    most_command: float
    ahead: float
    astern: float

    @classmethod
    def read(cls, parameters: Parameters, ahead: float) -> ThrustCurve:
        """Read the tags of a plugin or a thruster.

        Raises:
            SimulationError: The mapping is neither 0 nor 1.
        """
        mapping = parameters.get("mappingType", 0)
        if mapping not in (0, 1):
            raise SimulationError(
                f"mappingType must be 0 (in proportion) or 1 (a curve), not {mapping}",
                source=parameters.source,
            )
        return cls(
            mapping == 1,
            parameters.get("maxCmd", 1.0),
            parameters.get("maxForceFwd", ahead),
            abs(parameters.get("maxForceRev", -100.0)),
        )

    def force(self, command: Floats) -> Floats:
        """Return the thrust of commands [N], of their shape."""
        if self.logistic:
            ahead, astern = _AHEAD(command), _ASTERN(command)
            thrust = np.where(command > _IDLE, ahead, np.where(command < -_IDLE, astern, 0.0))
        else:
            most = np.where(command < 0.0, self.astern, self.ahead)
            thrust = command / self.most_command * most
        return np.clip(thrust, -self.astern, self.ahead)


class UsvThrust(ModelPlugin):
    """Drives a vessel by its propellers, until commands stay away for ``cmdTimeout``.

    With ``<thruster>`` tags each propeller has a link, which is pushed along its x axis, and a topic of its
    own. Without, as in the first versions, ``cmd_drive`` has a command for each side.
    """

    update_rate = 0.0

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, find the links, open the ports."""
        simulation = robot.simulation
        self._engine, self._applied_wrenches = simulation.engine, simulation.applied_wrenches
        self._clock, nworld = simulation.clock, simulation.nworld
        self._timeout = parameters.get("cmdTimeout", 1.0)
        namespace = namespace_of(robot, parameters)
        thrusters = list(parameters.find_all("thruster"))
        self._links = [robot.frame(each.require("linkName", str)) for each in thrusters]
        self._curves = [ThrustCurve.read(each, 250.0) for each in thrusters]
        self._commands: Floats = np.zeros((nworld, len(thrusters) or 2))
        self._received_ns = np.full(self._commands.shape, _NEVER, np.int64)
        for column, each in enumerate(thrusters):
            topic = each.require("cmdTopic", str)
            robot.inputs[topic.strip("/")] = Input(
                absolute(namespace, topic), Number, self._one(column), queue_size=1
            )
        if not thrusters:
            self._read_pair(robot, parameters, namespace)

    def _read_pair(self, robot: Robot, parameters: Parameters, namespace: str) -> None:
        self._body, _ = robot.frame(parameters.get("bodyName", next(iter(robot.links))))
        self._curve = ThrustCurve.read(parameters, 100.0)
        self._width = parameters.get("boatWidth", 1.0)
        length = parameters.get("boatLength", 1.35)
        self._stern = np.array((-0.5 * length, 0.0, parameters.get("thrustOffsetZ", -0.01)))
        robot.inputs["cmd_drive"] = Input(
            absolute(namespace, "cmd_drive"), DriveCommand, self._both, queue_size=1
        )

    # -- commands -------------------------------------------------------------------

    def _one(self, column: int) -> Callable[[Number, Worlds | None], None]:
        def take(command: Number, worlds: Worlds | None) -> None:
            self._take(worlds, slice(column, column + 1), command.value)

        return take

    def _both(self, command: DriveCommand, worlds: Worlds | None) -> None:
        rows: slice | Worlds = slice(None) if worlds is None else worlds
        self._take(rows, slice(0, 1), np.reshape(command.left, (-1, 1)))
        self._take(rows, slice(1, 2), np.reshape(command.right, (-1, 1)))

    def _take(self, worlds: slice | Worlds | None, columns: slice, value: Floats | float) -> None:
        rows = slice(None) if worlds is None else worlds
        if not np.isfinite(value).all():
            raise SimulationError(f"a command of a propeller must be finite, not {value}")
        self._commands[rows, columns] = value
        self._received_ns[rows, columns] = self._clock.now_ns

    # -- what it does ----------------------------------------------------------------------

    def on_update(self, time: float) -> None:  # noqa: ARG002  it acts at every step
        """Apply thrust."""
        if self._timeout > 0.0:
            silent = self._clock.now_ns - self._received_ns > self._timeout * NANOSECONDS
            self._commands[silent] = 0.0
        if self._links:
            self._push_each()
        else:
            self._push_pair()

    def _push_pair(self) -> None:
        thrust = self._curve.force(self._commands)
        place = self._body.placement()
        force, torque = np.zeros((2, len(thrust), 3))
        force[:, 0] = thrust.sum(axis=1)
        # By the whole width, not half of it: so in the original.
        torque[:, 2] = (thrust[:, 1] - thrust[:, 0]) * self._width
        force, torque = rotate(place.quaternion, force), rotate(place.quaternion, torque)
        lever = rotate(place.quaternion, np.broadcast_to(self._stern, force.shape))
        self._applied_wrenches.hold(
            "usv_thrust", self._body.name, force, torque + cross(lever, force)
        )

    def _push_each(self) -> None:
        for column, ((link, frame), curve) in enumerate(
            zip(self._links, self._curves, strict=True)
        ):
            place = link.placement()
            ahead = rotate(place.quaternion, _tiled(frame.matrix()[:3, 0], len(self._commands)))
            force = curve.force(self._commands[:, column])[:, None] * ahead
            at = rotate(place.quaternion, _tiled(np.asarray(frame.position), len(force)))
            lever = place.position + at - self._engine.links[link.name].centre()
            self._applied_wrenches.hold(
                f"usv_thrust {column}", link.name, force, cross(lever, force)
            )

    # -- forgetting and saving -------------------------------------------------------------

    def reset(self, worlds: Worlds | None) -> None:
        """Discard commands."""
        rows = slice(None) if worlds is None else worlds
        self._commands[rows], self._received_ns[rows] = 0.0, _NEVER

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return commands and their times."""
        return {"commands": self._commands.copy(), "received": self._received_ns.copy()}

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        self._commands[:], self._received_ns[:] = state["commands"], state["received"]


def _tiled(vector: Floats, count: int) -> Floats:
    return np.broadcast_to(vector, (count, 3))
