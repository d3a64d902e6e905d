"""The monoped stays up."""

from __future__ import annotations

from typing import Any, ClassVar

import numpy as np

from gazelle.drop_in.gym.spaces import Box
from gazelle.drop_in.openai_ros.robot_envs.hopper_env import HopperEnv
from gazelle.drop_in.openai_ros.task_envs.geometry import coordinates, euler_of, one, point
from gazelle.drop_in.openai_ros.task_envs.graph_task import GraphTask
from gazelle.drop_in.openai_ros.task_envs.task_envs_list import register_task
from gazelle.envs.goal_rules import distance_to
from gazelle.envs.hopper.rules import StandRules, has_height, is_upright, reward_of
from gazelle_ros.compat import rospy
from gazelle_ros.msgs import geometry_msgs

register_task("HopperStayUp-v0")

_HALF_TURN = 3.14


class HopperStayUpEnv(GraphTask, HopperEnv):
    """Do not fall; parameters under ``/monoped``.

    Observation, rounded to ``number_decimals_precision_obs``: distance of the base from ``desired_point``
    [m]; roll, pitch, yaw [rad]; contact force [N]; joints haa, hfe, kfe [rad]; x, y, z of the base [m].
    Actions: raise and lower each joint by ``joint_increment_value`` (haa, hfe, kfe). Reward:
    ``alive_reward`` less the weighted sums of the joints, of the force's distance from ``desired_force``, of
    the orientation and of the distance, also at the end. End: z outside ``min_height`` and ``max_height``,
    roll or pitch beyond ``max_incl``.

    The first number is the desired point's distance from itself, 0, as in openai_ros; the contact force
    is 0 as well, because openai_ros keeps what it measures in ``contact_force`` and returns another vector.
    """

    space: ClassVar[str] = "monoped"

    def __init__(self) -> None:
        workspace = self._begin("hopper/hopper_stay_up", "legged_robots_sims")
        self._read_parameters()
        self.observation_space = self._bounds()
        super().__init__(workspace)

    def _read_parameters(self) -> None:
        number = self.number
        joints = [number(f"init_joint_states/{name}_joint") for name in ("haa", "hfe", "kfe")]
        self.init_joint_states = point(*joints)
        self.desired_point = point(*(number(f"desired_point/{axis}") for axis in "xyz"))
        self.desired_yaw = number("desired_yaw")
        self.joint_increment_value = number("joint_increment_value")
        self.accepted_joint_error = number("accepted_joint_error")
        self.update_rate = number("update_rate")
        self.dec_obs = int(number("number_decimals_precision_obs"))
        self.desired_force = number("desired_force")
        self.max_contact_force = number("max_contact_force")
        self.min_height, self.max_height = number("min_height"), number("max_height")
        self.max_incl_roll = self.max_incl_pitch = number("max_incl")
        self.weight_joint_position = number("rewards_weight/weight_joint_position")
        self.weight_contact_force = number("rewards_weight/weight_contact_force")
        self.weight_orientation = number("rewards_weight/weight_orientation")
        self.weight_distance_from_des_point = number(
            "rewards_weight/weight_distance_from_des_point"
        )
        self.alive_reward, self.done_reward = number("alive_reward"), number("done_reward")
        self.init_move_time = float(rospy.get_param(f"/{self.space}/init_move_time", 1.0))
        self.move_time = float(rospy.get_param(f"/{self.space}/move_time", 0.05))
        self.check_position = bool(rospy.get_param(f"/{self.space}/check_position", True))

    def _bounds(self) -> Box:
        number, lean, force = self.number, self.max_incl_roll, self.max_contact_force
        haa, hfe, kfe = (number(f"maximum_{name}_joint") for name in ("haa", "hfe", "kfe"))
        far, x, y = (
            number("distance_from_desired_point_max"),
            number("max_x_pos"),
            number("max_y_pos"),
        )
        low = [0.0, -lean, -lean, -_HALF_TURN, 0.0, -haa, -hfe, number("min_kfe_joint"), -x, -y]
        high = [far, lean, lean, _HALF_TURN, force, haa, hfe, kfe, x, y]
        return Box(
            np.array([*low, self.min_height], np.float32),
            np.array([*high, self.max_height], np.float32),
        )

    def _rules(self) -> StandRules:
        desired = self.desired_point
        return StandRules(
            desired=(desired.x, desired.y, desired.z),
            desired_yaw=self.desired_yaw,
            desired_force=self.desired_force,
            lowest=self.min_height,
            highest=self.max_height,
            steepest=(self.max_incl_roll, self.max_incl_pitch),
            alive_reward=self.alive_reward,
            weights=(
                self.weight_joint_position,
                self.weight_contact_force,
                self.weight_orientation,
                self.weight_distance_from_des_point,
            ),
        )

    def _set_init_pose(self) -> bool:
        begin = self.init_joint_states
        self.move_joints(
            [begin.x, begin.y, begin.z],
            epsilon=self.accepted_joint_error,
            update_rate=self.update_rate,
            time_sleep=self.init_move_time,
            check_position=self.check_position,
        )
        return True

    def _init_env_variables(self) -> None:
        self.cumulated_reward = 0.0

    def _set_action(self, action: Any) -> None:
        positions = list(self.joint_states.position[:3])
        joint, down = divmod(int(action), 2)
        positions[joint] += -self.joint_increment_value if down else self.joint_increment_value
        self.move_joints(
            positions,
            epsilon=self.accepted_joint_error,
            update_rate=self.update_rate,
            time_sleep=self.move_time,
            check_position=self.check_position,
        )

    def _get_obs(self) -> list[float]:
        place = self.odom.pose.pose.position
        rpy = self.get_base_rpy()
        values = (
            self.get_distance_from_desired_point(self.desired_point),
            *(rpy.x, rpy.y, rpy.z),
            self.get_contact_force_magnitude(),
            *self.joint_states.position[:3],
            *(place.x, place.y, place.z),
        )
        return [round(each, self.dec_obs) for each in values]

    def _is_done(self, observations: Any) -> bool:
        return not (self.monoped_height_ok(observations[10]) and self.monoped_orientation_ok())

    def _compute_reward(self, observations: Any, done: bool) -> float:  # noqa: FBT001  # openai_ros' interface
        del done
        return self._count(reward_of(self._rules(), one(observations)))

    def get_distance_from_desired_point(self, current_position: geometry_msgs.msg.Point) -> float:
        """Return the distance from a place to the target of the base [m]."""
        place = coordinates(current_position)
        return float(distance_to(place, self._rules().desired)[0])

    def get_base_rpy(self) -> geometry_msgs.msg.Vector3:
        """Return roll, pitch and yaw of the base as a ``geometry_msgs/Vector3`` [rad]."""
        vector = geometry_msgs.msg.Vector3
        return vector(*euler_of(self.imu.orientation))

    def get_contact_force_magnitude(self) -> float:
        """Return 0, as openai_ros does [N]; the foot's last contact is kept in ``contact_force``."""
        for state in self.lowerleg_contactsensor_state.states:
            self.contact_force = state.total_wrench.force
        return 0.0

    def monoped_height_ok(self, height_base: float) -> bool:
        """Return whether the base is as high as it may be [m]."""
        return bool(has_height(self._rules(), one(height_base))[0])

    def monoped_orientation_ok(self) -> bool:
        """Return whether the base does not lean too much."""
        rpy = self.get_base_rpy()
        return bool(is_upright(self._rules(), one((rpy.x, rpy.y)))[0])
