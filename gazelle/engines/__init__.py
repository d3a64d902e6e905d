"""Physics engines: the ``Engine`` protocol and its implementations."""

from __future__ import annotations

from gazelle.description import World
from gazelle.engines.engine import PARAMETERS, DivergenceError, Engine
from gazelle.engines.history import CHANGES, Call
from gazelle.engines.motion import Hits, Motion, Placement
from gazelle.engines.range_rays import RangeRays
from gazelle.engines.reactions import Contacts, ContactTable, Wrench
from gazelle.engines.registry import EngineFactory, find
from gazelle.engines.registry import names as engine_names
from gazelle.engines.registry import register as register_engine

__all__ = [
    "CHANGES",
    "PARAMETERS",
    "Call",
    "ContactTable",
    "Contacts",
    "DivergenceError",
    "Engine",
    "EngineFactory",
    "Hits",
    "Motion",
    "Placement",
    "RangeRays",
    "Wrench",
    "engine_names",
    "make_engine",
    "register_engine",
]


def make_engine(
    name: str,
    world: World,
    nworld: int = 1,
    *,
    time_step: float | None = None,
    threads: int | None = None,
    late: bool = False,
) -> Engine:
    """Create an engine by name.

    Args:
        name: ``mujoco``, ``planar``, or another of ``engine_names``.
        world: World to simulate.
        nworld: Number of copies.
        time_step: Physics step [s]; the world's own if None.
        threads: Native threads; all processors if None.
        late: Leave it to the caller to ``prepare`` an engine that can wait for that.

    Raises:
        EngineError: There is no such engine, or it cannot simulate the world.
    """
    engine = find(name)(world, nworld, time_step=time_step, threads=threads)
    if not late:
        engine.prepare()
    return engine
