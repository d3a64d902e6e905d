"""Stage worlds that run: fleets of robots in the plane."""

from pathlib import Path

from gazelle.native import search_path

__path__ = search_path([str(Path(__file__).parent)])

from gazelle.engines.stage_robots import Ranger, StageRobot
from gazelle.simulation.stage.actuators import Actuator
from gazelle.simulation.stage.cameras import CameraPictures, MountedCamera, cameras_of
from gazelle.simulation.stage.controllers import register_controller, with_wander
from gazelle.simulation.stage.finders import Blob, Fiducial
from gazelle.simulation.stage.fleet import StageFleet
from gazelle.simulation.stage.fleet_controller import FleetController
from gazelle.simulation.stage.grippers import COMMANDS, Gripper, GripperState
from gazelle.simulation.stage.simulation import StageSimulation, stage_of

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
    "StageRobot",
    "StageSimulation",
    "cameras_of",
    "register_controller",
    "stage_of",
    "with_wander",
]
