"""Summit XL goes to a place in a room."""

from __future__ import annotations

import dataclasses
import math
from typing import ClassVar

from gazelle.array_types import Floats
from gazelle.drop_in.openai_ros.robot_envs.sumitxl_env import SumitXlEnv
from gazelle.drop_in.openai_ros.task_envs.geometry import euler_of
from gazelle.drop_in.openai_ros.task_envs.jolts import ImuSteeringTask
from gazelle.drop_in.openai_ros.task_envs.task_envs_list import register_task
from gazelle.envs.discrete_drive.rules import SUMMIT_XL, DriveRules, StepRewards

register_task("SumitXlRoom-v0")


class SumitXlRoom(ImuSteeringTask, SumitXlEnv):
    """Go to ``desired_pose``; parameters under ``/sumit_xl``.

    Observation: samples of the scan in whole metres, then x, y [m] and yaw [rad] with two decimals.
    Actions: see `SteeringTask`. Reward: 10 when nearer to the goal, else 1; 200 for the goal, -200 for
    any other end. End: a sampled range below 0.5 m, an acceleration above ``max_linear_aceleration``,
    x or y beyond ``max_distance``, or the goal within 0.05 m along x and along y.
    """

    space: ClassVar[str] = "sumit_xl"
    published: ClassVar[DriveRules] = SUMMIT_XL
    place_at: ClassVar[slice | None] = slice(-3, -1)

    def __init__(self) -> None:
        workspace = self._begin("sumit_xl/sumit_xl_room", "summit_xl_gazebo")
        super().__init__(workspace)
        self._read_steering()
        self.new_ranges = int(self.parameter("new_ranges"))
        scan = self.discretize_scan_observation(self.laser_scan, self.new_ranges)
        side = (-self.max_distance, self.max_distance)
        self.observation_space = self._space(scan, side, side, (-math.pi, math.pi))

    def _read_steering(self) -> None:
        super()._read_steering()
        self.max_distance = self.number("max_distance")
        self.closer_to_point_reward = self.number("closer_to_point_reward")
        self.not_ending_point_reward = self.number("not_ending_point_reward")

    def _rules(self, goal: Floats | None = None) -> DriveRules:
        most = self.max_distance
        least = math.nextafter(-most, -math.inf)  # both edges belong to this work space
        return dataclasses.replace(super()._rules(goal), bounds=(least, most, least, most))

    def _step_rewards(self) -> StepRewards:
        step = (self.not_ending_point_reward, self.closer_to_point_reward)
        return (step, step)

    def _get_obs(self) -> list[float]:
        scan = self.discretize_scan_observation(self.laser_scan, self.new_ranges)
        pose = self.odom.pose.pose
        yaw = euler_of(pose.orientation)[2]
        return [*scan, round(pose.position.x, 2), round(pose.position.y, 2), round(yaw, 2)]
