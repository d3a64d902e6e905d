"""Deployment of policies: a ROS 1 node without torch that drives a simulated or real robot.

`DeployNode` is the node and `Pilot` its ROS-free control loop. A separate guard process publishes
the commands, and stops the robot when the node ends. Names are imported on first use, so that the
guard starts quickly.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from gazelle.training.deploy.goals import GoalPlace, GoalResult, read_goals
    from gazelle.training.deploy.node import DeployNode
    from gazelle.training.deploy.pilot import Pilot
    from gazelle.training.deploy.policies import Policy, open_policy
    from gazelle.training.deploy.safety import SafetyLimits, VelocityCommand
    from gazelle.training.deploy.sensing import OdometryReading, ScanReading

_HOMES = {
    "DeployNode": "node",
    "GoalResult": "goals",
    "GoalPlace": "goals",
    "OdometryReading": "sensing",
    "Pilot": "pilot",
    "Policy": "policies",
    "SafetyLimits": "safety",
    "ScanReading": "sensing",
    "VelocityCommand": "safety",
    "open_policy": "policies",
    "read_goals": "goals",
}

__all__ = [
    "DeployNode",
    "GoalPlace",
    "GoalResult",
    "OdometryReading",
    "Pilot",
    "Policy",
    "SafetyLimits",
    "ScanReading",
    "VelocityCommand",
    "open_policy",
    "read_goals",
]


def __getattr__(name: str) -> Any:
    """Import a public name from its module on first use."""
    if name not in _HOMES:
        raise AttributeError(f"module 'gazelle.training.deploy' has no attribute '{name}'")
    value = getattr(importlib.import_module(f"gazelle.training.deploy.{_HOMES[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return __all__
