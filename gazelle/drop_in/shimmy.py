"""Replacement of ``shimmy`` for Stable-Baselines3: old gym environments with Gymnasium's interface."""

from __future__ import annotations

from typing import Any

import gymnasium

from gazelle.drop_in.gym.core import Env

Result = tuple[Any, float, bool, bool, dict[str, Any]]


class GymV21CompatibilityV0(gymnasium.Env[Any, Any]):
    """An old environment: ``reset`` returns two values, ``step`` five.

    Args:
        env_id: Makes it by name, if ``env`` is None.
        make_kwargs: For ``gym.make``.
        env: With the old interface.
        render_mode: Output of ``render``.
    """

    def __init__(
        self,
        env_id: str | None = None,
        make_kwargs: dict[str, Any] | None = None,
        env: Any = None,
        render_mode: str | None = None,
    ) -> None:
        if env is None:
            from gazelle.drop_in.gym.envs.registration import make

            env = make(str(env_id), **(make_kwargs or {}))
        self.gym_env: Env = env
        self.render_mode = render_mode
        self.metadata = dict(env.metadata)
        self.observation_space = env.observation_space
        self.action_space = env.action_space

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Any, dict[str, Any]]:
        """Start an episode; returns the first observation and an empty dictionary."""
        del options
        super().reset(seed=seed)
        if seed is not None:
            self.gym_env.seed(seed)
        return self.gym_env.reset(), {}

    def step(self, action: Any) -> Result:
        """Step the environment; an end by a time limit is a truncation."""
        observation, reward, done, info = self.gym_env.step(action)
        truncated = bool(done and info.get("TimeLimit.truncated", False))
        return observation, float(reward), bool(done) and not truncated, truncated, info

    def render(self) -> Any:
        """Render it by ``render_mode``."""
        return None if self.render_mode is None else self.gym_env.render(mode=self.render_mode)

    def close(self) -> None:
        """Close the environment."""
        self.gym_env.close()
