"""Policies on ROS 1: a node without torch that drives a simulated or a real robot.

`DeployNode` is the node, `Pilot` decides without any ROS, and a guard, a process of its own, holds
the topic of commands and stops the robot however the node ends.
"""

from gazelle.training.deploy.goals import GoalOutcome, GoalPlace, read_goals
from gazelle.training.deploy.node import DeployNode
from gazelle.training.deploy.pilot import Pilot
from gazelle.training.deploy.policies import Policy, open_policy
from gazelle.training.deploy.safety import SafetyLimits
from gazelle.training.deploy.sensing import OdometryReading, ScanReading

__all__ = [
    "DeployNode",
    "GoalOutcome",
    "GoalPlace",
    "OdometryReading",
    "Pilot",
    "Policy",
    "SafetyLimits",
    "ScanReading",
    "open_policy",
    "read_goals",
]
