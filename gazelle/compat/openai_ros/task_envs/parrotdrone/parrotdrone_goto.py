"""The Parrot drone flies to a place."""

from __future__ import annotations

from typing import Any

import numpy as np

from gazelle.compat.gym.spaces import Box, Discrete
from gazelle.compat.openai_ros.robot_envs.parrotdrone_env import ParrotDroneEnv
from gazelle.compat.openai_ros.task_envs.geometry import euler_of, point
from gazelle.compat.openai_ros.task_envs.places import DesiredPoint
from gazelle.compat.openai_ros.task_envs.task_commons import begin_task
from gazelle.compat.openai_ros.task_envs.task_envs_list import register_task
from gazelle.ros import load_message
from gazelle.ros.compat import rospy

register_task("ParrotDroneGoto-v0")

_SPACE = "/drone"
_EDGES = tuple(f"{axis}_{end}" for axis in "xyz" for end in ("min", "max"))
_ACTIONS = ("FORWARDS", "BACKWARDS", "STRAFE_LEFT", "STRAFE_RIGHT", "UP", "DOWN")
_AT_GOAL = 0.5
"""Distance from the goal that earns the reward, along x and along y [m]."""


class ParrotDroneGotoEnv(DesiredPoint, ParrotDroneEnv):
    """Fly to ``desired_pose``; parameters under ``/drone``.

    Observation: x, y, z cut to whole metres; roll, pitch, yaw [rad] and the sonar [m] with one decimal. Actions:
    ``linear_forward_speed`` forward, backward, left, right, up, down, for a second each. Reward: 10 when
    nearer to the goal; at the end 200 within 0.5 m of it along x and y, -200 elsewhere. End: outside
    ``work_space``, the sonar below ``min_sonar_value``, flipped, or within ``desired_point_epsilon`` of the goal
    along x and y.
    """

    def __init__(self) -> None:
        workspace = begin_task(
            "drone", "parrotdrone", "parrotdrone_goto.yaml", "drone_construct", "start_world.launch"
        )
        self.action_space = Discrete(int(rospy.get_param(f"{_SPACE}/n_actions")))
        self.reward_range = (-np.inf, np.inf)
        self._read_parameters()
        high = [self.work_space_x_max, self.work_space_y_max, self.work_space_z_max]
        low = [self.work_space_x_min, self.work_space_y_min, self.work_space_z_min]
        tilt = [self.max_roll, self.max_pitch]
        self.observation_space = Box(
            np.array([*low, *(-each for each in tilt), -np.inf, self.min_sonar_value], np.float32),
            np.array([*high, *tilt, self.max_yaw, self.max_sonar_value], np.float32),
        )
        self.last_action = ""
        self.cumulated_reward = self.cumulated_steps = 0.0
        super().__init__(workspace)

    def _read_parameters(self) -> None:
        def number(name: str) -> float:
            return float(rospy.get_param(f"{_SPACE}/{name}"))

        for name in (
            *("linear_forward_speed", "angular_turn_speed", "angular_speed"),
            *("init_angular_turn_speed", "min_sonar_value", "max_sonar_value"),
            *("max_roll", "max_pitch", "max_yaw", "desired_point_epsilon"),
            *("closer_to_point_reward", "not_ending_point_reward", "end_episode_points"),
        ):
            setattr(self, name, number(name))
        for edge in _EDGES:
            setattr(self, f"work_space_{edge}", number(f"work_space/{edge}"))
        self.init_linear_speed_vector = _vector(
            *(number(f"init_linear_speed_vector/{axis}") for axis in "xyz")
        )
        self.desired_point = point(*(number(f"desired_pose/{axis}") for axis in "xyz"))

    work_space_x_min: float
    work_space_x_max: float
    work_space_y_min: float
    work_space_y_max: float
    work_space_z_min: float
    work_space_z_max: float
    linear_forward_speed: float
    angular_turn_speed: float
    angular_speed: float
    init_angular_turn_speed: float
    min_sonar_value: float
    max_sonar_value: float
    max_roll: float
    max_pitch: float
    max_yaw: float
    desired_point_epsilon: float
    closer_to_point_reward: float
    not_ending_point_reward: float
    end_episode_points: float

    def _set_init_pose(self) -> bool:
        self.move_base(self.init_linear_speed_vector, self.init_angular_turn_speed)
        return True

    def _init_env_variables(self) -> None:
        self.takeoff()
        self.cumulated_reward = 0.0
        self.previous_distance_from_des_point = self.get_distance_from_desired_point(
            self.gt_pose.position
        )

    def _set_action(self, action: Any) -> None:
        number, speed = int(action), self.linear_forward_speed
        velocity = [0.0, 0.0, 0.0]
        if 0 <= number < len(_ACTIONS):
            velocity[number // 2] = -speed if number % 2 else speed
            self.last_action = _ACTIONS[number]
        self.move_base(_vector(*velocity), 0.0)

    def _get_obs(self) -> list[float]:
        pose = self.gt_pose
        roll, pitch, yaw = euler_of(pose.orientation)
        place = pose.position
        seen = (roll, pitch, yaw, self.sonar.range)
        return [int(place.x), int(place.y), int(place.z), *(round(each, 1) for each in seen)]

    def _is_done(self, observations: Any) -> bool:
        place = point(*observations[:3])
        return (
            not self.is_inside_workspace(place)
            or self.sonar_detected_something_too_close(observations[6])
            or self.drone_has_flipped(point(*observations[3:6]))
            or self.is_in_desired_position(place, self.desired_point_epsilon)
        )

    def _compute_reward(self, observations: Any, done: bool) -> float:  # noqa: FBT001  # openai_ros' interface
        place = point(*observations[:3])
        nearer = self._comes_nearer(place)
        if done:
            there = self.is_in_desired_position(place, _AT_GOAL)
            reward = self.end_episode_points if there else -self.end_episode_points
        else:
            reward = self.closer_to_point_reward if nearer else 0.0
        self.cumulated_reward += reward
        self.cumulated_steps += 1
        return reward

    def is_inside_workspace(self, current_position: Any) -> bool:
        """Return whether a position is in the work space; its upper edges belong to it."""
        return bool(
            self.work_space_x_min < current_position.x <= self.work_space_x_max
            and self.work_space_y_min < current_position.y <= self.work_space_y_max
            and self.work_space_z_min < current_position.z <= self.work_space_z_max
        )

    def sonar_detected_something_too_close(self, sonar_value: float) -> bool:
        """Return whether a distance ahead is below the least [m]."""
        return sonar_value < self.min_sonar_value

    def drone_has_flipped(self, current_orientation: Any) -> bool:
        """Return whether roll (x) or pitch (y) exceed their limits [rad]."""
        return not (
            -self.max_roll < current_orientation.x <= self.max_roll
            and -self.max_pitch < current_orientation.y <= self.max_pitch
        )


def _vector(x: float, y: float, z: float) -> Any:
    made: Any = load_message("geometry_msgs/Vector3")
    return made(x, y, z)
