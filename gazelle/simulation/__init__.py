"""Running simulations: clock, lock, spawning and deleting of models, sensors, plugins and ports."""

from gazelle.engines import Placement
from gazelle.simulation.base_plugin import BasePlugin
from gazelle.simulation.clock import Clock, Schedule, Stopwatch
from gazelle.simulation.divergence import Fault
from gazelle.simulation.joint_array import JointArray
from gazelle.simulation.joint_motion import JointMotion
from gazelle.simulation.joints import JointHandle
from gazelle.simulation.link_array import LinkArray
from gazelle.simulation.links import LinkHandle
from gazelle.simulation.parameters import WorldParameters
from gazelle.simulation.physics import PhysicsProperties
from gazelle.simulation.plugin import (
    ModelPlugin,
    SensorPlugin,
    SystemPlugin,
    VisualPlugin,
    WorldPlugin,
)
from gazelle.simulation.plugin_system import PluginSystem, PublisherSystem
from gazelle.simulation.plugin_table import KnownPlugin
from gazelle.simulation.ports import FramePrefix, Input, Output, Ports, Service, TwistInput
from gazelle.simulation.recording import Recorder
from gazelle.simulation.registry import register
from gazelle.simulation.replay import Replay
from gazelle.simulation.robot import Robot, SensorUnit
from gazelle.simulation.sensors import SensorOutput
from gazelle.simulation.settings import Setting, Tuning
from gazelle.simulation.simulation import Simulation
from gazelle.simulation.topics import absolute, namespace_of
from gazelle.simulation.values import JointStates, Odometry, Transform, Transforms, WrenchValue
from gazelle_ros.base.tuned_fields import Tunable

__all__ = [
    "BasePlugin",
    "Clock",
    "Fault",
    "FramePrefix",
    "Input",
    "JointArray",
    "JointHandle",
    "JointMotion",
    "JointStates",
    "KnownPlugin",
    "LinkArray",
    "LinkHandle",
    "ModelPlugin",
    "Odometry",
    "Output",
    "PhysicsProperties",
    "Placement",
    "PluginSystem",
    "Ports",
    "PublisherSystem",
    "Recorder",
    "Replay",
    "Robot",
    "Schedule",
    "SensorOutput",
    "SensorPlugin",
    "SensorUnit",
    "Service",
    "Setting",
    "Simulation",
    "Stopwatch",
    "SystemPlugin",
    "Transform",
    "Transforms",
    "Tunable",
    "Tuning",
    "TwistInput",
    "VisualPlugin",
    "WorldParameters",
    "WorldPlugin",
    "WrenchValue",
    "absolute",
    "namespace_of",
    "register",
]
