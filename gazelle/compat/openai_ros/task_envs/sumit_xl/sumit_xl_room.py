"""Summit XL goes to a place in a room."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from gazelle.compat.gym.spaces import Box
from gazelle.compat.openai_ros.robot_envs.sumitxl_env import SumitXlEnv
from gazelle.compat.openai_ros.task_envs.geometry import euler_of, magnitude, point
from gazelle.compat.openai_ros.task_envs.places import PlaceTask
from gazelle.compat.openai_ros.task_envs.task_commons import begin_task
from gazelle.compat.openai_ros.task_envs.task_envs_list import register_task

register_task("SumitXlRoom-v0")


class SumitXlRoom(PlaceTask, SumitXlEnv):
    """Go to ``desired_pose``; parameters under ``/sumit_xl``.

    Observation: samples of the scan in whole metres, then x, y [m] and yaw [rad] with two decimals.
    Actions: see `SteeringTask`. Reward: 10 when nearer to the goal, else 1; 200 for the goal, -200 for
    any other end. End: a sampled range below 0.5 m, an acceleration above ``max_linear_aceleration``,
    x or y beyond ``max_distance``, or the goal within 0.05 m along x and along y.
    """

    def __init__(self) -> None:
        workspace = begin_task(
            "sumit_xl", "sumit_xl", "sumit_xl_room.yaml", "summit_xl_gazebo", "start_world.launch"
        )
        super().__init__(workspace)
        self._read_steering("sumit_xl")
        self.new_ranges = int(self.parameter("new_ranges"))
        self._read_laser()
        self.max_linear_aceleration = float(self.parameter("max_linear_aceleration"))
        self.max_distance = float(self.parameter("max_distance"))
        self.closer_to_point_reward = self.parameter("closer_to_point_reward")
        self.not_ending_point_reward = self.parameter("not_ending_point_reward")
        self.end_episode_points = self.parameter("end_episode_points")
        self._read_place()
        count = len(self.discretize_scan_observation(self.laser_scan, self.new_ranges))
        place = [self.max_distance, self.max_distance, math.pi]
        self.observation_space = Box(
            np.array([self.min_laser_value] * count + [-each for each in place], np.float32),
            np.array([self.max_laser_value] * count + place, np.float32),
        )

    def _get_obs(self) -> list[float]:
        scan = self.discretize_scan_observation(self.laser_scan, self.new_ranges)
        pose = self.odom.pose.pose
        yaw = euler_of(pose.orientation)[2]
        return [*scan, round(pose.position.x, 2), round(pose.position.y, 2), round(yaw, 2)]

    def _is_done(self, observations: Any) -> bool:
        place = point(*observations[-3:-1])
        hit = magnitude(self.imu.linear_acceleration) > self.max_linear_aceleration
        outside = max(abs(place.x), abs(place.y)) > self.max_distance
        if hit or outside or self.is_in_desired_position(place):
            self._episode_done = True
        return self._episode_done

    def _compute_reward(self, observations: Any, done: bool) -> float:  # noqa: FBT001  # openai_ros' interface
        place = point(*observations[-3:-1])
        nearer = self._comes_nearer(place)
        if not done:
            return self._count(
                float(self.closer_to_point_reward if nearer else self.not_ending_point_reward)
            )
        reached = self.is_in_desired_position(place)
        return self._count(float(self.end_episode_points if reached else -self.end_episode_points))

    def discretize_scan_observation(self, data: Any, new_ranges: int) -> list[float]:
        """Samples of a ``sensor_msgs/LaserScan`` [m]; notes whether one is too near."""
        return self._metres_seen(data, new_ranges)
