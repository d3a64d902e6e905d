"""gym as it was up to 0.21: ``reset`` returns an observation, ``step`` four values.

Spaces, errors and the environments that come with gym are Gymnasium's.
"""

from __future__ import annotations

from gazelle.drop_in.gym import envs, error, logger, spaces, utils, vector, wrappers
from gazelle.drop_in.gym.core import (
    ActionWrapper,
    Env,
    GoalEnv,
    ObservationWrapper,
    RewardWrapper,
    Wrapper,
)
from gazelle.drop_in.gym.envs.registration import make, register, spec
from gazelle.drop_in.gym.places import PLACES, finding
from gazelle.drop_in.gym.spaces import Space

VERSION = __version__ = "0.21.0"

__all__ = [
    "PLACES",
    "VERSION",
    "ActionWrapper",
    "Env",
    "GoalEnv",
    "ObservationWrapper",
    "RewardWrapper",
    "Space",
    "Wrapper",
    "envs",
    "error",
    "logger",
    "make",
    "register",
    "spaces",
    "spec",
    "utils",
    "vector",
    "wrappers",
]

__getattr__ = finding("")
