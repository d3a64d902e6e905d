"""The one function that MuJoCo calls in every step of every model of this process."""

from __future__ import annotations

import ctypes
import warnings
from functools import lru_cache
from typing import Any

import mujoco

from gazelle.engines.mujoco.contact_laws import kernel
from gazelle.engines.mujoco.contact_laws.struct_layout import offsets
from gazelle.engines.mujoco.contact_laws.struct_offsets import fill
from gazelle.errors import EngineError, EngineWarning


def install(*, vital: bool) -> None:
    """Install MuJoCo's control callback.

    Args:
        vital: Whether there is need of more than that what slides stays down.

    Raises:
        EngineError: Another program in this process has MuJoCo's callback, and it is vital.
    """
    mine, present = _function(), mujoco.get_mjcb_control()
    if present is None:
        mujoco.set_mjcb_control(mine)
    elif present is not mine:
        what = "something else in this process uses MuJoCo's callback mjcb_control"
        if vital:
            raise EngineError(
                what,
                hint="motors, controllers, bounces and friction by direction need it",
            )
        warnings.warn(
            EngineWarning(
                f"{what}: sliding bodies may hop, spinning bodies gain energy, and overlapping bodies are pushed out fast"
            ),
            stacklevel=2,
        )


@lru_cache(maxsize=1)
def _function() -> Any:
    """Return the compiled function in MuJoCo's form: of the addresses of a model and its data."""
    fill(offsets())
    made = ctypes.CFUNCTYPE(None, ctypes.c_size_t, ctypes.c_size_t)
    return made(kernel.address() or kernel.apply)
