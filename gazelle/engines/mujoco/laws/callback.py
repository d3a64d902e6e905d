"""The one function that MuJoCo calls in every step of every model of this process."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import mujoco

from gazelle.engines.mujoco.laws.kernel import apply
from gazelle.engines.native import c_function
from gazelle.errors import EngineError


def install() -> None:
    """Let MuJoCo call it, from now on.

    Raises:
        EngineError: Another program in this process has MuJoCo's callback.
    """
    mine, present = _function(), mujoco.get_mjcb_control()
    if present is None:
        mujoco.set_mjcb_control(mine)
    elif present is not mine:
        raise EngineError(
            "something else in this process uses MuJoCo's callback mjcb_control",
            hint="motors, bounces, friction by direction and bodies that tumble need it",
        )


@lru_cache(maxsize=1)
def _function() -> Any:
    """The compiled function, as MuJoCo takes it: of the addresses of a model and its data."""
    return c_function(apply, 2)
