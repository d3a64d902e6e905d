"""How worlds move: the ``Engine`` protocol and the engines that implement it."""

from __future__ import annotations

from gazelle.description import World
from gazelle.engines.engine import (
    CHANGES,
    PARAMETERS,
    Call,
    DivergenceError,
    Engine,
    Hits,
    Motion,
    Placement,
)
from gazelle.engines.reactions import Contacts, Wrench
from gazelle.errors import EngineError, did_you_mean

ENGINES = ("mujoco",)

__all__ = [
    "CHANGES",
    "ENGINES",
    "PARAMETERS",
    "Call",
    "Contacts",
    "DivergenceError",
    "Engine",
    "Hits",
    "Motion",
    "Placement",
    "Wrench",
    "make_engine",
]


def make_engine(
    name: str,
    world: World,
    nworld: int = 1,
    *,
    time_step: float | None = None,
    threads: int | None = None,
) -> Engine:
    """An engine by name.

    Args:
        name: ``mujoco``.
        world: What to simulate.
        nworld: Number of copies.
        time_step: Physics step [s]; the world's own if None.
        threads: Native threads; all processors if None.

    Raises:
        EngineError: There is no such engine, or it cannot simulate the world.
    """
    if name not in ENGINES:
        raise EngineError(f"there is no engine '{name}'", hint=did_you_mean(name, ENGINES))
    from gazelle.engines.mujoco import MujocoEngine

    return MujocoEngine(world, nworld, time_step=time_step, threads=threads)
