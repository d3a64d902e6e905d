"""Modules of gym that are elsewhere here: scripts import from them, whatever lies where."""

from __future__ import annotations

import importlib
from collections.abc import Callable
from types import ModuleType

_HERE = "gazelle.drop_in.gym"
_SPACES = (
    "box", "dict", "dict_space", "discrete", "multi_binary", "multi_discrete", "space", "tuple",
    "tuple_space",
)  # fmt: skip
_TRANSFORMS = (
    "clip_action", "flatten_observation", "record_episode_statistics", "rescale_action",
    "transform_observation", "transform_reward",
)  # fmt: skip
_STACKING = (
    "dict", "filter_observation", "frame_stack", "order_enforcing", "time_aware_observation",
)  # fmt: skip
_CLASSIC = ("acrobot", "cartpole", "continuous_mountain_car", "mountain_car", "pendulum")
_TOYS = ("blackjack", "cliffwalking", "frozen_lake", "taxi")
_VECTOR = ("async_vector_env", "sync_vector_env", "vector_env", "vector_env_wrapper")
_VECTOR_TOOLS = ("misc", "numpy_utils", "shared_memory", "spaces")

PLACES = {
    **{f"spaces.{name}": "gymnasium.spaces" for name in _SPACES},
    "spaces.utils": "gymnasium.spaces.utils",
    **{f"wrappers.{name}": f"{_HERE}.wrappers.transforms" for name in _TRANSFORMS},
    **{f"wrappers.{name}": f"{_HERE}.wrappers.stacking" for name in _STACKING},
    "wrappers.monitoring": f"{_HERE}.wrappers.monitor",
    "utils.colorize": "gymnasium.utils.colorize",
    "utils.ezpickle": "gymnasium.utils.ezpickle",
    **{f"vector.{name}": f"{_HERE}.vector" for name in _VECTOR},
    "vector.utils": "gymnasium.vector.utils",
    **{f"vector.utils.{name}": "gymnasium.vector.utils" for name in _VECTOR_TOOLS},
    "envs.classic_control": f"{_HERE}.envs.own",
    **{f"envs.classic_control.{name}": f"{_HERE}.envs.own" for name in _CLASSIC},
    "envs.toy_text": f"{_HERE}.envs.own",
    **{f"envs.toy_text.{name}": f"{_HERE}.envs.own" for name in _TOYS},
    "version": _HERE,
}
"""From a module's name below ``gym`` to the module that has what it had."""


def finding(package: str) -> Callable[[str], ModuleType]:
    """Return the ``__getattr__`` of a package below gym, for ``from gym.wrappers import frame_stack``."""

    def find(name: str) -> ModuleType:
        place = PLACES.get(f"{package}.{name}".lstrip("."))
        if place is None:
            raise AttributeError(f"module 'gym.{package}' has no attribute '{name}'")
        return importlib.import_module(place)

    return find
