"""Stage worlds: readers of their files, and their simulation in the planar engine.

Modules are imported on first use, so that reading a file does not import the engine.
"""

from __future__ import annotations

import importlib
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gazelle.native import search_path

if TYPE_CHECKING:
    from gazelle.stage.actuators import Actuator
    from gazelle.stage.cameras import CameraPictures, MountedCamera, cameras_of
    from gazelle.stage.controllers import register_controller, with_wander
    from gazelle.stage.description import StageModel, StageWorld, stage_model, stage_world
    from gazelle.stage.finders import Blob, Fiducial
    from gazelle.stage.fleet import StageFleet
    from gazelle.stage.fleet_controller import FleetController
    from gazelle.stage.format import load_stage
    from gazelle.stage.grippers import COMMANDS, Gripper, GripperState
    from gazelle.stage.robots import Ranger, StageRobot
    from gazelle.stage.simulation import StageSimulation, stage_of

__path__ = search_path([str(Path(__file__).parent)])

_HOMES = {
    "COMMANDS": "grippers",
    "Actuator": "actuators",
    "Blob": "finders",
    "CameraPictures": "cameras",
    "Fiducial": "finders",
    "FleetController": "fleet_controller",
    "Gripper": "grippers",
    "GripperState": "grippers",
    "MountedCamera": "cameras",
    "Ranger": "robots",
    "StageFleet": "fleet",
    "StageModel": "description",
    "StageRobot": "robots",
    "StageSimulation": "simulation",
    "StageWorld": "description",
    "cameras_of": "cameras",
    "load_stage": "format",
    "register_controller": "controllers",
    "stage_model": "description",
    "stage_of": "simulation",
    "stage_world": "description",
    "with_wander": "controllers",
}

__all__ = [
    "COMMANDS",
    "Actuator",
    "Blob",
    "CameraPictures",
    "Fiducial",
    "FleetController",
    "Gripper",
    "GripperState",
    "MountedCamera",
    "Ranger",
    "StageFleet",
    "StageModel",
    "StageRobot",
    "StageSimulation",
    "StageWorld",
    "cameras_of",
    "load_stage",
    "register_controller",
    "stage_model",
    "stage_of",
    "stage_world",
    "with_wander",
]


def __getattr__(name: str) -> Any:
    """Import a public name from its module on first use."""
    if name in _HOMES:
        value = getattr(importlib.import_module(f"{__name__}.{_HOMES[name]}"), name)
        globals()[name] = value
        return value
    raise AttributeError(f"module '{__name__}' has no attribute '{name}'")


def __dir__() -> list[str]:
    return __all__
