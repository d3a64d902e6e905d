"""The Parrot drone flies to a place."""

from __future__ import annotations

from typing import Any, ClassVar

import numpy as np

from gazelle.drop_in.gym.spaces import Box
from gazelle.drop_in.openai_ros.robot_envs.parrotdrone_env import ParrotDroneEnv
from gazelle.drop_in.openai_ros.task_envs.geometry import coordinates, euler_of, one, point
from gazelle.drop_in.openai_ros.task_envs.places import DesiredPoint
from gazelle.drop_in.openai_ros.task_envs.task_envs_list import register_task
from gazelle.envs.goal_rules import is_inside
from gazelle.envs.parrot_drone.rules import FlightRules, ends_of, has_flipped, reward_of
from gazelle_ros.msgs import geometry_msgs

register_task("ParrotDroneGoto-v0")

_ACTIONS = ("FORWARDS", "BACKWARDS", "STRAFE_LEFT", "STRAFE_RIGHT", "UP", "DOWN")


class ParrotDroneGotoEnv(DesiredPoint, ParrotDroneEnv):
    """Fly to ``desired_pose``; parameters under ``/drone``.

    Observation: x, y, z cut to whole metres; roll, pitch, yaw [rad] and the sonar [m] with one decimal. Actions:
    ``linear_forward_speed`` forward, backward, left, right, up, down, for a second each. Reward: 10 when
    nearer to the goal; at the end 200 within 0.5 m of it along x and y, -200 elsewhere. End: outside
    ``work_space``, the sonar below ``min_sonar_value``, flipped, or within ``desired_point_epsilon`` of the goal
    along x and y.
    """

    space: ClassVar[str] = "drone"

    def __init__(self) -> None:
        workspace = self._begin("parrotdrone/parrotdrone_goto", "drone_construct")
        self._read_parameters()
        rules, tilt = self._rules(), [self.max_roll, self.max_pitch]
        low = [*rules.low, *(-each for each in tilt), -np.inf, self.min_sonar_value]
        high = [*rules.high, *tilt, self.max_yaw, self.max_sonar_value]
        self.observation_space = Box(np.array(low, np.float32), np.array(high, np.float32))
        self.last_action = ""
        super().__init__(workspace)

    def _read_parameters(self) -> None:
        number = self.number
        self.linear_forward_speed = number("linear_forward_speed")
        self.angular_turn_speed = number("angular_turn_speed")
        self.angular_speed = number("angular_speed")
        self.init_angular_turn_speed = number("init_angular_turn_speed")
        self.min_sonar_value = number("min_sonar_value")
        self.max_sonar_value = number("max_sonar_value")
        self.work_space_x_min, self.work_space_x_max = self._edges("x")
        self.work_space_y_min, self.work_space_y_max = self._edges("y")
        self.work_space_z_min, self.work_space_z_max = self._edges("z")
        self.max_roll, self.max_pitch = number("max_roll"), number("max_pitch")
        self.max_yaw = number("max_yaw")
        self.desired_point_epsilon = number("desired_point_epsilon")
        self.closer_to_point_reward = number("closer_to_point_reward")
        self.not_ending_point_reward = number("not_ending_point_reward")
        self.end_episode_points = number("end_episode_points")
        self.init_linear_speed_vector = _vector(
            *(number(f"init_linear_speed_vector/{axis}") for axis in "xyz")
        )
        self.desired_point = point(*(number(f"desired_pose/{axis}") for axis in "xyz"))

    def _rules(self) -> FlightRules:
        x, y, z = self._goal()
        return FlightRules(
            goal=(x, y, z),
            low=(self.work_space_x_min, self.work_space_y_min, self.work_space_z_min),
            high=(self.work_space_x_max, self.work_space_y_max, self.work_space_z_max),
            steepest=(self.max_roll, self.max_pitch),
            nearest=self.min_sonar_value,
            end_tolerance=self.desired_point_epsilon,
            closer_reward=self.closer_to_point_reward,
            end_reward=self.end_episode_points,
        )

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
        return bool(ends_of(self._rules(), one(observations)).over[0])

    def _compute_reward(self, observations: Any, done: bool) -> float:  # noqa: FBT001  # openai_ros' interface
        rules, place = self._rules(), point(*observations[:3])
        closer = self._comes_nearer(self.get_distance_from_desired_point(place))
        there = one(self.is_in_desired_position(place, rules.success_tolerance))
        return self._count(reward_of(rules, over=one(done), succeeded=there, closer=closer))

    def is_inside_workspace(self, current_position: geometry_msgs.msg.Point) -> bool:
        """Return whether a place is in the work space; its upper edges belong to it."""
        rules = self._rules()
        return bool(is_inside(coordinates(current_position), rules.low, rules.high)[0])

    def sonar_detected_something_too_close(self, sonar_value: float) -> bool:
        """Return whether a distance ahead is below the least [m]."""
        return sonar_value < self.min_sonar_value

    def drone_has_flipped(self, current_orientation: geometry_msgs.msg.Vector3) -> bool:
        """Return whether roll (x) or pitch (y) are beyond what they may be [rad]."""
        return bool(has_flipped(self._rules(), coordinates(current_orientation)[:, :2])[0])


def _vector(x: float, y: float, z: float) -> geometry_msgs.msg.Vector3:
    made = geometry_msgs.msg.Vector3
    return made(x, y, z)
