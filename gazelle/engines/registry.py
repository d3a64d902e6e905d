"""Find an engine by its name.

MuJoCo and the planar engine come with Gazelle, and MuJoCo Warp where its package is installed. Any package adds another by an entry point of the group
``gazelle.engines``, named as in ``Simulation(..., engine="name")``, that gives a class or
function to be called as ``make_engine`` is, less the name. A program adds its own with
``register``. What it gives must do all that ``Engine`` says; nothing else of Gazelle changes.
"""

from __future__ import annotations

from typing import Protocol

from gazelle.description import World
from gazelle.engines.engine import Engine
from gazelle.errors import EngineError, did_you_mean
from gazelle_ros.base.entry_points import entry_points_of_others, load

_GROUP = "gazelle.engines"


class EngineFactory(Protocol):
    """Makes an engine; see ``make_engine`` for the arguments."""

    def __call__(
        self, world: World, nworld: int, *, time_step: float | None, threads: int | None
    ) -> Engine:
        """Create an engine that runs copies of a world."""


_registered: dict[str, EngineFactory] = {}


def register(name: str, factory: EngineFactory) -> None:
    """Register an engine under a name; it precedes an installed one of that name."""
    _registered[name] = factory


def names() -> tuple[str, ...]:
    """Return the names of all available engines."""
    return tuple(sorted({*_BUILT_IN, *_registered, *entry_points_of_others(_GROUP)}))


def find(name: str) -> EngineFactory:
    """Return the factory of the engine of a name.

    Raises:
        EngineError: There is none, or its package cannot be imported.
    """
    if name in _registered:
        return _registered[name]
    if name in _BUILT_IN:
        return _BUILT_IN[name]
    known = entry_points_of_others(_GROUP)
    if name not in known:
        raise EngineError(f"there is no engine '{name}'", hint=did_you_mean(name, names()))
    factory: EngineFactory = load(known[name], f"the engine '{name}'", EngineError)
    return factory


def _mujoco(world: World, nworld: int, *, time_step: float | None, threads: int | None) -> Engine:
    from gazelle.engines.mujoco import MujocoEngine

    return MujocoEngine(world, nworld, time_step=time_step, threads=threads, late=True)


def _planar(world: World, nworld: int, *, time_step: float | None, threads: int | None) -> Engine:
    from gazelle.engines.planar import PlanarEngine

    return PlanarEngine(world, nworld, time_step=time_step, threads=threads)


def _mujoco_warp(
    world: World, nworld: int, *, time_step: float | None, threads: int | None
) -> Engine:
    from gazelle.engines.mujoco.warp import WarpEngine

    return WarpEngine(world, nworld, time_step=time_step, threads=threads, late=True)


_BUILT_IN: dict[str, EngineFactory] = {
    "mujoco": _mujoco,
    "mujoco-warp": _mujoco_warp,
    "planar": _planar,
}
