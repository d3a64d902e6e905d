"""One running set of worlds: clock, requests, spawn and delete, sensors, plugins and ports."""

from gazelle.simulation.clock import Clock, Schedule
from gazelle.simulation.faults import Fault
from gazelle.simulation.handles import JointHandle, LinkHandle
from gazelle.simulation.parameters import WorldParameters
from gazelle.simulation.physics import PhysicsProperties
from gazelle.simulation.plugin import ModelPlugin, Plugin, SensorPlugin, WorldPlugin
from gazelle.simulation.ports import JointStates, Odometry, Output, TwistInput
from gazelle.simulation.recording import Recorder
from gazelle.simulation.registry import register
from gazelle.simulation.replay import Replay
from gazelle.simulation.robot import Robot
from gazelle.simulation.sensors import SensorUnit
from gazelle.simulation.simulation import Simulation

__all__ = [
    "Clock",
    "Fault",
    "JointHandle",
    "JointStates",
    "LinkHandle",
    "ModelPlugin",
    "Odometry",
    "Output",
    "PhysicsProperties",
    "Plugin",
    "Recorder",
    "Replay",
    "Robot",
    "Schedule",
    "SensorPlugin",
    "SensorUnit",
    "Simulation",
    "TwistInput",
    "WorldParameters",
    "WorldPlugin",
    "register",
]
