"""TurtleBot3 wanders among the pillars of its world."""

from __future__ import annotations

from typing import Any

import numpy as np

from gazelle.compat.gym.spaces import Box
from gazelle.compat.openai_ros.robot_envs.turtlebot3_env import TurtleBot3Env
from gazelle.compat.openai_ros.task_envs.geometry import magnitude
from gazelle.compat.openai_ros.task_envs.steering import SteeringTask
from gazelle.compat.openai_ros.task_envs.task_commons import begin_task
from gazelle.compat.openai_ros.task_envs.task_envs_list import register_task
from gazelle.ros.compat import rospy

register_task("TurtleBot3World-v0")


class TurtleBot3WorldEnv(SteeringTask, TurtleBot3Env):
    """Go without touching anything; parameters under ``/turtlebot3``.

    Observation: every ``round(n / new_ranges)``-th of the n ranges, cut to whole metres; 6 for no return.
    Actions: see `SteeringTask`. Reward: 5 forward, 1 for a turn, -200 for the end. End: a sampled range
    below 0.2 m, or an acceleration above ``max_linear_aceleration`` (the IMU of this robot shows gravity).
    """

    def __init__(self) -> None:
        workspace = begin_task(
            "turtlebot3",
            "turtlebot3",
            "turtlebot3_world.yaml",
            "turtlebot3_gazebo",
            "start_world.launch",
        )
        super().__init__(workspace)
        self._read_steering("turtlebot3")
        self.new_ranges = int(self.parameter("new_ranges"))
        self._read_laser()
        self.max_linear_aceleration = float(self.parameter("max_linear_aceleration"))
        self.forwards_reward = self.parameter("forwards_reward")
        self.turn_reward = self.parameter("turn_reward")
        self.end_episode_points = self.parameter("end_episode_points")
        count = len(self.discretize_scan_observation(self.laser_scan, self.new_ranges))
        self.observation_space = Box(
            np.full(count, self.min_laser_value, np.float32),
            np.full(count, self.max_laser_value, np.float32),
        )

    def _get_obs(self) -> list[float]:
        return self.discretize_scan_observation(self.laser_scan, self.new_ranges)

    def _is_done(self, observations: Any) -> bool:
        del observations
        if self._episode_done:
            rospy.logwarn("the robot is too near to something")
        if self.get_vector_magnitude(self.imu.linear_acceleration) > self.max_linear_aceleration:
            rospy.logwarn("the robot has hit something")
            self._episode_done = True
        return self._episode_done

    def _compute_reward(self, observations: Any, done: bool) -> float:  # noqa: FBT001  # openai_ros' interface
        del observations
        return self._count(self._way_reward(done))

    def discretize_scan_observation(self, data: Any, new_ranges: int) -> list[float]:
        """Samples of a ``sensor_msgs/LaserScan`` [m]; notes whether one is too near."""
        return self._metres_seen(data, new_ranges)

    def get_vector_magnitude(self, vector: Any) -> float:
        """Length of a vector."""
        return magnitude(vector)
