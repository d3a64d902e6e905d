"""gym as it was up to 0.21: ``reset`` returns an observation, ``step`` four values.

Spaces, errors and the environments that come with gym are Gymnasium's.
"""

from __future__ import annotations

from gazelle.compat.gym import envs, error, logger, spaces, utils, vector, wrappers
from gazelle.compat.gym.core import (
    ActionWrapper,
    Env,
    GoalEnv,
    ObservationWrapper,
    RewardWrapper,
    Wrapper,
)
from gazelle.compat.gym.envs.registration import make, register, spec
from gazelle.compat.gym.places import PLACES, finding
from gazelle.compat.gym.spaces import Space

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
