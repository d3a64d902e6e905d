"""The layer that talks to the simulator, for tasks with goals (openai_ros 1)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from gazelle.drop_in.gym.core import GoalEnv, Step
from gazelle.drop_in.openai_ros.controllers_connection import ControllersConnection
from gazelle.drop_in.openai_ros.gazebo_connection import WORLD, GazeboConnection
from gazelle.drop_in.openai_ros.graph_env import GraphEnv


class RobotGazeboEnv(GraphEnv, GoalEnv):
    """An environment with goals and a robot on a ROS 1 graph.

    Observations are dictionaries with ``observation``, ``achieved_goal`` and ``desired_goal``. Unlike in
    `robot_gazebo_env`, time continues between steps, every step's reward is published, a reset
    puts back the models only, and the physics is left as it is.

    Args:
        robot_name_space: Of the robot's controllers; empty for none.
        controllers_list: Controllers that are reset with every episode.
        reset_controls: Whether it is.
    """

    def __init__(
        self,
        robot_name_space: str,
        controllers_list: Sequence[str] | None,
        reset_controls: bool,  # noqa: FBT001  # openai_ros' interface
    ) -> None:
        super().__init__(
            GazeboConnection(start_init_physics_parameters=False, reset_world_or_sim=WORLD),
            ControllersConnection(robot_name_space, controllers_list or ()),
            reset_controls=reset_controls,
        )

    def step(self, action: Any) -> Step:
        """Apply an action.

        Returns observation, reward, whether the episode is over, and no info.
        """
        self.gazebo.unpauseSim()
        self._set_action(action)
        observation = self._get_obs()
        done = self._is_done(observation)
        reward = self._compute_reward(observation, done)
        self.cumulated_episode_reward += float(reward)
        self._publish_reward_topic(float(reward), self.episode_num)
        return observation, reward, done, {}

    def _reset_sim(self) -> bool:
        """Move the robot to its start, and reset the models."""
        self._begin_motion()
        self._set_init_pose()
        if self.reset_controls:
            self.gazebo.pauseSim()
            self.gazebo.resetSim()
        else:
            self.gazebo.resetWorld()
        self._begin_motion()
        if self.reset_controls:
            self.gazebo.pauseSim()
        return True

    def _init_env_variables(self) -> Any:
        """Initialise the variables of an episode."""
