"""Grippers: paddles that close on an object, a lift, beams between the paddles.

The figures, and the order of what happens in an update, are those of Stage 4.3: paddles and
lift move by a twentieth of their way each ``update_interval``.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from gazelle.argument_checks import checked
from gazelle.array_types import Floats, Worlds
from gazelle.errors import SimulationError
from gazelle.simulation.inputs import chosen, one_world
from gazelle.stage.bumpers import gaps_to
from gazelle.stage.description import (
    StageGripper,
    StageModel,
    StagePose,
)
from gazelle.stage.outlines import Outlines, outlines_of
from gazelle.stage.robots import StageRobot
from gazelle.stage.stage_bodies import StageBodies

Command = Literal["open", "close", "up", "down"]

COMMANDS: tuple[Command, ...] = ("open", "close", "up", "down")
_STEP = 0.05  # share of their way by which paddles and lift go in an update
_INSETS = (0.75, 0.25)  # of the beams from the tips, as shares of the paddles' length
_NOWHERE = -1e6  # height of a held thing: neither seen nor bumped into [m]
_CLEAR = 1e-3  # room that is left between a gripper and what it releases [m]
_NONE = -1


@dataclass(frozen=True, slots=True)
class GripperState:
    """A gripper of one world.

    Attributes:
        paddles: From 0, open, to 1, closed.
        lift: From 0, down, to 1, up.
        beams: Whether the inner and the outer beam between the paddles are broken.
        carried: Name of the held object, or None.
    """

    paddles: float
    lift: float
    beams: tuple[bool, bool]
    carried: str | None


@checked(SimulationError)
class Gripper:
    """A gripper of a robot, in all worlds.

    Args:
        simulation: Runs.
        robot: Its robot.
        model: Of it.
        pose: On the robot.

    Attributes:
        paddles: From 0, open, to 1, closed, shape (nworld,).
        lift: From 0, down, to 1, up, shape (nworld,).
        carried: Index of the held object, or -1, shape (nworld,).
    """

    def __init__(
        self, simulation: StageBodies, robot: StageRobot, model: StageModel, pose: StagePose
    ) -> None:
        self._simulation, self._robot, self._model, self._pose = simulation, robot, model, pose
        self._device = model.device_of(StageGripper) or StageGripper()
        shape = simulation.nworld
        self.paddles, self.lift = np.zeros(shape), np.zeros(shape)
        self.carried = np.full(shape, _NONE)
        self._limit = np.ones(shape)
        self._closing = np.zeros(shape, np.int8)  # 1: they close, -1: they open
        self._rising = np.zeros(shape, np.int8)
        self._outlines = [
            outlines_of([next(replace(thing, pose=StagePose()).walk())])
            for thing in simulation.things
        ]
        self.reset()

    def do(self, command: Command, worlds: Worlds | None = None) -> None:
        """Start to ``open`` or ``close`` the paddles, or to lift ``up`` or ``down``.

        Raises:
            SimulationError: There is no such command.
        """
        if command not in COMMANDS:
            raise SimulationError(
                f"a gripper has no command '{command}'", hint=f"known are {', '.join(COMMANDS)}"
            )
        which = self._rows(worlds)
        moved = self._closing if command in {"open", "close"} else self._rising
        moved[which] = 1 if command in {"close", "up"} else -1

    def state(self, world: int = 0) -> GripperState:
        """Return its state in one world now."""
        held = int(self.carried[one_world(world, len(self.paddles))])
        return GripperState(
            float(self.paddles[world]),
            float(self.lift[world]),
            self.beams(world),
            None if held == _NONE else self._simulation.things[held].name.removeprefix("/"),
        )

    def beams(self, world: int = 0) -> tuple[bool, bool]:
        """Return whether an object that can be gripped breaks the inner and the outer beam."""
        if self.carried[one_world(world, len(self.paddles))] != _NONE:
            return (True, True)
        length = self._device.paddle_size[0] * self._model.size.x
        edge = self._edge(world)
        found = []
        for inset in _INSETS:
            x = self._model.size.x / 2.0 - inset * length
            found.append(self._met(world, np.array([[x, edge], [x, -edge]])) != _NONE)
        return (found[0], found[1])

    def update(self) -> None:
        """Advance by one step of the simulation."""
        step = _STEP * self._simulation.time_step / max(self._model.update_interval, 1e-9)
        if self._device.autosnatch:
            for world in range(len(self.paddles)):
                self._closing[world] = 1 if any(self.beams(world)) else -1
        if self._rising.any():
            self.lift = np.clip(self.lift + step * self._rising, 0.0, 1.0)
            self._rising[(self.lift == 0.0) | (self.lift == 1.0)] = 0
        for world in np.flatnonzero(self._closing).tolist():
            self._move(world, step)
        for world in np.flatnonzero(self.carried != _NONE).tolist():
            self._carry(world)

    def reset(self, worlds: Worlds | None = None) -> None:
        """Reset the gripper to its start, without an object."""
        which = self._rows(worlds)
        self.paddles[which] = float(self._device.paddles == "closed")
        self.lift[which] = float(self._device.lift == "up")
        self.carried[which], self._limit[which] = _NONE, 1.0
        self._closing[which] = self._rising[which] = 0

    def arrays(self) -> dict[str, NDArray[Any]]:
        """Return all mutable state, to be read or written, each of shape (nworld,)."""
        return {
            "paddles": self.paddles,
            "lift": self.lift,
            "carried": self.carried,
            "limit": self._limit,
            "closing": self._closing,
            "rising": self._rising,
        }

    def find(self, things: Mapping[int, int]) -> None:
        """Set new indices of objects; a deleted one is no longer held."""
        self.carried[:] = [things.get(thing, _NONE) for thing in self.carried.tolist()]

    def _move(self, world: int, step: float) -> None:
        """Move the paddles of one world; release, or grip what they touch."""
        position = self.paddles[world] + step * self._closing[world]
        if self._closing[world] < 0:
            if self.carried[world] != _NONE and position < self._limit[world]:
                self._release(world)
        elif self.carried[world] == _NONE:
            self._take(world)
        least, most = 0.0, float(self._limit[world])
        if not least < position < most:
            self._closing[world] = 0
        self.paddles[world] = min(max(position, least), most)

    def _take(self, world: int) -> None:
        """Grip the object that the inner side of a paddle touches."""
        back = self._model.size.x * (0.5 - self._device.paddle_size[0])
        edge, tip = self._edge(world), self._model.size.x / 2.0
        for side in (edge, -edge):
            thing = self._met(world, np.array([[back, side], [tip, side]]))
            if thing != _NONE:
                self.carried[world] = thing
                wide = self._simulation.things[thing].size.y
                room = self._model.size.y - self._device.paddle_size[1] / 2.0
                self._limit[world] = max(0.0, 1.0 - wide / max(room, 1e-9))
                return

    def _carry(self, world: int) -> None:
        """Move the held object with the gripper, out of reach of all others."""
        body, at = self._body(int(self.carried[world])), self._place(world)
        self._simulation.engine.place_body(
            body, (at.x, at.y, at.yaw), np.array([world]), height=_NOWHERE
        )

    def _release(self, world: int) -> None:
        """Place the held object between the paddles if it fits, else before them."""
        thing = int(self.carried[world])
        model, size = self._simulation.things[thing], self._model.size
        radius = math.hypot(model.size.x, model.size.y) / 2.0
        narrow = size.y * (1.0 - 2.0 * self._device.paddle_size[1])
        front = 0.5 - self._device.paddle_size[0] if 2.0 * radius < narrow else 0.5
        at = self._place(world).then(StagePose(size.x * front + radius + _CLEAR))
        self._simulation.engine.place_body(
            self._body(thing), (at.x, at.y, at.yaw), np.array([world]), height=model.pose.z
        )
        self.carried[world], self._limit[world] = _NONE, 1.0

    def _rows(self, worlds: Worlds | None) -> slice | Worlds:
        some = chosen(worlds, len(self.paddles))
        return slice(None) if some is None else some

    def _body(self, thing: int) -> int:
        return len(self._simulation.robots) + thing

    def _edge(self, world: int) -> float:
        """Return the distance of the paddles' inner sides from the middle [m]."""
        width = self._model.size.y
        return float((1.0 - self.paddles[world]) * width * (0.5 - self._device.paddle_size[1]))

    def _place(self, world: int) -> StagePose:
        x, y, yaw = self._simulation.poses[world, self._robot.index].tolist()
        return StagePose(x, y, self._robot.model.pose.z, yaw).then(self._pose)

    def _met(self, world: int, line: Floats) -> int:
        """Return the object that a line in the gripper's frame crosses or ends in.

        -1 without one.
        """
        at = self._place(world)
        ends = [at.then(StagePose(x, y)) for x, y in line.tolist()]
        strip = np.array([(end.x, end.y) for end in ends])
        low = at.z + self.lift[world] * (1.0 - self._device.paddle_size[2]) * self._model.size.z
        high = low + self._device.paddle_size[2] * self._model.size.z
        fleet = self._simulation.fleet
        for thing, outlines in enumerate(self._outlines):
            body = self._body(thing)
            x, y, yaw = fleet.pose[world, body].tolist()
            moved = outlines.moved(StagePose(x, y, float(fleet.heights[world, body]), yaw))
            if _crosses(strip, moved, low, high):
                return thing
        return _NONE


def _crosses(strip: Floats, there: Outlines, low: float, high: float) -> bool:
    """Return whether a line meets outlines that exist at some height, or ends inside of them."""
    level = there.lines[(there.heights[:, 0] < high) & (there.heights[:, 1] > low)]
    if not len(level):
        return False
    if (gaps_to(strip, level) <= 0.0).any():
        return True
    x, y = strip[0]
    x0, y0, x1, y1 = level.T
    over = (y0 > y) != (y1 > y)
    with np.errstate(divide="ignore", invalid="ignore"):
        right = x < x0 + (y - y0) / (y1 - y0) * (x1 - x0)
    return bool(np.count_nonzero(over & right) % 2)


def grippers_of(simulation: StageBodies) -> dict[int, list[Gripper]]:
    """Return the grippers of each robot that has some, by its index."""
    found: dict[int, list[Gripper]] = {}
    for robot in simulation.robots:
        own = [
            Gripper(simulation, robot, placed.model, placed.pose)
            for placed in replace(robot.model, pose=StagePose()).walk()
            if placed.model.device_of(StageGripper)
        ]
        if own:
            found[robot.index] = own
    return found
