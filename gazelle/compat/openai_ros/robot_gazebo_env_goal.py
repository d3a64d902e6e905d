"""The layer that talks to the simulator, for tasks with goals (openai_ros 1)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from gazelle.compat.gym.core import GoalEnv, Step
from gazelle.compat.gym.utils import seeding
from gazelle.compat.openai_ros.controllers_connection import ControllersConnection
from gazelle.compat.openai_ros.gazebo_connection import WORLD, GazeboConnection
from gazelle.compat.openai_ros.robot_gazebo_env import REWARD_TOPIC
from gazelle.ros import load_message
from gazelle.ros.compat import rospy


class RobotGazeboEnv(GoalEnv):
    """An environment with goals whose robot is on a ROS 1 graph.

    Observations are dictionaries with ``observation``, ``achieved_goal`` and ``desired_goal``. Unlike in
    `robot_gazebo_env`, time goes on between steps, every step's reward is published, a reset
    puts back the models only, and the physics is left as it is.

    Args:
        robot_name_space: Of the robot's controllers; empty for none.
        controllers_list: What is reset with every episode.
        reset_controls: Whether it is.
    """

    def __init__(
        self,
        robot_name_space: str,
        controllers_list: Sequence[str] | None,
        reset_controls: bool,  # noqa: FBT001  # openai_ros' interface
    ) -> None:
        self.gazebo = GazeboConnection(
            start_init_physics_parameters=False, reset_world_or_sim=WORLD
        )
        self.controllers_object = ControllersConnection(robot_name_space, controllers_list or ())
        self.reset_controls = reset_controls
        self.np_random: np.random.RandomState | None = None
        self.seed()
        self.episode_num = 0
        self.cumulated_episode_reward = 0.0
        self._info: Any = load_message("openai_ros/RLExperimentInfo")
        self.reward_pub = rospy.Publisher(REWARD_TOPIC, self._info, queue_size=1)

    def seed(self, seed: int | None = None) -> list[int]:
        """Decide the random numbers of ``np_random``."""
        self.np_random, used = seeding.np_random(seed)
        return [used]

    def step(self, action: Any) -> Step:
        """Do an action; returns observation, reward, whether the episode is over, and nothing more."""
        self.gazebo.unpauseSim()
        self._set_action(action)
        observation = self._get_obs()
        done = self._is_done(observation)
        reward = self._compute_reward(observation, done)
        self.cumulated_episode_reward += float(reward)
        self._publish_reward_topic(float(reward), self.episode_num)
        return observation, reward, done, {}

    def reset(self) -> Any:
        """Begin an episode; returns the first observation."""
        self._reset_sim()
        self._init_env_variables()
        self._update_episode()
        return self._get_obs()

    def close(self) -> None:
        """End the node of the script."""
        rospy.signal_shutdown("the environment is closed")

    def _publish_reward_topic(self, reward: float, episode_number: int = 1) -> None:
        """Publish a reward."""
        self.reward_pub.publish(
            self._info(episode_number=episode_number, episode_reward=float(reward))
        )

    def _update_episode(self) -> None:
        """Count."""
        self.episode_num += 1
        self.cumulated_episode_reward = 0.0

    def _reset_sim(self) -> bool:
        """Bring the robot to its beginning, and put the models back."""
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

    def _begin_motion(self) -> None:
        """Let time go on, with controllers and sensors that answer."""
        self.gazebo.unpauseSim()
        if self.reset_controls:
            self.controllers_object.reset_controllers()
        self._check_all_systems_ready()

    # -- what subclasses say --------------------------------------------------------------------

    def _set_init_pose(self) -> Any:
        """Bring the robot into the pose that it begins with."""
        raise NotImplementedError

    def _check_all_systems_ready(self) -> Any:
        """Wait until sensors and controllers answer."""
        raise NotImplementedError

    def _get_obs(self) -> Any:
        """What is seen now."""
        raise NotImplementedError

    def _init_env_variables(self) -> Any:
        """Begin the variables of an episode."""

    def _set_action(self, action: Any) -> Any:
        """Do an action."""
        raise NotImplementedError

    def _is_done(self, observations: Any) -> bool:
        """Whether the episode is over."""
        raise NotImplementedError

    def _compute_reward(self, observations: Any, done: bool) -> float:  # noqa: FBT001  # openai_ros' interface
        """What the last action is worth."""
        raise NotImplementedError

    def _env_setup(self, initial_qpos: Mapping[str, float]) -> Any:
        """Prepare the robot, once."""
        raise NotImplementedError
