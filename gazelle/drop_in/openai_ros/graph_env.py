"""Common base of environments with and without goals: the graph, and the order of an episode."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from gazelle.drop_in.gym.core import Env
from gazelle.drop_in.gym.utils import seeding
from gazelle.drop_in.openai_ros.controllers_connection import ControllersConnection
from gazelle.drop_in.openai_ros.gazebo_connection import GazeboConnection
from gazelle_ros.compat import rospy
from gazelle_ros.msgs import openai_ros

REWARD_TOPIC = "/openai/reward"


class GraphEnv(Env):
    """An environment with a robot on a ROS 1 graph.

    Args:
        gazebo: The simulator.
        controllers: The robot's controllers.
        reset_controls: Whether they are reset with every episode.
    """

    def __init__(
        self,
        gazebo: GazeboConnection,
        controllers: ControllersConnection,
        *,
        reset_controls: bool,
    ) -> None:
        self.gazebo = gazebo
        self.controllers_object = controllers
        self.reset_controls = reset_controls
        self.np_random: np.random.RandomState | None = None
        self.seed()
        self.episode_num = 0
        self.cumulated_episode_reward = 0.0
        self._info = openai_ros.msg.RLExperimentInfo
        self.reward_pub = rospy.Publisher(REWARD_TOPIC, self._info, queue_size=1)

    def seed(self, seed: int | None = None) -> list[int]:
        """Set the seed of ``np_random``."""
        self.np_random, used = seeding.np_random(seed)
        return [used]

    def reset(self) -> Any:
        """Start an episode; returns the first observation."""
        self._reset_sim()
        self._init_env_variables()
        self._update_episode()
        return self._get_obs()

    def close(self) -> None:
        """Shut the script's node down."""
        rospy.signal_shutdown("the environment is closed")

    # -- what happens around an episode ---------------------------------------------------------

    def _update_episode(self) -> None:
        """Count."""
        self.episode_num += 1
        self.cumulated_episode_reward = 0.0

    def _publish_reward_topic(self, reward: float, episode_number: int = 1) -> None:
        """Publish a reward."""
        self.reward_pub.publish(
            self._info(episode_number=episode_number, episode_reward=float(reward))
        )

    def _reset_sim(self) -> bool:
        """Move the robot to its start, and reset what is configured."""
        raise NotImplementedError

    def _begin_motion(self) -> None:
        """Unpause, with controllers and sensors that answer."""
        self.gazebo.unpauseSim()
        if self.reset_controls:
            self.controllers_object.reset_controllers()
        self._check_all_systems_ready()

    # -- overridden by subclasses --------------------------------------------------------------------

    def _set_init_pose(self) -> Any:
        """Move the robot to its initial pose."""
        raise NotImplementedError

    def _check_all_systems_ready(self) -> Any:
        """Wait until sensors and controllers answer."""
        raise NotImplementedError

    def _get_obs(self) -> Any:
        """Return the present observation."""
        raise NotImplementedError

    def _init_env_variables(self) -> Any:
        """Initialise the variables of an episode."""
        raise NotImplementedError

    def _set_action(self, action: Any) -> Any:
        """Apply an action."""
        raise NotImplementedError

    def _is_done(self, observations: Any) -> bool:
        """Return whether the episode is over."""
        raise NotImplementedError

    def _compute_reward(self, observations: Any, done: bool) -> float:  # noqa: FBT001  # openai_ros' interface
        """Return the reward of the last action."""
        raise NotImplementedError

    def _env_setup(self, initial_qpos: Mapping[str, float]) -> Any:
        """Prepare the robot, once."""
        raise NotImplementedError
