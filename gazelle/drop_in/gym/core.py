"""Environments and wrappers with the interface of gym up to 0.21.

``reset()`` returns the observation alone, ``step(action)`` four values: observation, reward, whether
the episode is over, and a dictionary. Spaces are Gymnasium's.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import gymnasium
from gymnasium.spaces import Dict, Space

from gazelle.drop_in.gym.error import Error
from gazelle_ros.base.closing import Closeable

__all__ = [
    "ActionWrapper",
    "Env",
    "GoalEnv",
    "ObservationWrapper",
    "RewardWrapper",
    "Space",
    "Step",
    "Wrapper",
]

Step = tuple[Any, Any, bool, dict[str, Any]]
"""Observation, reward, whether the episode is over, and additional information."""


class Env(Closeable):
    """An environment; subclasses define ``step`` and ``reset``, or ``_step`` and ``_reset`` as in gym 0.9.

    Attributes:
        metadata: Such as the modes of ``render``.
        reward_range: Smallest and largest reward.
        spec: Its registration; None if it was made without ``gym.make``.
        action_space: Actions of ``step``.
        observation_space: Observations of ``reset`` and ``step``.
    """

    metadata: Mapping[str, Any] = {"render.modes": []}
    reward_range: tuple[float, float] = (-float("inf"), float("inf"))
    spec: Any = None
    action_space: gymnasium.Space[Any]
    observation_space: gymnasium.Space[Any]

    def step(self, action: Any) -> Step:
        """Step the environment.

        Raises:
            NotImplementedError: The class does not define it.
        """
        result: Step = self._given("_step")(action)
        return result

    def reset(self) -> Any:
        """Start an episode; returns the first observation.

        Raises:
            NotImplementedError: The class does not define it.
        """
        return self._given("_reset")()

    def render(self, mode: str = "human") -> Any:
        """Show it, or return a picture.

        Raises:
            NotImplementedError: The class does not define it.
        """
        return self._given("_render")(mode=mode)

    def close(self) -> None:
        """Close the environment."""
        if hasattr(self, "_close"):
            self._close()

    def seed(self, seed: int | None = None) -> list[int] | None:
        """Set the seed of the random numbers; returns the seeds used."""
        if not hasattr(self, "_seed"):
            return None
        seeds: list[int] | None = self._seed(seed)
        return seeds

    @property
    def unwrapped(self) -> Env:
        """The environment without wrappers."""
        return self

    def _given(self, name: str) -> Any:
        method = getattr(self, name, None)
        if method is None:
            raise NotImplementedError(f"{type(self).__name__} has no {name.removeprefix('_')}")
        return method

    def __str__(self) -> str:
        name = type(self).__name__
        return f"<{name} instance>" if self.spec is None else f"<{name}<{self.spec.id}>>"


class GoalEnv(Env):
    """An environment with dictionaries of the achieved and the desired goal as observations."""

    def reset(self) -> Any:
        """Check the space; subclasses begin the episode then.

        Raises:
            Error: The observations have no ``observation``, ``achieved_goal`` and ``desired_goal``.
        """
        space = getattr(self, "observation_space", None)
        if not isinstance(space, Dict):
            raise Error("a GoalEnv has an observation space of the kind gym.spaces.Dict")
        for key in ("observation", "achieved_goal", "desired_goal"):
            if key not in space.spaces:
                raise Error(f"the observation space of a GoalEnv has '{key}'")
        return None

    def compute_reward(self, achieved_goal: Any, desired_goal: Any, info: Any) -> Any:
        """Return the reward for an achieved goal.

        Raises:
            NotImplementedError: The class does not define it.
        """
        raise NotImplementedError(f"{type(self).__name__} has no compute_reward")


class Wrapper(Env):
    """An environment around another one, which answers whatever this one does not."""

    def __init__(self, env: Any) -> None:
        self.env = env
        self.action_space = env.action_space
        self.observation_space = env.observation_space
        self.reward_range = getattr(env, "reward_range", Env.reward_range)
        self.metadata = getattr(env, "metadata", Env.metadata)
        self.spec = getattr(env, "spec", None)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_") or name == "env":
            raise AttributeError(f"{type(self).__name__} has no {name}")
        return getattr(self.env, name)

    def step(self, action: Any) -> Step:
        """Step the environment."""
        result: Step = self.env.step(action)
        return result

    def reset(self, **options: Any) -> Any:
        """Start an episode; returns the first observation."""
        return self.env.reset(**options)

    def render(self, mode: str = "human", **options: Any) -> Any:
        """Show it, or return a picture."""
        return self.env.render(mode=mode, **options)

    def close(self) -> None:
        """Close the environment."""
        self.env.close()

    def seed(self, seed: int | None = None) -> list[int] | None:
        """Set the seed of the random numbers."""
        seeds: list[int] | None = self.env.seed(seed)
        return seeds

    @property
    def unwrapped(self) -> Env:
        """The environment without wrappers."""
        inner: Env = self.env.unwrapped
        return inner

    def __str__(self) -> str:
        return f"<{type(self).__name__}{self.env}>"


class ObservationWrapper(Wrapper):
    """Changes observations; subclasses define ``observation``."""

    def reset(self, **options: Any) -> Any:
        """Start an episode; returns the first observation."""
        return self.observation(self.env.reset(**options))

    def step(self, action: Any) -> Step:
        """Step the environment."""
        observation, reward, done, info = self.env.step(action)
        return self.observation(observation), reward, done, info

    def observation(self, observation: Any) -> Any:
        """Transform an observation.

        Raises:
            NotImplementedError: The class does not define it.
        """
        return self._given("_observation")(observation)


class RewardWrapper(Wrapper):
    """Changes rewards; subclasses define ``reward``."""

    def step(self, action: Any) -> Step:
        """Step the environment."""
        observation, reward, done, info = self.env.step(action)
        return observation, self.reward(reward), done, info

    def reward(self, reward: Any) -> Any:
        """Transform a reward.

        Raises:
            NotImplementedError: The class does not define it.
        """
        return self._given("_reward")(reward)


class ActionWrapper(Wrapper):
    """Changes actions; subclasses define ``action``."""

    def step(self, action: Any) -> Step:
        """Step the environment."""
        result: Step = self.env.step(self.action(action))
        return result

    def action(self, action: Any) -> Any:
        """Transform an action.

        Raises:
            NotImplementedError: The class does not define it.
        """
        return self._given("_action")(action)

    def reverse_action(self, action: Any) -> Any:
        """Return the original of a transformed action.

        Raises:
            NotImplementedError: The class does not define it.
        """
        return self._given("_reverse_action")(action)
