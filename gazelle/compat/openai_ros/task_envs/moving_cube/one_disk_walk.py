"""A cube walks along y by the wheel in its face."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from gazelle.compat.gym.spaces import Box, Discrete
from gazelle.compat.openai_ros.robot_envs.cube_single_disk_env import CubeSingleDiskEnv
from gazelle.compat.openai_ros.task_envs.geometry import distance, euler_of, point
from gazelle.compat.openai_ros.task_envs.task_commons import begin_task
from gazelle.compat.openai_ros.task_envs.task_envs_list import register_task
from gazelle.ros.compat import rospy

register_task("MovingCubeOneDiskWalk-v0")

_SPACE = "/moving_cube"


class MovingCubeOneDiskWalkEnv(CubeSingleDiskEnv):
    """Walk along y; parameters under ``/moving_cube``.

    Observation: speed of the wheel [rad/s] without decimals; way along y [m], roll, pitch [rad], velocity
    along y [m/s] and yaw [rad] with one. Actions: the wheel to ``roll_speed_fixed_value``, to the
    opposite, to a stop, and by ``roll_speed_increment_value`` faster or slower (``n_actions`` of them).
    Reward: 100 for a metre along y, 100 for a metre a second, up to -100 for yaw, each without decimals;
    at the end ``-end_episode_points``, which is **+10** with the published parameter of -10. End: pitch
    or yaw beyond 0.3 rad.
    """

    def __init__(self) -> None:
        workspace = begin_task(
            "moving_cube",
            "moving_cube",
            "one_disk_walk.yaml",
            "moving_cube_description",
            "start_world.launch",
        )
        self._read_parameters()
        self.action_space = Discrete(int(rospy.get_param(f"{_SPACE}/n_actions")))
        self.reward_range = (-np.inf, np.inf)
        most = np.array(
            [
                self.roll_speed_fixed_value,
                self.max_distance,
                math.pi,
                self.max_pitch_angle,
                self.max_y_linear_speed,
                self.max_yaw_angle,
            ],
            np.float32,
        )
        self.observation_space = Box(-most, most)
        self.cumulated_steps = 0.0
        self.cumulated_reward = 0.0
        super().__init__(workspace)

    def _read_parameters(self) -> None:
        def number(name: str) -> float:
            return float(rospy.get_param(f"{_SPACE}/{name}"))

        self.roll_speed_fixed_value = number("roll_speed_fixed_value")
        self.roll_speed_increment_value = number("roll_speed_increment_value")
        self.max_distance = number("max_distance")
        self.max_pitch_angle, self.max_yaw_angle = (
            number("max_pitch_angle"),
            number("max_yaw_angle"),
        )
        self.max_y_linear_speed = number("max_y_linear_speed")
        self.init_roll_vel = number("init_roll_vel")
        self.start_point = point(*(number(f"init_cube_pose/{axis}") for axis in "xyz"))
        self.move_distance_reward_weight = number("move_distance_reward_weight")
        self.y_linear_speed_reward_weight = number("y_linear_speed_reward_weight")
        self.y_axis_angle_reward_weight = number("y_axis_angle_reward_weight")
        self.end_episode_points = number("end_episode_points")

    def _set_init_pose(self) -> bool:
        self.move_joints(self.init_roll_vel)
        return True

    def _init_env_variables(self) -> None:
        self.current_y_distance = self.get_y_dir_distance_from_start_point(self.start_point)
        self.roll_turn_speed = self.init_roll_vel
        self.cumulated_reward = 0.0

    def _set_action(self, action: Any) -> None:
        most, more = self.roll_speed_fixed_value, self.roll_speed_increment_value
        now = self.roll_turn_speed
        speeds = (most, -most, 0.0, now + more, now - more)
        self.roll_turn_speed = float(np.clip(speeds[int(action)], -most, most))
        self.move_joints(self.roll_turn_speed)

    def _get_obs(self) -> list[float]:
        roll, pitch, yaw = self.get_orientation_euler()
        return [
            float(round(self.get_roll_velocity(), 0)),
            round(self.get_y_dir_distance_from_start_point(self.start_point), 1),
            round(roll, 1),
            round(pitch, 1),
            round(self.get_y_linear_speed(), 1),
            round(yaw, 1),
        ]

    def _is_done(self, observations: Any) -> bool:
        return bool(
            abs(observations[3]) > self.max_pitch_angle or abs(observations[5]) > self.max_yaw_angle
        )

    def _compute_reward(self, observations: Any, done: bool) -> float:  # noqa: FBT001  # openai_ros' interface
        if done:
            reward = -self.end_episode_points
        else:
            way, speed, yaw = observations[1], observations[4], observations[5]
            parts = (
                (way - self.current_y_distance) * self.move_distance_reward_weight,
                speed * self.y_linear_speed_reward_weight,
                -abs(math.sin(yaw)) * self.y_axis_angle_reward_weight,
            )
            reward = float(sum(round(part, 0) for part in parts))
            self.current_y_distance = way
        self.cumulated_reward += reward
        self.cumulated_steps += 1
        return reward

    def get_y_dir_distance_from_start_point(self, start_point: Any) -> float:
        """Along y from where it began [m]."""
        return float(self.odom.pose.pose.position.y - start_point.y)

    def get_distance_from_start_point(self, start_point: Any) -> float:
        """From where it began [m]."""
        return distance(start_point, self.odom.pose.pose.position)

    def get_orientation_euler(self) -> tuple[float, float, float]:
        """Roll, pitch and yaw [rad]."""
        return euler_of(self.odom.pose.pose.orientation)

    def get_roll_velocity(self) -> float:
        """Of the wheel [rad/s]."""
        return float(self.joints.velocity[0])

    def get_y_linear_speed(self) -> float:
        """Along y [m/s]."""
        return float(self.odom.twist.twist.linear.y)
