"""Servos that turn a head to an orientation: what ``libhector_servo_plugin.so`` does."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.description import Parameters
from gazelle.errors import SimulationError
from gazelle.plugins.frames import placed
from gazelle.plugins.received_frames import ReceivedFrames
from gazelle.rotations import conjugate, multiply
from gazelle.simulation import (
    Input,
    JointStates,
    ModelPlugin,
    Output,
    Robot,
    Schedule,
    Transforms,
    absolute,
    namespace_of,
)
from gazelle.simulation.values import TurnCommand

# The frame whose axes the servos count from, and that of commands before the first one.
_BASE, _LEVEL = "base_link", "base_stabilized"
# The axes of the servos from the base on; the second of the three angles is always about y.
_ORDERS = {"y": "xyz", "zy": "zyx", "xy": "xyz", "zyx": "zyx", "xyz": "xyz"}
_AXES = {(1.0, 0.0, 0.0): "x", (0.0, 1.0, 0.0): "y", (0.0, 0.0, 1.0): "z"}


class HectorServo(ModelPlugin):
    """Turns one to three servos so that the last link has an orientation in some frame.

    Frames are those of ``/tf``, or the model's own where it does not have them. While one is
    not known the servos stand still.
    """

    update_rate = 0.0

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, find the servos, open the ports."""
        self._robot, self._clock = robot, robot.simulation.clock
        tags = [
            (place, parameters.get(f"{place}ServoName", ""))
            for place in ("first", "second", "third")
        ]
        self._names = tuple(name for _, name in tags if name)
        self._servos = [robot.joints[name] for name in self._names]
        letters = "".join(_axis(parameters, place) for place, name in tags if name)
        if letters not in _ORDERS:
            raise SimulationError(
                f"servos about '{letters}' are not known",
                source=parameters.source,
                hint=f"from the base on, known are {', '.join(_ORDERS)}",
            )
        self._order, self._first = _ORDERS[letters], 1 if letters == "y" else 0
        self._gains = (
            parameters.get("proportionalControllerGain", 8.0),
            parameters.get("derivativeControllerGain", 0.0),
        )
        self._fastest = parameters.get("maxVelocity", 0.0)
        self._torque = parameters.get("torque", 0.0)
        for servo in self._servos if self._torque > 0.0 else ():
            servo.add_motor(self._torque)
        self._schedule = Schedule(parameters.get("controlRate", 0.0))
        nworld = robot.simulation.nworld
        self._received = ReceivedFrames(nworld)
        self._wanted: Floats = np.zeros((nworld, 4))
        self._frames = np.full(nworld, _LEVEL, object)
        self._speeds: Floats = np.zeros((nworld, len(self._servos)))
        self._forget(None)
        self._open(robot, parameters)

    def _forget(self, worlds: Worlds | None) -> None:
        rows = slice(None) if worlds is None else worlds
        self._wanted[rows], self._frames[rows] = (0.0, 0.0, 0.0, 1.0), _LEVEL
        self._speeds[rows] = 0.0

    def _open(self, robot: Robot, parameters: Parameters) -> None:
        namespace = namespace_of(robot, parameters)
        topic = parameters.get("topicName", "drive")
        robot.inputs[topic.strip("/")] = Input(
            absolute(namespace, topic), TurnCommand, self._take, forget=self._forget, queue_size=1
        )
        robot.inputs[f"{topic.strip('/')} frames"] = Input(
            "/tf", Transforms, self._received.receive, queue_size=100
        )
        states = parameters.get("jointStateName", "joint_states")
        self._states = Output(
            absolute(namespace, states),
            JointStates,
            self._read,
            frame=next(iter(robot.links)),
            queue_size=10,
        )
        robot.outputs[f"{topic.strip('/')} {states.strip('/')}"] = self._states

    def _take(self, command: TurnCommand, worlds: Worlds | None) -> None:
        rows = slice(None) if worlds is None else worlds
        self._wanted[rows], self._frames[rows] = command.quaternion, command.frame.lstrip("/")

    def on_update(self, time: float) -> None:  # noqa: ARG002  it counts in nanoseconds
        """Turn the servos, and publish their angles."""
        if self._schedule.is_due(self._clock.now_ns):
            self._schedule.done(self._clock.now_ns)
            self._aim()
            self._states.publish()
        for servo, speeds in zip(self._servos, self._speeds.T, strict=True):
            if self._torque > 0.0:
                servo.drive(speeds)
            else:
                servo.velocity = speeds

    def _aim(self) -> None:
        """Compute the speeds of the servos."""
        self._speeds[:] = 0.0
        p, d = self._gains
        for frame in np.unique(self._frames):
            turn = self._turn(frame)
            if turn is None:
                continue
            worlds = np.flatnonzero(self._frames == frame)
            angles = angles_of(multiply(turn, self._wanted)[worlds], self._order)
            for i, servo in enumerate(self._servos):
                error = angles[:, self._first + i] - servo.positions(worlds)[:, 0]
                self._speeds[worlds, i] = p * error - d * servo.velocities(worlds)[:, 0]
        if self._fastest > 0.0:
            np.clip(self._speeds, -self._fastest, self._fastest, out=self._speeds)

    def _turn(self, frame: str) -> Floats | None:
        """Return the orientation of a frame relative to the base, in all worlds."""
        turn = self._received.turn(_BASE, frame)
        if turn is not None:
            return turn
        try:
            base, other = (self._robot.frame(name) for name in (_BASE, frame))
        except SimulationError:
            return None
        return multiply(conjugate(placed(base).quaternion), placed(other).quaternion)

    def _read(self) -> JointStates:
        positions = [servo.positions()[:, :1] for servo in self._servos]
        speeds = [servo.velocities()[:, :1] for servo in self._servos]
        positions_now = np.concatenate(positions, axis=1)
        return JointStates(
            self._clock.now_ns,
            self._names,
            positions_now,
            np.concatenate(speeds, axis=1),
            np.zeros_like(positions_now),
        )

    def reset(self, worlds: Worlds | None) -> None:
        """Discard the command."""
        self._forget(worlds)
        if worlds is None:
            self._schedule.restart()

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return the command, the received frames and the speeds of the servos."""
        return {
            **self._received.state(),
            "wanted": self._wanted.copy(),
            "wanted frames": self._frames.astype(np.str_),
            "speeds": self._speeds.copy(),
        }

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        self._received.restore(state)
        self._wanted[:], self._speeds[:] = state["wanted"], state["speeds"]
        self._frames[:] = state["wanted frames"]


def _axis(parameters: Parameters, place: str) -> str:
    given = parameters.numbers(f"{place}ServoAxis", (0.0, 0.0, 0.0))
    return _AXES.get((given[0], given[1], given[2]), "?")


def angles_of(quaternion: Floats, order: str) -> Floats:
    """Return angles about three axes, each in the frame after the one before [rad], shape (n, 3).

    Args:
        quaternion: (x, y, z, w), shape (n, 4).
        order: ``xyz`` or ``zyx``.
    """
    x, y, z, w = quaternion.T
    if order == "zyx":
        first = np.arctan2(2.0 * (x * y + w * z), w * w + x * x - y * y - z * z)
        second = np.arcsin(np.clip(2.0 * (w * y - x * z), -1.0, 1.0))
        third = np.arctan2(2.0 * (y * z + w * x), w * w - x * x - y * y + z * z)
    else:
        first = np.arctan2(2.0 * (w * x - y * z), w * w - x * x - y * y + z * z)
        second = np.arcsin(np.clip(2.0 * (x * z + w * y), -1.0, 1.0))
        third = np.arctan2(2.0 * (w * z - x * y), w * w + x * x - y * y - z * z)
    return np.stack((first, second, third), axis=1)
