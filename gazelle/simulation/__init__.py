"""One running set of worlds: clock, requests, spawn and delete, sensors, plugins and ports."""

from gazelle.simulation.clock import Clock, Schedule
from gazelle.simulation.plugin import ModelPlugin, Plugin, SensorPlugin, WorldPlugin
from gazelle.simulation.ports import JointStates, Odometry, Output, TwistInput
from gazelle.simulation.registry import register
from gazelle.simulation.robot import JointHandle, LinkHandle, Robot
from gazelle.simulation.sensors import SensorUnit
from gazelle.simulation.simulation import Simulation

__all__ = [
    "Clock",
    "JointHandle",
    "JointStates",
    "LinkHandle",
    "ModelPlugin",
    "Odometry",
    "Output",
    "Plugin",
    "Robot",
    "Schedule",
    "SensorPlugin",
    "SensorUnit",
    "Simulation",
    "TwistInput",
    "WorldPlugin",
    "register",
]
