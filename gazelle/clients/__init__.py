"""Clients for any ROS 1 graph with Gazebo's interfaces: Gazelle's, a real Gazebo's, a robot's.

::

    from gazelle.clients import Driver, Gazebo, SimulatorProcess

    with SimulatorProcess("turtlebot3_world", robots=["turtlebot3_burger"]) as simulator:
        simulator.gazebo.pause()
"""

from gazelle.clients.agv import AGV, AGVFleet
from gazelle.clients.arm_services import ArmCommander
from gazelle.clients.controllers import Controllers
from gazelle.clients.descriptions import load_parameters, load_urdf, read_urdf
from gazelle.clients.errors import ClientError
from gazelle.clients.gazebo import Gazebo
from gazelle.clients.hosting import SimulatorProcess
from gazelle.clients.joint_commands import JointCommander
from gazelle.clients.motion import Driver
from gazelle.clients.performance import PerformanceWatch, Sample
from gazelle.clients.physics import PhysicsSettings
from gazelle.clients.poses import ModelState
from gazelle.clients.processes import Processes
from gazelle.clients.spawning import spawn_robot
from gazelle.clients.states import LiveStates
from gazelle.clients.trajectories import (
    JointWaypoint,
    TrajectoryClient,
    TrajectoryOutcome,
    TrajectoryProgress,
    TrajectoryRun,
)

__all__ = [
    "AGV",
    "AGVFleet",
    "ArmCommander",
    "ClientError",
    "Controllers",
    "Driver",
    "Gazebo",
    "JointCommander",
    "JointWaypoint",
    "LiveStates",
    "ModelState",
    "PerformanceWatch",
    "PhysicsSettings",
    "Processes",
    "Sample",
    "SimulatorProcess",
    "TrajectoryClient",
    "TrajectoryOutcome",
    "TrajectoryProgress",
    "TrajectoryRun",
    "load_parameters",
    "load_urdf",
    "read_urdf",
    "spawn_robot",
]
