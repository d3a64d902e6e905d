"""A lift: what ``libgazebo_ros_elevator.so`` and ``libElevatorPlugin.so`` do."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Worlds
from gazelle.description import Parameters
from gazelle.errors import SimulationError
from gazelle.plugins.pid import Gains, GazeboPid
from gazelle.simulation import Input, ModelPlugin, Robot, Stopwatch, absolute, namespace_of
from gazelle.states import restore_all, states_of

_LIFT = Gains(100000.0, 0.0, 100000.0)
_DOOR = Gains(2.0, 0.0, 1.0)
# How far the door opens, and when lift and door count as there [m].
_OPEN = 1.0
_LIFT_TOLERANCE, _DOOR_TOLERANCE = 0.15, 0.05

_IDLE, _CLOSING, _LIFTING, _OPENING, _WAITING, _SHUTTING = range(6)


class Elevator(ModelPlugin):
    """Goes to the floor it is called to: closes the door, lifts, opens, waits, closes.

    Commands while it is busy are lost.
    """

    update_rate = 0.0

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, find the joints, open the topic."""
        self._robot, self._clock = robot, robot.simulation.clock
        self._lift = robot.joints[_own(parameters.require("lift_joint", str))]
        self._door = robot.joints[_own(parameters.require("door_joint", str))]
        self._height = parameters.get("floor_height", 3.0)
        if not self._height > 0.0:
            raise SimulationError("floor_height must be positive", source=parameters.source)
        self._wait = parameters.get("door_wait_time", 5.0)
        nworld = robot.simulation.nworld
        self._phase = np.full(nworld, _IDLE)
        self._floor = np.zeros(nworld)
        self._until = np.zeros(nworld)
        self._pids = {"lift": GazeboPid(_LIFT, nworld), "door": GazeboPid(_DOOR, nworld)}
        self._watch = Stopwatch(robot.simulation.clock)
        # Gazebo's own topic begins with ~, which stands for the world there.
        topic = parameters.get("topic", "elevator").removeprefix("~/")
        robot.inputs["elevator"] = Input(
            absolute(namespace_of(robot, parameters), topic), str, self._call
        )

    def _call(self, text: str, worlds: Worlds | None) -> None:
        """Call the elevator to a floor.

        Raises:
            SimulationError: The text is not a number.
        """
        try:
            floor = int(text)
        except ValueError:
            raise SimulationError(f"a lift goes to a floor by number, not to '{text}'") from None
        chosen = np.zeros(len(self._phase), np.bool_)
        chosen[slice(None) if worlds is None else worlds] = True
        chosen &= self._phase == _IDLE
        self._floor[chosen], self._phase[chosen] = floor, _CLOSING

    def on_update(self, time: float) -> None:
        """Apply forces to lift and door towards their targets."""
        interval = self._watch.lap()
        lift = self._lift.positions()[:, 0] - self._floor * self._height
        opened = (self._phase == _OPENING) | (self._phase == _WAITING)
        door = self._door.positions()[:, 0] - _OPEN * opened
        self._lift.effort = self._pids["lift"].update(lift, interval)
        self._door.effort = self._pids["door"].update(door, interval)
        there = {
            _CLOSING: np.abs(door) < _DOOR_TOLERANCE,
            _LIFTING: np.abs(lift) < _LIFT_TOLERANCE,
            _OPENING: np.abs(door) < _DOOR_TOLERANCE,
            _WAITING: time >= self._until,
            _SHUTTING: np.abs(door) < _DOOR_TOLERANCE,
        }
        phase = self._phase.copy()
        for current, done in there.items():
            following = (current + 1) % len((_IDLE, *there))
            moving = (phase == current) & done
            self._phase[moving] = following
            if following == _WAITING:
                self._until[moving] = time + self._wait

    def reset(self, worlds: Worlds | None) -> None:
        """Wait on the ground floor."""
        rows = slice(None) if worlds is None else worlds
        self._phase[rows], self._floor[rows], self._until[rows] = _IDLE, 0.0, 0.0
        for pid in self._pids.values():
            pid.reset(worlds)
        if worlds is None:
            self._watch.restart()

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return its target floor, phase and controllers."""
        return {
            **states_of(self._pids),
            "phase": self._phase.copy(),
            "floor": self._floor.copy(),
            "until": self._until.copy(),
            "time": np.array(self._watch.start_ns),
        }

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        restore_all(self._pids, state)
        self._phase[:], self._floor[:] = state["phase"], state["floor"]
        self._until[:] = state["until"]
        self._watch.start_ns = int(np.asarray(state["time"]))


def _own(name: str) -> str:
    """Return a joint's name without its model's."""
    return name.rpartition("::")[2]
