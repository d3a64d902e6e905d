"""Side effects of MuJoCo on its process, and their suppression."""

from __future__ import annotations

import ctypes
import functools
import sys

import mujoco


@functools.cache
def disable_logging() -> None:
    """Disable MuJoCo's log files and timing; once in a process.

    It would write a log file into the working directory, while faults are raised here. And
    its Python module reads the clock at every stage of every step, for ``MjData.timer``,
    which is a tenth of the time of a step of a small robot. Callers that want those times set
    ``mujoco.set_mjcb_time(None)`` after the first simulation was made, or sets a function
    before; then it is left alone.
    """
    config = mujoco.MjLogConfig.get()
    config.logto_file = False
    config.logto_console = False
    config.set()
    if mujoco.get_mjcb_time() is None:
        _stop_timing()


@functools.cache
def address_of(name: str) -> int:
    """Return the address of a function of MuJoCo's C library, for compiled code that calls it."""
    library = ctypes.CDLL(sys.modules[mujoco.set_mjcb_time.__module__].__file__)
    return ctypes.cast(getattr(library, name), ctypes.c_void_p).value or 0


def address_of_struct(struct: mujoco.MjModel | mujoco.MjData) -> int:
    """Return the address of a model or its data in memory, for compiled code."""
    return int(struct._address)  # noqa: SLF001  the only way to it


def _stop_timing() -> None:
    """Remove MuJoCo's clock, which the Python module has no function for.

    ``mjcb_time`` is a public variable of MuJoCo's C library; a null pointer means no timing.
    Where the library hides it, MuJoCo continues timing itself.
    """
    try:
        library = ctypes.CDLL(sys.modules[mujoco.set_mjcb_time.__module__].__file__)
        clock = ctypes.c_void_p.in_dll(library, "mjcb_time")
    except (OSError, ValueError):
        return
    clock.value = None
