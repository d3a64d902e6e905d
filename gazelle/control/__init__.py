"""Joint controllers as in ros_control: hardware interfaces, controllers and their manager, without ROS."""

from pathlib import Path

from gazelle.native import search_path

__path__ = search_path([str(Path(__file__).parent)])

from gazelle.control.controller import Controller, ControllerSetup
from gazelle.control.goals import ActionPort, Goal, GoalState
from gazelle.control.hardware import ControllerInfo, RobotHardware, SwitchResult
from gazelle.control.interfaces import (
    EFFORT,
    FORCE_TORQUE,
    IMU,
    JOINT_STATE,
    POS_VEL,
    POS_VEL_ACC,
    POSITION,
    VELOCITY,
    HardwareInterface,
    JointCommandInterface,
    JointHandles,
    JointStateInterface,
    SensorInterface,
    cpp_name,
)
from gazelle.control.manager import BASE_CLASS, ControllerManager, Strictness
from gazelle.control.parameters import ControllerParameters
from gazelle.control.ports import CommandPort, QueryPort, StatePort, TunableValue, TuningPort
from gazelle.control.registry import register, types
from gazelle.control.switching import LoadedController, Switch

__all__ = [
    "BASE_CLASS",
    "EFFORT",
    "FORCE_TORQUE",
    "IMU",
    "JOINT_STATE",
    "POSITION",
    "POS_VEL",
    "POS_VEL_ACC",
    "VELOCITY",
    "ActionPort",
    "CommandPort",
    "Controller",
    "ControllerInfo",
    "ControllerManager",
    "ControllerParameters",
    "ControllerSetup",
    "Goal",
    "GoalState",
    "HardwareInterface",
    "JointCommandInterface",
    "JointHandles",
    "JointStateInterface",
    "LoadedController",
    "QueryPort",
    "RobotHardware",
    "SensorInterface",
    "StatePort",
    "Strictness",
    "Switch",
    "SwitchResult",
    "TunableValue",
    "TuningPort",
    "cpp_name",
    "register",
    "types",
]
