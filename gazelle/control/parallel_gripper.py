"""``ParallelGripperController``: a gripper of two fingers, each with a motor, as Fetch has it."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.control.goals import Goal, GoalState
from gazelle.control.gripper import GripperActionController
from gazelle.control.interfaces import EFFORT
from gazelle.control.parameters import ControllerParameters
from gazelle.control.values import GripperGoal

_STRENGTH = 60.0
_OPEN = 0.1
_SPEED = 0.1
_STIFFNESS = 5000.0
_CENTRING = 1000.0


class ParallelGripperController(GripperActionController):
    """Opens and closes two fingers by effort; positions are the whole opening [m].

    A goal moves a set point at ``max_speed``, which the fingers follow as springs do, with at most the
    goal's ``max_effort`` each; both are kept as far from the middle by the gains of ``centering``. What
    stalls the fingers is held from then on, and the goal has succeeded, ``stalled``.
    """

    action_name = "gripper_action"
    tolerance = 0.002
    stall_ends = GoalState.SUCCEEDED

    def init(self, parameters: ControllerParameters) -> None:
        """Read the joints' names, ``max_position``, ``max_effort``, ``max_speed`` and gains."""
        names = [
            parameters.text(f"{side}_gripper_joint", f"{side}_gripper_finger_joint")
            for side in "lr"
        ]
        self._joint = self.claim(EFFORT, names)
        self._pid = None
        self._widest = _positive(parameters, "max_position", _OPEN)
        self._quickest = _positive(parameters, "max_speed", _SPEED)
        self._stiffness = _positive(parameters, "stiffness", _STIFFNESS)
        self._centring = parameters.number("centering/p", _CENTRING)
        self._set_point: Floats = np.zeros(self.nworld)
        self._take_goals(parameters, _STRENGTH)

    def _begin_goal(self, goal: Goal[GripperGoal]) -> None:
        super()._begin_goal(goal)
        rows = goal.worlds
        self._position[rows] = np.clip(self._position[rows], 0.0, self._widest)
        # As on the robot: no effort, or more than it has, is all of it.
        effort = np.abs(self._max_effort[rows])
        fits = (effort > 0.0) & (effort <= self._strength)
        self._max_effort[rows] = np.where(fits, effort, self._strength)
        self._set_point[rows] = np.clip(
            self._set_point[rows], self._opening()[rows] - 0.01, self._opening()[rows] + 0.01
        )

    def _opening(self) -> Floats:
        opening: Floats = self._joint.position.sum(axis=1)
        return opening

    def _speed(self) -> Floats:
        speed: Floats = self._joint.velocity.sum(axis=1)
        return speed

    def _begin(self, rows: Worlds) -> None:
        self._hold(rows)
        self._set_point[rows] = self._position[rows]
        self._moved_ns[rows] = self.now_ns
        self._joint.set_command(0.0, None, rows)

    def _push(self, error: Floats, period: float) -> None:  # noqa: ARG002  of the set point
        step = self._quickest * period
        self._set_point += np.clip(self._position - self._set_point, -step, step)
        place, most = self._joint.position, self._max_effort[:, None]
        pushed = np.clip(self._stiffness * (0.5 * self._set_point[:, None] - place), -most, most)
        aside = self._centring * (place[:, :1] - place[:, 1:])
        self._output = np.abs(pushed).max(axis=1)
        self._joint.set_command(pushed + aside * [[-0.5, 0.5]])

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return the targets, and the set point."""
        return {**super().state(), "set_point": self._set_point.copy()}

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned; goals end."""
        super().restore(state)
        self._set_point[:] = state["set_point"]


def _positive(parameters: ControllerParameters, name: str, default: float) -> float:
    value = parameters.number(name, default)
    if not value > 0.0:
        raise parameters.wrong(name, "a number above zero", value)
    return value
