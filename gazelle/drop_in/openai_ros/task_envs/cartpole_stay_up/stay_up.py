"""A cart keeps its pole up."""

from __future__ import annotations

from typing import Any, ClassVar

import numpy as np

from gazelle.drop_in.gym.spaces import Box, Discrete
from gazelle.drop_in.openai_ros.robot_envs.cartpole_env import CartPoleEnv
from gazelle.drop_in.openai_ros.task_envs.geometry import one
from gazelle.drop_in.openai_ros.task_envs.graph_task import GraphTask
from gazelle.drop_in.openai_ros.task_envs.task_envs_list import register_task
from gazelle.envs.cartpole.rules import has_fallen
from gazelle_ros.compat import rospy

register_task("CartPoleStayUp-v0")

_RAIL = 5.0  # how far the observation reaches [m]
_FAST = 10.0  # how much more than an ordinary step actions 2 and 3 are


class CartPoleStayUpEnv(GraphTask, CartPoleEnv):
    """Move the cart to and fro; parameters under ``/cartpole_v0``.

    Observation: place [m] and velocity [m/s] of the cart, angle [rad] and velocity [rad/s] of the pole,
    by the names of the joints ``foot_joint`` and ``pole_joint``. Actions: 0 and 1 lower and raise the
    command by ``pos_step``, 2 and 3 by ten times that. Reward: 1, also for the step in which it falls,
    0 after that. End: the cart outside ``min_base_pose_x`` and ``max_base_pose_x``, or the pole outside
    ``min_pole_angle`` and ``max_pole_angle``. A step lasts ``running_step`` of simulated time.
    """

    space: ClassVar[str] = "cartpole_v0"

    def __init__(self) -> None:
        workspace = self._begin("cartpole_stay_up/stay_up", "cartpole_description")
        self.get_params()
        self.action_space = Discrete(self.n_actions)
        most = np.array(
            [_RAIL, self.max_base_velocity, 2.0 * self.max_pole_angle, self.max_base_velocity],
            np.float32,
        )
        self.observation_space = Box(-most, most)
        self.init_internal_vars(self.init_pos)
        super().__init__(self.control_type, workspace)

    def get_params(self) -> None:
        """Read the parameters."""
        number = self.number
        self.n_actions = int(number("n_actions"))
        self.min_pole_angle = number("min_pole_angle")
        self.max_pole_angle = number("max_pole_angle")
        self.max_base_velocity = number("max_base_velocity")
        self.min_base_pose_x = number("min_base_pose_x")
        self.max_base_pose_x = number("max_base_pose_x")
        self.pos_step = number("pos_step")
        self.running_step = number("running_step")
        self.init_pos = number("init_pos")
        self.wait_time = number("wait_time")
        self.control_type = str(self.parameter("control_type"))

    def _set_init_pose(self) -> None:
        self.check_publishers_connection()
        self.init_internal_vars(self.init_pos)
        self.move_joints(self.pos)

    def _init_env_variables(self) -> None:
        self.steps_beyond_done = None

    def _set_action(self, action: Any) -> None:
        sign = -1.0 if int(action) % 2 == 0 else 1.0
        self.pos[0] += sign * self.pos_step * (_FAST if int(action) >= 2 else 1.0)
        self.move_joints(self.pos)
        self.simulated_time.wait(self.running_step)

    def _get_obs(self) -> np.ndarray[Any, np.dtype[np.float64]]:
        return np.array([*self.joint("foot_joint"), *self.joint("pole_joint")])

    def _is_done(self, observations: Any) -> bool:
        places = (self.min_base_pose_x, self.max_base_pose_x)
        angles = (self.min_pole_angle, self.max_pole_angle)
        return bool(has_fallen(one(observations), places, angles)[0])

    def _compute_reward(self, observations: Any, done: bool) -> float:  # noqa: FBT001  # openai_ros' interface
        del observations
        if not done:
            return 1.0
        if self.steps_beyond_done is None:
            self.steps_beyond_done = 0
            return 1.0
        if self.steps_beyond_done == 0:
            rospy.logwarn("the episode is over: call reset() before the next step()")
        self.steps_beyond_done += 1
        return 0.0
