"""Base of Stable-Baselines3's ``VecEnv`` over copies that are one object."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt
from gymnasium import spaces
from stable_baselines3.common.vec_env import VecEnv


class SharedVecEnv(VecEnv):  # type: ignore[misc]  # untyped base
    """Copies of an environment that share its attributes, and step at once.

    Args:
        num_envs: Number of copies.
        observation_space: Space of a copy's observations.
        action_space: Space of a copy's actions.
        shared: Object whose attributes and methods the copies share; by default this one.
    """

    def __init__(
        self,
        num_envs: int,
        observation_space: spaces.Space[Any],
        action_space: spaces.Space[Any],
        shared: object = None,
    ) -> None:
        self._shared = self if shared is None else shared
        self._seed: int | None = None
        self._actions: npt.NDArray[Any] = np.zeros(0)
        super().__init__(num_envs, observation_space, action_space)

    def seed(self, seed: int | None = None) -> Sequence[int | None]:
        """Store the seed for the next reset."""
        self._seed = seed
        return [seed] * self.num_envs

    def step_async(self, actions: npt.NDArray[Any]) -> None:
        """Store the actions of the next step."""
        self._actions = actions

    def get_attr(self, attr_name: str, indices: Any = None) -> list[Any]:
        """Return an attribute of the environment, once for each requested copy."""
        value = getattr(self._shared, attr_name, None)
        return [value for _ in self._get_indices(indices)]

    def set_attr(self, attr_name: str, value: Any, indices: Any = None) -> None:
        """Set an attribute of the environment; the copies share it."""
        del indices
        setattr(self._shared, attr_name, value)

    def env_method(
        self, method_name: str, *method_args: Any, indices: Any = None, **method_kwargs: Any
    ) -> list[Any]:
        """Call a method of the environment once; the copies share the result."""
        result = getattr(self._shared, method_name)(*method_args, **method_kwargs)
        return [result for _ in self._get_indices(indices)]

    def env_is_wrapped(self, wrapper_class: type[Any], indices: Any = None) -> list[bool]:
        """Return False for each copy: single copies are not wrapped."""
        del wrapper_class
        return [False for _ in self._get_indices(indices)]
