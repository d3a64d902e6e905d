"""Parameters and totals that openai_ros' tasks on a graph have in common."""

from __future__ import annotations

from typing import Any, ClassVar

from gazelle.array_types import Floats
from gazelle.drop_in.gym.core import Env
from gazelle.drop_in.gym.spaces import Discrete
from gazelle.drop_in.openai_ros.task_envs.task_commons import begin_task
from gazelle_ros.compat import rospy


class GraphTask(Env):
    """Part of a task: its parameters on the graph, and sums of rewards.

    Attributes:
        space: Namespace of its parameters.
        cumulated_reward: Sum of the episode's rewards.
        cumulated_steps: Number of steps of all episodes.
    """

    space: ClassVar[str]
    cumulated_reward = 0.0
    cumulated_steps = 0.0

    def _begin(
        self, file: str, package: str, launch_file: str = "start_world.launch"
    ) -> str | None:
        """Start the task's world and take its actions; returns the workspace, see `begin_task`."""
        workspace = begin_task(self.space, file, package, launch_file)
        self.action_space = Discrete(int(self.parameter("n_actions")))
        return workspace

    def parameter(self, name: str) -> Any:
        """Return a parameter of the task.

        Raises:
            KeyError: It is not set.
        """
        return rospy.get_param(f"/{self.space}/{name}")

    def number(self, name: str) -> float:
        """Return a parameter as a number."""
        return float(self.parameter(name))

    def _count(self, reward: Floats) -> float:
        """Add a reward, shape (1,), to those of the episode, and return it."""
        value = float(reward.item())
        self.cumulated_reward += value
        self.cumulated_steps += 1
        return value
