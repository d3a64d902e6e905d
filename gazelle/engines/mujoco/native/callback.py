"""The one function that MuJoCo calls in every step of every model of this process."""

from __future__ import annotations

import ctypes
from functools import lru_cache
from typing import Any

import mujoco
import numba
from numba.core import types

from gazelle.engines.mujoco.native.kernel import apply
from gazelle.engines.mujoco.native.layouts import offsets
from gazelle.errors import EngineError

_AT = offsets()


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
            hint="bounces, friction by direction and bodies that tumble in free fall need it",
        )


@lru_cache(maxsize=1)
def _function() -> Any:
    """The compiled function, as MuJoCo takes it."""

    @numba.cfunc(types.void(types.int64, types.int64))  # type: ignore[untyped-decorator]
    def call(model: int, data: int) -> None:
        apply(model, data, _AT)

    return ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_void_p)(call.address)
