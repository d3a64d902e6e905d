"""The ROSbot goes to a place in TurtleBot's playground."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from gazelle.compat.gym.spaces import Box
from gazelle.compat.openai_ros.robot_envs.husarion_env import HusarionEnv
from gazelle.compat.openai_ros.task_envs.geometry import (
    distance,
    euler_of,
    is_at,
    point,
    samples,
    step_between,
)
from gazelle.compat.openai_ros.task_envs.steering import SteeringTask
from gazelle.compat.openai_ros.task_envs.task_commons import begin_task
from gazelle.compat.openai_ros.task_envs.task_envs_list import register_task

register_task("HusarionGetToPosTurtleBotPlayGround-v0")


class HusarionGetToPosTurtleBotPlayGroundEnv(SteeringTask, HusarionEnv):
    """Go to ``desired_pose``; parameters under ``/husarion``.

    Observation: samples of the scan [m], x, y [m], yaw [rad], and x and y of the goal, with one decimal.
    Actions: forward, left, right, and forward once more (openai_ros calls the last one backwards).
    A step lasts until the velocity is reached. Reward: 10 when nearer to the goal, 200 for the goal, -200
    for any other end. End: a sampled range at ``min_laser_value``, a place outside ``work_space``, or
    the goal within 1 / (10 ``precision``) m along x and along y.
    """

    def __init__(self) -> None:
        workspace = begin_task(
            "husarion",
            "husarion",
            "husarion_get_to_position_turtlebot_playground.yaml",
            "rosbot_gazebo",
            "start_world_maze.launch",
        )
        self._read_steering("husarion")
        self.move_base_precision = float(self.parameter("move_base_precision"))
        self.precision_epsilon = 1.0 / (10.0 * float(self.parameter("precision")))
        self.new_ranges = int(self.parameter("new_ranges"))
        self.max_laser_value = float(self.parameter("max_laser_value"))
        self.min_laser_value = float(self.parameter("min_laser_value"))
        space = {each: float(self.parameter(f"work_space/{each}")) for each in _EDGES}
        self.work_space_x_min, self.work_space_x_max = space["x_min"], space["x_max"]
        self.work_space_y_min, self.work_space_y_max = space["y_min"], space["y_max"]
        self.closer_to_point_reward = self.parameter("closer_to_point_reward")
        self.alive_reward = self.parameter("alive_reward")
        self.end_episode_points = self.parameter("end_episode_points")
        self.desired_position = point(*(self.parameter(f"desired_pose/{axis}") for axis in "xy"))
        self.previous_distance_from_des_point = 0.0
        super().__init__(workspace)
        count = len(self.discretize_scan_observation(self.laser_scan, self.new_ranges))
        least = [self.work_space_x_min, self.work_space_y_min]
        most = [self.work_space_x_max, self.work_space_y_max]
        self.observation_space = Box(
            np.array([self.min_laser_value] * count + [*least, -math.pi, *least], np.float32),
            np.array([self.max_laser_value] * count + [*most, math.pi, *most], np.float32),
        )

    def _drive(self, linear: float, angular: float) -> None:
        self.move_base(linear, angular, epsilon=self.move_base_precision, update_rate=10)

    def _set_init_pose(self) -> bool:
        self._drive(self.init_linear_forward_speed, self.init_linear_turn_speed)
        return True

    def _init_env_variables(self) -> None:
        super()._init_env_variables()
        self.previous_distance_from_des_point = self.get_distance_from_desired_point(
            self.odom.pose.pose.position, self.desired_position
        )

    def _get_obs(self) -> list[float]:
        scan = self.discretize_scan_observation(self.laser_scan, self.new_ranges)
        pose, goal = self.odom.pose.pose, self.desired_position
        yaw = euler_of(pose.orientation)[2]
        rest = (pose.position.x, pose.position.y, yaw, goal.x, goal.y)
        return [*scan, *(round(each, 1) for each in rest)]

    def _is_done(self, observations: Any) -> bool:
        place, goal = point(*observations[-5:-3]), point(*observations[-2:])
        return (
            self.check_husarion_has_crashed(observations[:-5])
            or not self.check_inside_workspace(place)
            or self.check_reached_desired_position(place, goal, self.precision_epsilon)
        )

    def _compute_reward(self, observations: Any, done: bool) -> float:  # noqa: FBT001  # openai_ros' interface
        place, goal = point(*observations[-5:-3]), point(*observations[-2:])
        left = self.get_distance_from_desired_point(place, goal)
        nearer = left < self.previous_distance_from_des_point
        self.previous_distance_from_des_point = left
        if not done:
            return self._count(float(self.closer_to_point_reward if nearer else self.alive_reward))
        reached = self.check_reached_desired_position(place, goal, self.precision_epsilon)
        return self._count(float(self.end_episode_points if reached else -self.end_episode_points))

    def update_desired_pos(self, new_position: Any) -> None:
        """Take another goal."""
        self.desired_position.x, self.desired_position.y = new_position.x, new_position.y

    def discretize_scan_observation(self, data: Any, new_ranges: int) -> list[float]:
        """Samples of a ``sensor_msgs/LaserScan`` [m], kept within the bounds, with one decimal."""
        low, high = self.min_laser_value, self.max_laser_value
        return samples(
            data.ranges,
            step_between(len(data.ranges), new_ranges),
            nearest=low,
            farthest=high,
            convert=lambda each: round(min(max(each, low), high), 1),
        )

    def check_husarion_has_crashed(self, laser_readings: Any) -> bool:
        """Return whether a sample is at the smallest range."""
        return any(each == self.min_laser_value for each in laser_readings)

    def check_inside_workspace(self, current_position: Any) -> bool:
        """Return whether a position is in the work space; the upper edges belong to it."""
        return bool(
            self.work_space_x_min < current_position.x <= self.work_space_x_max
            and self.work_space_y_min < current_position.y <= self.work_space_y_max
        )

    def check_reached_desired_position(
        self, current_position: Any, desired_position: Any, epsilon: float = 0.1
    ) -> bool:
        """Return whether a position is the goal."""
        return is_at(current_position, desired_position, epsilon)

    def get_distance_from_desired_point(
        self, current_position: Any, desired_position: Any
    ) -> float:
        """Between two places [m]."""
        return distance(current_position, desired_position)


_EDGES = ("x_min", "x_max", "y_min", "y_max")
