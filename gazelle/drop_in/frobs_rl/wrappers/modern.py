"""Environments of the old gym among those of Gymnasium."""

from __future__ import annotations

from typing import Any

import gymnasium

from gazelle.drop_in.gym.adapted import OldInterface
from gazelle.drop_in.gym.core import Env
from gazelle.drop_in.shimmy import GymV21CompatibilityV0


class EitherGymApi:
    """A wrapper that has the interface of what it is around: the old gym's, or Gymnasium's."""

    def __new__(cls, env: Any, *arguments: Any, **options: Any) -> Any:
        """Create the wrapper; around an old environment, with the old interface around it."""
        if isinstance(env, Env):
            kind: Any = cls
            return OldInterface(kind(modern(env), *arguments, **options))
        return super().__new__(cls)


def modern(env: Any) -> gymnasium.Env[Any, Any]:
    """Return an environment with Gymnasium's interface, whichever it has.

    Scripts for frobs_rl of old make theirs by ``gym.make``.
    """
    if isinstance(env, OldInterface):
        return env.env
    if isinstance(env, Env):
        return GymV21CompatibilityV0(env=env)
    made: gymnasium.Env[Any, Any] = env
    return made
