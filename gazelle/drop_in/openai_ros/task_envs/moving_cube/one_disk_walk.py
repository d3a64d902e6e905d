"""Task: a cube moves along y by the wheel in its face."""

from __future__ import annotations

import math
from typing import Any, ClassVar

import numpy as np

from gazelle.drop_in.gym.spaces import Box
from gazelle.drop_in.openai_ros.robot_envs.cube_single_disk_env import CubeSingleDiskEnv
from gazelle.drop_in.openai_ros.task_envs.geometry import coordinates, euler_of, one, point
from gazelle.drop_in.openai_ros.task_envs.graph_task import GraphTask
from gazelle.drop_in.openai_ros.task_envs.task_envs_list import register_task
from gazelle.envs.goal_rules import distance_to
from gazelle.envs.moving_cube.rules import WalkRules, has_failed, reward_of, wheel_speeds
from gazelle_ros.msgs import geometry_msgs

register_task("MovingCubeOneDiskWalk-v0")


class MovingCubeOneDiskWalkEnv(GraphTask, CubeSingleDiskEnv):
    """Move along y; parameters under ``/moving_cube``.

    Observation: speed of the wheel [rad/s] without decimals; distance along y [m], roll, pitch [rad], velocity
    along y [m/s] and yaw [rad] with one. Actions: the wheel to ``roll_speed_fixed_value``, to the
    opposite, to a stop, and by ``roll_speed_increment_value`` faster or slower (``n_actions`` of them).
    Reward: 100 for a metre along y, 100 for a metre a second, up to -100 for yaw, each without decimals;
    at the end ``-end_episode_points``, which is **+10** with the published parameter of -10. End: pitch
    or yaw beyond 0.3 rad.
    """

    space: ClassVar[str] = "moving_cube"

    def __init__(self) -> None:
        workspace = self._begin("moving_cube/one_disk_walk", "moving_cube_description")
        self._read_parameters()
        most = [self.roll_speed_fixed_value, self.max_distance, math.pi]
        most += [self.max_pitch_angle, self.max_y_linear_speed, self.max_yaw_angle]
        self.observation_space = Box(-np.array(most, np.float32), np.array(most, np.float32))
        super().__init__(workspace)

    def _read_parameters(self) -> None:
        number = self.number
        self.roll_speed_fixed_value = number("roll_speed_fixed_value")
        self.roll_speed_increment_value = number("roll_speed_increment_value")
        self.max_distance = number("max_distance")
        self.max_pitch_angle = number("max_pitch_angle")
        self.max_yaw_angle = number("max_yaw_angle")
        self.max_y_linear_speed = number("max_y_linear_speed")
        self.init_roll_vel = number("init_roll_vel")
        self.start_point = point(*(number(f"init_cube_pose/{axis}") for axis in "xyz"))
        self.move_distance_reward_weight = number("move_distance_reward_weight")
        self.y_linear_speed_reward_weight = number("y_linear_speed_reward_weight")
        self.y_axis_angle_reward_weight = number("y_axis_angle_reward_weight")
        self.end_episode_points = number("end_episode_points")

    def _rules(self) -> WalkRules:
        return WalkRules(
            speed=self.roll_speed_fixed_value,
            speed_step=self.roll_speed_increment_value,
            largest_pitch=self.max_pitch_angle,
            largest_yaw=self.max_yaw_angle,
            way_weight=self.move_distance_reward_weight,
            speed_weight=self.y_linear_speed_reward_weight,
            yaw_weight=self.y_axis_angle_reward_weight,
            failure_reward=-self.end_episode_points,
        )

    def _set_init_pose(self) -> bool:
        self.move_joints(self.init_roll_vel)
        return True

    def _init_env_variables(self) -> None:
        self.current_y_distance = self.get_y_dir_distance_from_start_point(self.start_point)
        self.roll_turn_speed = self.init_roll_vel
        self.cumulated_reward = 0.0

    def _set_action(self, action: Any) -> None:
        speeds = wheel_speeds(self._rules(), one(self.roll_turn_speed), one(int(action)))
        self.roll_turn_speed = float(speeds[0])
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
        return bool(has_failed(self._rules(), one(observations))[0])

    def _compute_reward(self, observations: Any, done: bool) -> float:  # noqa: FBT001  # openai_ros' interface
        before = one(self.current_y_distance)
        if not done:
            self.current_y_distance = observations[1]
        return self._count(reward_of(self._rules(), one(observations), before, one(done)))

    def get_y_dir_distance_from_start_point(self, start_point: geometry_msgs.msg.Point) -> float:
        """Return the distance along y from the start [m]."""
        return float(self.odom.pose.pose.position.y - start_point.y)

    def get_distance_from_start_point(self, start_point: geometry_msgs.msg.Point) -> float:
        """Return the distance from the start [m]."""
        place = coordinates(self.odom.pose.pose.position)
        return float(distance_to(place, coordinates(start_point).reshape(-1))[0])

    def get_orientation_euler(self) -> tuple[float, float, float]:
        """Return roll, pitch and yaw [rad]."""
        return euler_of(self.odom.pose.pose.orientation)

    def get_roll_velocity(self) -> float:
        """Return the rolling velocity of the wheel [rad/s]."""
        return float(self.joints.velocity[0])

    def get_y_linear_speed(self) -> float:
        """Return the speed along y [m/s]."""
        return float(self.odom.twist.twist.linear.y)
