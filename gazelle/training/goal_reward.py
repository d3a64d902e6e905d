"""A reward for the learner alone, from a task's information on goals.

The reward that a task publishes is what reports and evaluations show. It need not be what a policy
is best taught with: the published one of the TurtleBot3, say, pays more for a well-aimed turn far from the
goal than near it, and for driving on more than for arriving.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from gazelle.argument_checks import checked
from gazelle.array_types import Bools, Floats
from gazelle.errors import TaskError
from gazelle.training.state_arrays import saved_array


@checked(TaskError)
@dataclass(frozen=True, kw_only=True)
class GoalReward:
    """Weights of the reward that the learner gets in place of the task's reward, or beside it."""

    goal: float = 1.0
    """For a goal that is reached (``is_success``)."""
    collision: float = 1.0
    """Taken for a collision (``is_collision``)."""
    progress: float = 1.0
    """For each metre that the robot comes nearer to its goal (``distance`` [m])."""
    waypoint: float = 0.0
    """For each point on the way to the goal (``waypoints``, if the task counts them):
    ``distance`` is to the next one."""
    other_end: float = 0.0
    """Taken where the task ends an episode otherwise, such as out of its work space."""
    own: float = 0.0
    """Factor of the task's own reward, which is added."""


class GoalRewards:
    """Works out `GoalReward` step by step.

    Args:
        pay: Reward terms.
        copies: Of the environment, N.

    Attributes:
        pay: Reward terms.
        distance: To the goal that is under way [m], NaN where not known yet, shape (N,).
        waypoints: Number of points passed on the way to it, shape (N,).
    """

    def __init__(self, pay: GoalReward, copies: int) -> None:
        self.pay = pay
        self.distance: Floats = np.full(copies, np.nan)
        self.waypoints: Floats = np.zeros(copies)

    def begin(self, info: dict[str, Any], where: Bools) -> None:
        """Start episodes in some copies, with their first info."""
        self.distance = np.where(where, _info_values(info, "distance"), self.distance)
        self.waypoints[where] = 0.0

    def of_step(
        self,
        info: dict[str, Any],
        last: dict[str, Any] | None,
        slots: npt.NDArray[np.intp],
        terminated: Bools,
        valid: Bools,
    ) -> Floats:
        """Return the reward of a step, shape (N,).

        Args:
            info: Of the step.
            last: Last info of the ended episodes, if not in ``info``.
            slots: Copies with an ended episode.
            terminated: Mask of terminated episodes, shape (N,).
            valid: False where the step was spent on a reset, shape (N,).

        Raises:
            TaskError: The task does not report what is needed.
        """
        success, collision, now = (
            _merged(info, last, slots, name) for name in ("is_success", "is_collision", "distance")
        )
        nearer = self.distance - now
        nearer[np.isnan(nearer)] = 0.0
        pay = self.pay
        reward = pay.goal * success - pay.collision * collision + pay.progress * nearer
        reward -= pay.other_end * (terminated & (success == 0.0) & (collision == 0.0))
        passed = np.zeros_like(success)
        if "waypoints" in info:
            passed = _merged(info, last, slots, "waypoints") - self.waypoints
            self.waypoints += passed
            reward += pay.waypoint * passed
        # After a goal or a point another one is under way, with its distance in the next step.
        self.distance = np.where((success + passed) > 0.0, np.nan, now)
        result: Floats = np.where(valid, reward, 0.0)
        return result

    def get_state(self) -> dict[str, Floats]:
        """Return the state that a resumed training continues from."""
        return {"distance": self.distance, "waypoints": self.waypoints}

    def set_state(self, state: Mapping[str, Any]) -> None:
        """Restore a state that `get_state` returned; earlier ones have no points."""
        self.distance = saved_array(state, "distance", self.distance)
        whole = {"waypoints": self.waypoints, **state}
        self.waypoints = saved_array(whole, "waypoints", self.waypoints)


def _merged(
    info: dict[str, Any],
    last: dict[str, Any] | None,
    slots: npt.NDArray[np.intp],
    name: str,
) -> Floats:
    """Return a number of each copy at the end of the step, before any reset."""
    values = _info_values(info, name)
    if last is not None and len(slots):
        values[slots] = _info_values(last, name)[slots]
    return values


def _info_values(info: dict[str, Any], name: str) -> Floats:
    if name not in info:
        raise TaskError(
            f"a goal_reward needs info['{name}'], which this task does not report",
            hint="leave goal_reward out of the recipe",
        )
    return np.array(info[name], dtype=np.float64)
