"""Robot simulation and reinforcement learning in one package.

The names here are the ones to start with; each subpackage has its own::

    import gazelle

    world = gazelle.load("my_world.world")
    with gazelle.Simulation(world) as sim:
        robot = sim.spawn("robot.urdf.xacro", name="r1")
        sim.run(seconds=2.0)

Nothing heavy is imported until it is used.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from gazelle.bridges import serve_ros
    from gazelle.description import Pose, World
    from gazelle.errors import (
        ControlError,
        EngineError,
        Error,
        FormatError,
        MissingExtraError,
        PlanningError,
        ResolveError,
        RosError,
        SimulationError,
        TaskError,
    )
    from gazelle.formats import load
    from gazelle.simulation import Simulation

__version__ = "0.1.0.dev0"

_HOMES = {
    "ControlError": "gazelle.errors",
    "EngineError": "gazelle.errors",
    "Error": "gazelle.errors",
    "FormatError": "gazelle.errors",
    "MissingExtraError": "gazelle.errors",
    "PlanningError": "gazelle.errors",
    "Pose": "gazelle.description",
    "ResolveError": "gazelle.errors",
    "RosError": "gazelle.errors",
    "Simulation": "gazelle.simulation",
    "SimulationError": "gazelle.errors",
    "TaskError": "gazelle.errors",
    "World": "gazelle.description",
    "load": "gazelle.formats",
    "serve_ros": "gazelle.bridges",
}

__all__ = [
    "ControlError",
    "EngineError",
    "Error",
    "FormatError",
    "MissingExtraError",
    "PlanningError",
    "Pose",
    "ResolveError",
    "RosError",
    "Simulation",
    "SimulationError",
    "TaskError",
    "World",
    "__version__",
    "load",
    "serve_ros",
]


def __getattr__(name: str) -> Any:
    """Import a public name from its subpackage on first use."""
    if name in _HOMES:
        value = getattr(importlib.import_module(_HOMES[name]), name)
        globals()[name] = value
        return value
    raise AttributeError(f"module 'gazelle' has no attribute '{name}'")


def __dir__() -> list[str]:
    return __all__
