"""``check_env``: whether an environment keeps gym's rules."""

from __future__ import annotations

from typing import Any

import gymnasium
import numpy as np

from gazelle.drop_in.gym.error import Error


def check_env(env: Any, warn: bool = True, skip_render_check: bool = True) -> None:  # noqa: FBT001, FBT002
    """Check spaces, the first observation and one step.

    Raises:
        Error: One of them breaks gym's interface.
    """
    del warn, skip_render_check
    for name in ("observation_space", "action_space"):
        if not isinstance(getattr(env, name, None), gymnasium.Space):
            raise Error(f"{type(env).__name__} has no {name} from gym.spaces")
    _check_observation(env, env.reset(), "reset()")
    result = env.step(env.action_space.sample())
    if not isinstance(result, tuple) or len(result) != 4:
        raise Error("step() returns four values: observation, reward, done, info")
    observation, reward, done, info = result
    _check_observation(env, observation, "step()")
    if not isinstance(reward, int | float | np.integer | np.floating):
        raise Error(f"the reward is a number, not {type(reward).__name__}")
    if not isinstance(done, bool | np.bool_):
        raise Error(f"done is a bool, not {type(done).__name__}")
    if not isinstance(info, dict):
        raise Error(f"info is a dictionary, not {type(info).__name__}")


def _check_observation(env: Any, observation: Any, where: str) -> None:
    if not env.observation_space.contains(observation):
        raise Error(f"the observation of {where} is not in {env.observation_space}")
