"""Tasks in which a robot goes forward or turns, by the rules of `gazelle.envs.discrete_drive`."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats
from gazelle.drop_in.gym.spaces import Box
from gazelle.drop_in.openai_ros.robot_envs.wheeled_robot_env import WheeledRobotEnv
from gazelle.drop_in.openai_ros.task_envs.geometry import coordinates, one, point
from gazelle.drop_in.openai_ros.task_envs.places import DesiredPoint
from gazelle.envs.discrete_drive.rules import DriveRules, StepRewards
from gazelle.envs.discrete_drive.scoring import ends_of, has_crashed, observed, reward_of
from gazelle.envs.goal_rules import distance_to
from gazelle_ros.compat import rospy
from gazelle_ros.msgs import sensor_msgs

FORWARDS, TURN_LEFT, TURN_RIGHT = "FORWARDS", "TURN_LEFT", "TURN_RIGHT"


class SteeringTask(DesiredPoint, WheeledRobotEnv):
    """Action 0 goes forward, 1 turns to the left, 2 to the right.

    Attributes:
        published: The task's rules; the parameters replace their figures.
        place_at: Indices of x and y in an observation; None in a task without a goal.
        goal_axes: Axes that the parameter ``desired_pose`` has.
        last_action: ``FORWARDS``, ``TURN_LEFT`` or ``TURN_RIGHT``.
    """

    published: ClassVar[DriveRules]
    place_at: ClassVar[slice | None] = None
    goal_axes: ClassVar[str] = "xyz"
    odom: Any
    laser_scan: Any
    min_range: float | None = None

    def _read_steering(self) -> None:
        """Read the common parameters of these tasks, and the goal if there is one."""
        self.linear_forward_speed = self.number("linear_forward_speed")
        self.linear_turn_speed = self.number("linear_turn_speed")
        self.angular_speed = self.number("angular_speed")
        self.init_linear_forward_speed = self.number("init_linear_forward_speed")
        self.init_linear_turn_speed = self.number("init_linear_turn_speed")
        self.max_laser_value = self.parameter("max_laser_value")
        self.min_laser_value = self.parameter("min_laser_value")
        if self.published.crash_range is not None:
            self.min_range = self.number("min_range")
        self.end_episode_points = self.number("end_episode_points")
        if self.place_at is not None:
            self.desired_point = point(
                *(self.number(f"desired_pose/{axis}") for axis in self.goal_axes)
            )
        self.last_action = FORWARDS
        self._episode_done = False

    def _read_motion_rewards(self) -> None:
        """Read the rewards of a step forward and a turn."""
        self.forwards_reward = self.number("forwards_reward")
        self.turn_reward = self.number("turn_reward")

    # -- the rules -----------------------------------------------------------------------------

    def _rules(self, goal: Floats | None = None) -> DriveRules:
        """Return the task's rules with its parameters, and a goal [m], shape (3,)."""
        return dataclasses.replace(
            self.published,
            far=self.max_laser_value,
            least=self.min_laser_value,
            crash_range=self.min_range,
            rewards=self._step_rewards(),
            end_reward=self.end_episode_points,
            goal=None if goal is None else (goal[0], goal[1]),
        )

    def _step_rewards(self) -> StepRewards:
        """Return the rewards of steps."""
        forward, turn = self.forwards_reward, self.turn_reward
        return ((forward, forward), (turn, turn))

    def _place_and_goal(self, observations: Any) -> tuple[Floats, Floats | None]:
        """Return where the robot is as observed, shape (1, 2), and its goal, shape (3,) [m]."""
        if self.place_at is None:
            return np.zeros((1, 2)), None
        return one(observations[self.place_at]), self._goal()

    def _is_done(self, observations: Any) -> bool:
        if self._episode_done:
            rospy.logwarn("the robot is too near to something")
        place, goal = self._place_and_goal(observations)
        ends = ends_of(self._rules(goal), one(self._episode_done), place)
        self._episode_done = bool(ends.over[0])
        return self._episode_done

    def _compute_reward(self, observations: Any, done: bool) -> float:  # noqa: FBT001  # openai_ros' interface
        place, goal = self._place_and_goal(observations)
        rules, closer = self._rules(goal), one(False)
        if goal is not None:
            closer = self._comes_nearer(float(distance_to(place, goal)[0]))
        reward = reward_of(
            rules,
            over=one(done),
            reached=ends_of(rules, one(done), place).reached,
            forward=one(self.last_action == FORWARDS),
            closer=closer,
        )
        return self._count(reward)

    # -- what a robot does and observes --------------------------------------------------------

    def _set_init_pose(self) -> bool:
        """Command the velocity of the beginning."""
        self._drive(self.init_linear_forward_speed, self.init_linear_turn_speed)
        return True

    def _init_env_variables(self) -> None:
        """Initialise an episode's reward and its distance to the goal."""
        self.cumulated_reward = 0.0
        self._episode_done = False
        if self.place_at is not None:
            place = coordinates(self.odom.pose.pose.position)
            self.previous_distance_from_des_point = float(distance_to(place, self._goal())[0])

    def _set_action(self, action: Any) -> None:
        """Drive or turn; other actions repeat the last command's name and go forward."""
        speeds = {
            0: (FORWARDS, self.linear_forward_speed, 0.0),
            1: (TURN_LEFT, self.linear_turn_speed, self.angular_speed),
            2: (TURN_RIGHT, self.linear_turn_speed, -self.angular_speed),
        }
        self.last_action, linear, angular = speeds.get(int(action), speeds[0])
        self._drive(linear, angular)

    def _drive(self, linear: float, angular: float) -> None:
        self.move_base(linear, angular, epsilon=0.05, update_rate=10)

    def _observe(
        self, rules: DriveRules, ranges: Sequence[float] | NDArray[Any], step: int
    ) -> list[float]:
        """Return ranges 0, ``step``, ... as observed [m]; one that is too near ends the episode."""
        taken = one(ranges[::step]).astype(np.float64)
        seen = observed(rules, taken)
        self._episode_done = bool(has_crashed(rules, taken, seen)[0])
        # Whole metres are ints: scripts make the keys of their tables of what they print as.
        whole = rules.decimals is None
        return [int(each) if whole and each.is_integer() else each for each in seen[0].tolist()]

    def discretize_scan_observation(
        self, data: sensor_msgs.msg.LaserScan, new_ranges: int
    ) -> list[float]:
        """Return about ``new_ranges`` ranges of a ``sensor_msgs/LaserScan`` [m]; see `_observe`."""
        # As Python 2 divides ints, for which openai_ros was written.
        return self._observe(self._rules(), data.ranges, max(1, len(data.ranges) // new_ranges))

    def _space(self, scan: Sequence[float], *rest: tuple[float, float]) -> Box:
        """Return the space of observations: those of a scan, then numbers by their bounds."""
        bounds = [(self.min_laser_value, self.max_laser_value)] * len(scan) + list(rest)
        low, high = zip(*bounds, strict=True)
        return Box(np.array(low, np.float32), np.array(high, np.float32))
