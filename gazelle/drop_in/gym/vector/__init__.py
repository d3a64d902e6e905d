"""Several environments as one, stepped one after the other: ``gym.vector`` of gym 0.21."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np
from gymnasium.vector.utils import batch_space, concatenate, create_empty_array

from gazelle.drop_in.gym.core import Env, Wrapper
from gazelle.drop_in.gym.envs.registration import make as make_one
from gazelle.drop_in.gym.error import Error
from gazelle.drop_in.gym.places import finding


class VectorEnv(Env):
    """Environments with equal spaces; an episode that ends begins again at once.

    Args:
        env_fns: Make the environments.
    """

    def __init__(self, env_fns: Iterable[Callable[[], Any]], **_: Any) -> None:
        self.envs = [make() for make in env_fns]
        if not self.envs:
            raise Error("a vector environment has at least one environment")
        self.num_envs = len(self.envs)
        self.single_observation_space = self.envs[0].observation_space
        self.single_action_space = self.envs[0].action_space
        self.observation_space = batch_space(self.single_observation_space, self.num_envs)
        self.action_space = batch_space(self.single_action_space, self.num_envs)
        self.is_vector_env = True

    def seed(self, seed: int | Iterable[int] | None = None) -> None:
        """Set the seeds of the environments: one each, or one and those after it."""
        if seed is None or isinstance(seed, int):
            seeds = [None if seed is None else seed + place for place in range(self.num_envs)]
        else:
            seeds = list(seed)
        for env, each in zip(self.envs, seeds, strict=True):
            env.seed(each)

    def reset(self) -> Any:
        """Start an episode in each; returns the observations, one a row."""
        return self._joined([env.reset() for env in self.envs])

    def step(self, action: Any) -> Any:
        """Step each environment.

        Returns:
            Observations, rewards, whether each episode ended, and a list of dictionaries; where one
            ended the observation is the next episode's, and ``terminal_observation`` is there.
        """
        seen, rewards, ends, infos = [], [], [], []
        for env, own in zip(self.envs, action, strict=True):
            observation, reward, done, info = env.step(own)
            if done:
                info["terminal_observation"] = observation
                observation = env.reset()
            seen.append(observation)
            rewards.append(reward)
            ends.append(done)
            infos.append(info)
        return self._joined(seen), np.array(rewards, float), np.array(ends, bool), infos

    def close(self) -> None:
        """Close the environments."""
        for env in self.envs:
            env.close()

    def _joined(self, observations: list[Any]) -> Any:
        space = self.single_observation_space
        rows: Any = create_empty_array(space, self.num_envs)
        return concatenate(space, observations, rows)


class VectorEnvWrapper(Wrapper):
    """A vector environment around another one, which answers whatever this one does not."""


SyncVectorEnv = AsyncVectorEnv = VectorEnv
"""Both step in this process: results are the same."""


def make(id: str, num_envs: int = 1, asynchronous: bool = True, **options: Any) -> VectorEnv:  # noqa: A002, FBT001, FBT002
    """Return several environments of a name as one."""
    del asynchronous
    return VectorEnv([lambda: make_one(id, **options) for _ in range(num_envs)])


__getattr__ = finding("vector")
