"""Tasks in which a robot goes forward or turns."""

from __future__ import annotations

from typing import Any

import numpy as np

from gazelle.compat.gym.spaces import Discrete
from gazelle.compat.openai_ros.robot_envs.wheeled_robot_env import WheeledRobotEnv
from gazelle.compat.openai_ros.task_envs.geometry import samples, step_between, too_near
from gazelle.ros.compat import rospy

FORWARDS, TURN_LEFT, TURN_RIGHT = "FORWARDS", "TURN_LEFT", "TURN_RIGHT"


class SteeringTask(WheeledRobotEnv):
    """Action 0 goes forward, 1 turns to the left, 2 to the right.

    Attributes:
        last_action: ``FORWARDS``, ``TURN_LEFT`` or ``TURN_RIGHT``.
        cumulated_reward: Of the episode.
        cumulated_steps: Of all episodes.
    """

    def _read_steering(self, space: str) -> None:
        """Take the parameters of a namespace."""
        self._parameters = space
        self.action_space = Discrete(int(self.parameter("n_actions")))
        self.reward_range = (-np.inf, np.inf)
        self.linear_forward_speed = float(self.parameter("linear_forward_speed"))
        self.linear_turn_speed = float(self.parameter("linear_turn_speed"))
        self.angular_speed = float(self.parameter("angular_speed"))
        self.init_linear_forward_speed = float(self.parameter("init_linear_forward_speed"))
        self.init_linear_turn_speed = float(self.parameter("init_linear_turn_speed"))
        self.last_action = FORWARDS
        self.cumulated_reward = 0.0
        self.cumulated_steps = 0.0
        self._episode_done = False

    def _read_laser(self) -> None:
        """Take what bounds ranges from the parameters [m]."""
        self.min_range = float(self.parameter("min_range"))
        self.max_laser_value = self.parameter("max_laser_value")
        self.min_laser_value = self.parameter("min_laser_value")

    def _metres_seen(self, scan: Any, count: int) -> list[float]:
        """About so many ranges of a ``sensor_msgs/LaserScan``, cut to whole metres.

        One below ``min_range`` ends the episode.
        """
        step = step_between(len(scan.ranges), count)
        self._episode_done = too_near(scan.ranges, step, self.min_range)
        return samples(
            scan.ranges,
            step,
            nearest=self.min_laser_value,
            farthest=self.max_laser_value,
            convert=int,
        )

    def parameter(self, name: str) -> Any:
        """A parameter of the task.

        Raises:
            KeyError: It is not set.
        """
        return rospy.get_param(f"/{self._parameters}/{name}")

    def _set_init_pose(self) -> bool:
        """Command the velocity of the beginning."""
        self.move_base(
            self.init_linear_forward_speed,
            self.init_linear_turn_speed,
            epsilon=0.05,
            update_rate=10,
        )
        return True

    def _init_env_variables(self) -> None:
        """Begin an episode's reward."""
        self.cumulated_reward = 0.0
        self._episode_done = False

    def _set_action(self, action: Any) -> None:
        """Go, or turn; other actions repeat the last command's name and go forward."""
        speeds = {
            0: (FORWARDS, self.linear_forward_speed, 0.0),
            1: (TURN_LEFT, self.linear_turn_speed, self.angular_speed),
            2: (TURN_RIGHT, self.linear_turn_speed, -self.angular_speed),
        }
        self.last_action, linear, angular = speeds.get(int(action), speeds[0])
        self._drive(linear, angular)

    def _drive(self, linear: float, angular: float) -> None:
        self.move_base(linear, angular, epsilon=0.05, update_rate=10)

    def _count(self, reward: float) -> float:
        """Add a reward to those of the episode; returns it."""
        self.cumulated_reward += reward
        self.cumulated_steps += 1
        return reward

    def _way_reward(self, done: bool) -> float:  # noqa: FBT001  # openai_ros' interface
        """Return the reward of going forward, of turning, or of the end."""
        if done:
            return -float(self.parameter("end_episode_points"))
        name = "forwards_reward" if self.last_action == FORWARDS else "turn_reward"
        return float(self.parameter(name))
