"""Environments that come with gym, as classes with its interface: Gymnasium's."""

from __future__ import annotations

from typing import Any

import gymnasium
from gymnasium.envs import classic_control, toy_text

from gazelle.drop_in.gym.adapted import OldInterface


def _old(kind: type[gymnasium.Env[Any, Any]]) -> type[OldInterface]:
    """Return a class that makes an environment of Gymnasium with the old interface."""

    class Adapted(OldInterface):
        def __init__(self, *arguments: Any, **options: Any) -> None:
            super().__init__(kind(*arguments, **options))

    Adapted.__name__ = Adapted.__qualname__ = kind.__name__
    Adapted.__doc__ = kind.__doc__
    return Adapted


AcrobotEnv = _old(classic_control.AcrobotEnv)
CartPoleEnv = _old(classic_control.CartPoleEnv)
Continuous_MountainCarEnv = _old(classic_control.Continuous_MountainCarEnv)
MountainCarEnv = _old(classic_control.MountainCarEnv)
PendulumEnv = _old(classic_control.PendulumEnv)
BlackjackEnv = _old(toy_text.BlackjackEnv)
CliffWalkingEnv = _old(toy_text.CliffWalkingEnv)
FrozenLakeEnv = _old(toy_text.FrozenLakeEnv)
TaxiEnv = _old(toy_text.TaxiEnv)
