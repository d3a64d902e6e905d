"""Launch files of ROS 1: read and run them."""

from gazelle_ros.launch.errors import (
    LaunchError,
    MissingArgumentError,
    MissingPackageError,
    SubstitutionError,
)
from gazelle_ros.launch.loader import load_launch, load_launch_text
from gazelle_ros.launch.packages import Packages
from gazelle_ros.launch.plan import (
    Action,
    Argument,
    LaunchMachine,
    LaunchParameter,
    LaunchPlan,
    NodePlan,
    ParameterCommand,
    TestPlan,
)

__all__ = [
    "Action",
    "Argument",
    "LaunchError",
    "LaunchMachine",
    "LaunchParameter",
    "LaunchPlan",
    "MissingArgumentError",
    "MissingPackageError",
    "NodePlan",
    "Packages",
    "ParameterCommand",
    "SubstitutionError",
    "TestPlan",
    "load_launch",
    "load_launch_text",
]
