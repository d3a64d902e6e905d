"""The ROSbot goes to a place in TurtleBot's playground."""

from __future__ import annotations

import dataclasses
import math
from typing import Any, ClassVar

import numpy as np

from gazelle.array_types import Floats
from gazelle.drop_in.openai_ros.robot_envs.husarion_env import HusarionEnv
from gazelle.drop_in.openai_ros.task_envs.geometry import coordinates, euler_of, one
from gazelle.drop_in.openai_ros.task_envs.steering import SteeringTask
from gazelle.drop_in.openai_ros.task_envs.task_envs_list import register_task
from gazelle.envs.discrete_drive.rules import HUSARION, DriveRules, StepRewards
from gazelle.envs.discrete_drive.scoring import has_crashed
from gazelle.envs.goal_rules import distance_to, is_at, is_inside
from gazelle_ros.msgs import geometry_msgs

register_task("HusarionGetToPosTurtleBotPlayGround-v0")


class HusarionGetToPosTurtleBotPlayGroundEnv(SteeringTask, HusarionEnv):
    """Go to ``desired_pose``; parameters under ``/husarion``.

    Observation: samples of the scan [m], x, y [m], yaw [rad], and x and y of the goal, with one decimal.
    Actions: forward, left, right, and forward once more (openai_ros calls the last one backwards).
    A step lasts until the velocity is reached. Reward: 10 when nearer to the goal, 200 for the goal, -200
    for any other end. End: a sampled range at ``min_laser_value``, a place outside ``work_space``, or
    the goal within 1 / (10 ``precision``) m along x and along y.
    """

    space: ClassVar[str] = "husarion"
    published: ClassVar[DriveRules] = HUSARION
    place_at: ClassVar[slice | None] = slice(-5, -3)
    goal_axes: ClassVar[str] = "xy"

    def __init__(self) -> None:
        workspace = self._begin(
            "husarion/husarion_get_to_position_turtlebot_playground",
            "rosbot_gazebo",
            "start_world_maze.launch",
        )
        self._read_steering()
        super().__init__(workspace)
        scan = self.discretize_scan_observation(self.laser_scan, self.new_ranges)
        x = (self.work_space_x_min, self.work_space_x_max)
        y = (self.work_space_y_min, self.work_space_y_max)
        self.observation_space = self._space(scan, x, y, (-math.pi, math.pi), x, y)

    def _read_steering(self) -> None:
        super()._read_steering()
        self.move_base_precision = self.number("move_base_precision")
        self.precision_epsilon = 1.0 / (10.0 * self.number("precision"))
        self.new_ranges = int(self.parameter("new_ranges"))
        self.work_space_x_min, self.work_space_x_max = self._edges("x")
        self.work_space_y_min, self.work_space_y_max = self._edges("y")
        self.closer_to_point_reward = self.number("closer_to_point_reward")
        self.alive_reward = self.number("alive_reward")

    @property
    def desired_position(self) -> geometry_msgs.msg.Point:
        """The goal, a ``geometry_msgs/Point`` [m]."""
        goal: geometry_msgs.msg.Point = self.desired_point
        return goal

    def _rules(self, goal: Floats | None = None) -> DriveRules:
        return dataclasses.replace(
            super()._rules(goal),
            tolerance=self.precision_epsilon,
            bounds=(
                self.work_space_x_min,
                self.work_space_x_max,
                self.work_space_y_min,
                self.work_space_y_max,
            ),
        )

    def _step_rewards(self) -> StepRewards:
        step = (self.alive_reward, self.closer_to_point_reward)
        return (step, step)

    def _place_and_goal(self, observations: Any) -> tuple[Floats, Floats | None]:
        # The goal counts as it is observed.
        return super()._place_and_goal(observations)[0], np.array([*observations[-2:], 0.0])

    def _drive(self, linear: float, angular: float) -> None:
        self.move_base(linear, angular, epsilon=self.move_base_precision, update_rate=10)

    def _get_obs(self) -> list[float]:
        scan = self.discretize_scan_observation(self.laser_scan, self.new_ranges)
        pose, goal = self.odom.pose.pose, self.desired_point
        yaw = euler_of(pose.orientation)[2]
        rest = (pose.position.x, pose.position.y, yaw, goal.x, goal.y)
        return [*scan, *(round(each, 1) for each in rest)]

    def _is_done(self, observations: Any) -> bool:
        self._episode_done = self.check_husarion_has_crashed(observations[:-5])
        return super()._is_done(observations)

    def update_desired_pos(self, new_position: geometry_msgs.msg.Point) -> None:
        """Set another goal."""
        self.desired_point.x, self.desired_point.y = new_position.x, new_position.y

    def check_husarion_has_crashed(self, laser_readings: Any) -> bool:
        """Return whether a sample is as near as can be."""
        seen = one(laser_readings)
        return bool(has_crashed(self._rules(), seen, seen)[0])

    def check_inside_workspace(self, current_position: geometry_msgs.msg.Point) -> bool:
        """Return whether a place is where the robot may be; the upper edges belong to it."""
        low = (self.work_space_x_min, self.work_space_y_min)
        high = (self.work_space_x_max, self.work_space_y_max)
        return bool(is_inside(coordinates(current_position)[:, :2], low, high)[0])

    def check_reached_desired_position(
        self,
        current_position: geometry_msgs.msg.Point,
        desired_position: geometry_msgs.msg.Point,
        epsilon: float = 0.1,
    ) -> bool:
        """Return whether a place is the goal."""
        return bool(
            is_at(coordinates(current_position), coordinates(desired_position)[0], epsilon)[0]
        )

    def get_distance_from_desired_point(  # type: ignore[override]  # openai_ros' interface
        self, current_position: geometry_msgs.msg.Point, desired_position: geometry_msgs.msg.Point
    ) -> float:
        """Return how far two places are from each other [m]."""
        goal = coordinates(desired_position)[0]
        return float(distance_to(coordinates(current_position), goal)[0])
