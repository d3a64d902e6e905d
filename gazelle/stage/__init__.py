"""Stage worlds that run: fleets of robots in the plane."""

from pathlib import Path

from gazelle.native import search_path

__path__ = search_path([str(Path(__file__).parent)])

from gazelle.stage.actuators import Actuator
from gazelle.stage.cameras import CameraPictures, MountedCamera, cameras_of
from gazelle.stage.controllers import register_controller, with_wander
from gazelle.stage.finders import Blob, Fiducial
from gazelle.stage.fleet import StageFleet
from gazelle.stage.fleet_controller import FleetController
from gazelle.stage.grippers import COMMANDS, Gripper, GripperState
from gazelle.stage.robots import Ranger, StageRobot
from gazelle.stage.simulation import StageSimulation, stage_of

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
