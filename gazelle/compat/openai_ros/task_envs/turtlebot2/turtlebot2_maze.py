"""TurtleBot2 wanders in a maze."""

from __future__ import annotations

import functools
import math
from typing import Any

import numpy as np

from gazelle.compat.gym.spaces import Box
from gazelle.compat.openai_ros.robot_envs.turtlebot2_env import TurtleBot2Env
from gazelle.compat.openai_ros.task_envs.geometry import samples, too_near
from gazelle.compat.openai_ros.task_envs.steering import SteeringTask
from gazelle.compat.openai_ros.task_envs.task_commons import begin_task
from gazelle.compat.openai_ros.task_envs.task_envs_list import register_task
from gazelle.ros.compat import rospy

register_task("MyTurtleBot2Maze-v0", "TurtleBot2Maze-v0")


class TurtleBot2MazeEnv(SteeringTask, TurtleBot2Env):
    """Go without touching a wall; parameters under ``/turtlebot2``.

    Observation: ``n_observations`` ranges of the scan, rounded to ``number_decimals_precision_obs``; the
    scan's largest for no return. Actions: see `SteeringTask`. Reward: 5 forward, 1 for a turn, -200 for
    the end. End: a sampled range below 0.5 m.
    """

    def __init__(self) -> None:
        workspace = begin_task(
            "turtlebot2",
            "turtlebot2",
            "turtlebot2_maze.yaml",
            "turtlebot_gazebo",
            "start_world_maze_loop_brick.launch",
        )
        super().__init__(workspace)
        self._read_steering("turtlebot2")
        self.dec_obs = int(rospy.get_param("/turtlebot2/number_decimals_precision_obs", 1))
        self.n_observations = int(self.parameter("n_observations"))
        self._read_laser()
        self.forwards_reward = self.parameter("forwards_reward")
        self.turn_reward = self.parameter("turn_reward")
        self.end_episode_points = self.parameter("end_episode_points")
        self.new_ranges = math.ceil(len(self.laser_scan.ranges) / self.n_observations)
        count = len(self.discretize_observation(self.laser_scan, self.new_ranges))
        self.observation_space = Box(
            np.full(count, self.min_laser_value, np.float32),
            np.full(count, self.max_laser_value, np.float32),
        )

    def _get_obs(self) -> list[float]:
        return self.discretize_observation(self.laser_scan, self.new_ranges)

    def _is_done(self, observations: Any) -> bool:
        del observations
        if self._episode_done:
            rospy.logwarn("the robot is too near to a wall")
        return self._episode_done

    def _compute_reward(self, observations: Any, done: bool) -> float:  # noqa: FBT001  # openai_ros' interface
        del observations
        return self._count(self._way_reward(done))

    def discretize_observation(self, data: Any, new_ranges: int) -> list[float]:
        """Every so-manieth range of a ``sensor_msgs/LaserScan`` [m]; notes whether one is too near."""
        self._episode_done = too_near(data.ranges, new_ranges, self.min_range)
        return samples(
            data.ranges,
            new_ranges,
            nearest=round(data.range_min, self.dec_obs),
            farthest=round(data.range_max, self.dec_obs),
            convert=functools.partial(round, ndigits=self.dec_obs),
        )
