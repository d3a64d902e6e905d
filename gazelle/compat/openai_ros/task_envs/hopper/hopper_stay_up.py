"""The monoped stays up."""

from __future__ import annotations

from typing import Any

import numpy as np

from gazelle.compat.gym.spaces import Box, Discrete
from gazelle.compat.openai_ros.robot_envs.hopper_env import HopperEnv
from gazelle.compat.openai_ros.task_envs.geometry import distance, euler_of, magnitude, point
from gazelle.compat.openai_ros.task_envs.task_commons import begin_task
from gazelle.compat.openai_ros.task_envs.task_envs_list import register_task
from gazelle.ros import load_message
from gazelle.ros.compat import rospy

register_task("HopperStayUp-v0")

_SPACE = "/monoped"
_HALF_TURN = 3.14
_WEIGHTS = ("joint_position", "contact_force", "orientation", "distance_from_des_point")


class HopperStayUpEnv(HopperEnv):
    """Do not fall; parameters under ``/monoped``.

    Observation, rounded to ``number_decimals_precision_obs``: distance of the base from ``desired_point``
    [m]; roll, pitch, yaw [rad]; contact force [N]; joints haa, hfe, kfe [rad]; x, y, z of the base [m].
    Actions: raise and lower each joint by ``joint_increment_value`` (haa, hfe, kfe). Reward:
    ``alive_reward`` less the weighted sums of the joints, of the force's distance from ``desired_force``, of
    the orientation and of the distance, also at the end. End: z outside ``min_height`` and ``max_height``,
    roll or pitch beyond ``max_incl``.

    In openai_ros the first number is the desired point's distance from itself, zero, and the contact
    force is zero too, for what is measured goes elsewhere; here both are measured.
    """

    def __init__(self) -> None:
        workspace = begin_task(
            "monoped",
            "hopper",
            "hopper_stay_up.yaml",
            "legged_robots_sims",
            "start_world.launch",
        )
        self.action_space = Discrete(int(rospy.get_param(f"{_SPACE}/n_actions")))
        self.reward_range = (-np.inf, np.inf)
        self._read_parameters()
        self.observation_space = self._bounds()
        super().__init__(workspace)

    def _read_parameters(self) -> None:
        def number(name: str) -> float:
            return float(rospy.get_param(f"{_SPACE}/{name}"))

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
        self.weights = {name: number(f"rewards_weight/weight_{name}") for name in _WEIGHTS}
        self.alive_reward, self.done_reward = number("alive_reward"), number("done_reward")
        self.init_move_time = float(rospy.get_param(f"{_SPACE}/init_move_time", 1.0))
        self.move_time = float(rospy.get_param(f"{_SPACE}/move_time", 0.05))
        self.check_position = bool(rospy.get_param(f"{_SPACE}/check_position", True))
        self._limits = {
            name: number(name)
            for name in (
                "distance_from_desired_point_max",
                "maximum_haa_joint",
                "maximum_hfe_joint",
                "maximum_kfe_joint",
                "min_kfe_joint",
                "max_x_pos",
                "max_y_pos",
            )
        }

    def _bounds(self) -> Box:
        bound, lean = self._limits, self.max_incl_roll
        haa, hfe = bound["maximum_haa_joint"], bound["maximum_hfe_joint"]
        x, y = bound["max_x_pos"], bound["max_y_pos"]
        high = [bound["distance_from_desired_point_max"], lean, lean, _HALF_TURN]
        high += [
            self.max_contact_force,
            haa,
            hfe,
            bound["maximum_kfe_joint"],
            x,
            y,
            self.max_height,
        ]
        low = [0.0, -lean, -lean, -_HALF_TURN]
        low += [0.0, -haa, -hfe, bound["min_kfe_joint"], -x, -y, self.min_height]
        return Box(np.array(low, np.float32), np.array(high, np.float32))

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
            self.get_distance_from_desired_point(place),
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
        roll, pitch, yaw = observations[1:4]
        missing = {
            "joint_position": sum(abs(each) for each in observations[5:8]),
            "contact_force": abs(observations[4] - self.desired_force),
            "orientation": abs(roll) + abs(pitch) + abs(yaw - self.desired_yaw),
            "distance_from_des_point": distance(point(*observations[8:]), self.desired_point),
        }
        reward = self.alive_reward - sum(self.weights[name] * missing[name] for name in _WEIGHTS)
        self.cumulated_reward += reward
        return float(reward)

    def get_distance_from_desired_point(self, current_position: Any) -> float:
        """From a place to where the base shall be [m]."""
        return distance(current_position, self.desired_point)

    def get_base_rpy(self) -> Any:
        """Roll, pitch and yaw of the base as x, y and z of a ``geometry_msgs/Vector3`` [rad]."""
        vector: Any = load_message("geometry_msgs/Vector3")
        return vector(*euler_of(self.imu.orientation))

    def get_contact_force_magnitude(self) -> float:
        """The force on the foot, of all contacts together [N]."""
        states = self.lowerleg_contactsensor_state.states
        forces = [state.total_wrench.force for state in states]
        total = np.array([[force.x, force.y, force.z] for force in forces]).reshape(-1, 3)
        return magnitude(point(*total.sum(axis=0)))

    def monoped_height_ok(self, height_base: float) -> bool:
        """Return whether the height of the base [m] is within its limits."""
        return self.min_height <= height_base < self.max_height

    def monoped_orientation_ok(self) -> bool:
        """Return whether the base does not lean too much."""
        rpy = self.get_base_rpy()
        return bool(abs(rpy.x) < self.max_incl_roll and abs(rpy.y) < self.max_incl_pitch)
