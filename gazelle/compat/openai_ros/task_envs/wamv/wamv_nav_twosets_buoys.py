"""The WAM-V goes between two pairs of buoys."""

from __future__ import annotations

from typing import Any

import numpy as np

from gazelle.compat.gym.spaces import Box, Discrete
from gazelle.compat.openai_ros.robot_envs.wamv_env import WamvEnv
from gazelle.compat.openai_ros.task_envs.geometry import euler_of, point
from gazelle.compat.openai_ros.task_envs.places import DesiredPoint
from gazelle.compat.openai_ros.task_envs.task_commons import begin_task
from gazelle.compat.openai_ros.task_envs.task_envs_list import register_task
from gazelle.ros.compat import rospy

register_task("WamvNavTwoSetsBuoys-v0")

_SPACE = "/wamv"
_EDGES = ("x_min", "x_max", "y_min", "y_max")
# Right and left propeller of each action, as shares of ``propeller_high_speed``.
_ACTIONS = ((1.0, 1.0), (-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0))


class WamvNavTwoSetsBuoysEnv(DesiredPoint, WamvEnv):
    """Go to ``desired_point``; parameters under ``/wamv``.

    Observation, rounded to ``number_decimals_precision_obs``: x, y [m]; roll, pitch, yaw [rad]; velocity along x and
    y [m/s]; turning rate [rad/s]; distance from the goal [m]. Actions: both propellers ahead, both astern, to the
    left, to the right, for a second each. Reward: ``closer_to_point_reward`` when nearer to the goal, else less by
    that; at the end ``done_reward`` at the goal, less by that elsewhere. End: outside ``work_space``, or within
    ``desired_point_epsilon`` of the goal along x and y.
    """

    def __init__(self) -> None:
        workspace = begin_task(
            "wamv", "wamv", "wamv_nav_twosets_buoys.yaml", "robotx_gazebo", "start_world.launch"
        )
        self.action_space = Discrete(int(rospy.get_param(f"{_SPACE}/n_actions")))
        self.reward_range = (-np.inf, np.inf)
        self._read_parameters()
        fast, turning = self.propeller_high_speed, self.max_angular_speed
        most = [1.57, 1.57, 3.14, fast, fast, turning]
        low = [self.work_space_x_min, self.work_space_y_min, *(-each for each in most), 0.0]
        high = [self.work_space_x_max, self.work_space_y_max, *most]
        self.observation_space = Box(
            np.array(low, np.float32),
            np.array([*high, self.max_distance_from_des_point], np.float32),
        )
        self.cumulated_reward = self.cumulated_steps = 0.0
        super().__init__(workspace)

    def _read_parameters(self) -> None:
        def number(name: str) -> float:
            return float(rospy.get_param(f"{_SPACE}/{name}"))

        for name in (
            *("propeller_high_speed", "propeller_low_speed", "max_angular_speed"),
            *("max_distance_from_des_point", "desired_point_epsilon"),
            *("done_reward", "closer_to_point_reward"),
        ):
            setattr(self, name, number(name))
        for edge in _EDGES:
            setattr(self, f"work_space_{edge}", number(f"work_space/{edge}"))
        self.dec_obs = int(number("number_decimals_precision_obs"))
        self.desired_point = point(*(number(f"desired_point/{axis}") for axis in "xyz"))

    propeller_high_speed: float
    propeller_low_speed: float
    max_angular_speed: float
    max_distance_from_des_point: float
    desired_point_epsilon: float
    done_reward: float
    closer_to_point_reward: float
    work_space_x_min: float
    work_space_x_max: float
    work_space_y_min: float
    work_space_y_max: float

    def _set_init_pose(self) -> bool:
        self.set_propellers_speed(0.0, 0.0, time_sleep=1.0)
        return True

    def _init_env_variables(self) -> None:
        self.cumulated_reward = 0.0
        place = self.odom.pose.pose.position
        self.previous_distance_from_des_point = self.get_distance_from_desired_point(
            point(place.x, place.y)
        )

    def _set_action(self, action: Any) -> None:
        number = int(action)
        right, left = _ACTIONS[number] if 0 <= number < len(_ACTIONS) else (0.0, 0.0)
        fast = self.propeller_high_speed
        self.set_propellers_speed(right * fast, left * fast, time_sleep=1.0)

    def _get_obs(self) -> list[float]:
        pose, twist = self.odom.pose.pose, self.odom.twist.twist
        seen = (
            pose.position.x,
            pose.position.y,
            *euler_of(pose.orientation),
            twist.linear.x,
            twist.linear.y,
            twist.angular.z,
            self.get_distance_from_desired_point(pose.position),
        )
        return [round(each, self.dec_obs) for each in seen]

    def _is_done(self, observations: Any) -> bool:
        place = point(*observations[:2])
        return not self.is_inside_workspace(place) or self.is_in_desired_position(
            place, self.desired_point_epsilon
        )

    def _compute_reward(self, observations: Any, done: bool) -> float:  # noqa: FBT001  # openai_ros' interface
        place = point(*observations[:2])
        nearer = self._comes_nearer(place)
        if done:
            good = self.is_in_desired_position(place, self.desired_point_epsilon)
            reward = self.done_reward if good else -self.done_reward
        else:
            reward = self.closer_to_point_reward if nearer else -self.closer_to_point_reward
        self.cumulated_reward += reward
        self.cumulated_steps += 1
        return reward

    def is_inside_workspace(self, current_position: Any) -> bool:
        """Return whether a position is in the work space; its upper edges belong to it."""
        return bool(
            self.work_space_x_min < current_position.x <= self.work_space_x_max
            and self.work_space_y_min < current_position.y <= self.work_space_y_max
        )
