"""The layer that talks to the simulator: what happens in a step and in a reset, in which order."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from gazelle.drop_in.gym.core import Step
from gazelle.drop_in.openai_ros.controllers_connection import ControllersConnection
from gazelle.drop_in.openai_ros.gazebo_connection import SIMULATION, GazeboConnection
from gazelle.drop_in.openai_ros.graph_env import GraphEnv
from gazelle.drop_in.openai_ros.simulated_time import SimulatedTime


class RobotGazeboEnv(GraphEnv):
    """An environment with a robot on a ROS 1 graph.

    A step unpauses, applies the action, pauses, and observes. After every episode
    ``openai_ros/RLExperimentInfo`` with its number and reward is published on ``/openai/reward``.
    Subclasses override the methods that raise `NotImplementedError` here.

    Args:
        robot_name_space: Of the robot's controllers; empty for none.
        controllers_list: Controllers that are reset with every episode.
        reset_controls: Whether it is.
        start_init_physics_parameters: See `GazeboConnection`.
        reset_world_or_sim: See `GazeboConnection`.

    Attributes:
        gazebo: The simulator.
        controllers_object: The controllers.
        np_random: Random numbers, after `seed`.
        episode_num: Number of finished episodes.
        cumulated_episode_reward: Of the episode so far.
    """

    def __init__(
        self,
        robot_name_space: str,
        controllers_list: Sequence[str] | None,
        reset_controls: bool,  # noqa: FBT001  # openai_ros' interface
        start_init_physics_parameters: bool = True,  # noqa: FBT001, FBT002
        reset_world_or_sim: str = SIMULATION,
    ) -> None:
        super().__init__(
            GazeboConnection(start_init_physics_parameters, reset_world_or_sim),
            ControllersConnection(robot_name_space, controllers_list or ()),
            reset_controls=reset_controls,
        )
        self.simulated_time = SimulatedTime()

    def step(self, action: Any) -> Step:
        """Apply an action.

        Returns observation, reward, whether the episode is over, and no info.
        """
        self.gazebo.unpauseSim()
        self._set_action(action)
        self.gazebo.pauseSim()
        observation = self._get_obs()
        done = self._is_done(observation)
        reward = self._compute_reward(observation, done)
        self.cumulated_episode_reward += reward
        return observation, reward, done, {}

    def _update_episode(self) -> None:
        """Publish what the last episode came to, and count."""
        self._publish_reward_topic(self.cumulated_episode_reward, self.episode_num)
        super()._update_episode()

    def _reset_sim(self) -> bool:
        """Move the robot to its start, and reset the simulator."""
        self._begin_motion()
        self._set_init_pose()
        self.gazebo.pauseSim()
        self.gazebo.resetSim()
        self._begin_motion()
        self.gazebo.pauseSim()
        return True
