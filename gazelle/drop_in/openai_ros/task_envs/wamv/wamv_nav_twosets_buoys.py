"""The WAM-V goes between two pairs of buoys."""

from __future__ import annotations

from typing import Any, ClassVar

import numpy as np

from gazelle.drop_in.gym.spaces import Box
from gazelle.drop_in.openai_ros.robot_envs.wamv_env import WamvEnv
from gazelle.drop_in.openai_ros.task_envs.geometry import coordinates, euler_of, one, point
from gazelle.drop_in.openai_ros.task_envs.places import DesiredPoint
from gazelle.drop_in.openai_ros.task_envs.task_envs_list import register_task
from gazelle.envs.wamv.rules import ChannelRules, outside, reached, reward_of
from gazelle_ros.msgs import geometry_msgs

register_task("WamvNavTwoSetsBuoys-v0")

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

    space: ClassVar[str] = "wamv"

    def __init__(self) -> None:
        workspace = self._begin("wamv/wamv_nav_twosets_buoys", "robotx_gazebo")
        self._read_parameters()
        fast, turning = self.propeller_high_speed, self.max_angular_speed
        most = [1.57, 1.57, 3.14, fast, fast, turning]
        rules = self._rules()
        self.observation_space = Box(
            np.array([*rules.low, *(-each for each in most), 0.0], np.float32),
            np.array([*rules.high, *most, self.max_distance_from_des_point], np.float32),
        )
        super().__init__(workspace)

    def _read_parameters(self) -> None:
        number = self.number
        self.propeller_high_speed = number("propeller_high_speed")
        self.propeller_low_speed = number("propeller_low_speed")
        self.max_angular_speed = number("max_angular_speed")
        self.max_distance_from_des_point = number("max_distance_from_des_point")
        self.desired_point_epsilon = number("desired_point_epsilon")
        self.done_reward = number("done_reward")
        self.closer_to_point_reward = number("closer_to_point_reward")
        self.work_space_x_min, self.work_space_x_max = self._edges("x")
        self.work_space_y_min, self.work_space_y_max = self._edges("y")
        self.dec_obs = int(number("number_decimals_precision_obs"))
        self.desired_point = point(*(number(f"desired_point/{axis}") for axis in "xyz"))

    def _rules(self) -> ChannelRules:
        x, y, z = self._goal()
        return ChannelRules(
            goal=(x, y, z),
            tolerance=self.desired_point_epsilon,
            low=(self.work_space_x_min, self.work_space_y_min),
            high=(self.work_space_x_max, self.work_space_y_max),
            closer_reward=self.closer_to_point_reward,
            end_reward=self.done_reward,
        )

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
        rules, place = self._rules(), one(observations[:2])
        return bool((outside(rules, place) | reached(rules, place))[0])

    def _compute_reward(self, observations: Any, done: bool) -> float:  # noqa: FBT001  # openai_ros' interface
        rules, place = self._rules(), one(observations[:2])
        distance = self.get_distance_from_desired_point(point(*observations[:2]))
        closer, success = self._comes_nearer(distance), reached(rules, place)
        return self._count(reward_of(rules, over=one(done), success=success, closer=closer))

    def is_inside_workspace(self, current_position: geometry_msgs.msg.Point) -> bool:
        """Return whether a place is in the work space; its upper edges belong to it."""
        return not outside(self._rules(), coordinates(current_position)[:, :2])[0]
