"""Launch files of ROS 1: read them, and run what they ask for."""

from gazelle.ros.launch.errors import (
    LaunchError,
    MissingArgumentError,
    MissingPackageError,
    SubstitutionError,
)
from gazelle.ros.launch.loader import load_launch, load_launch_text
from gazelle.ros.launch.packages import Packages
from gazelle.ros.launch.plan import (
    Action,
    Argument,
    Command,
    LaunchPlan,
    Machine,
    NodePlan,
    Parameter,
    TestPlan,
)

__all__ = [
    "Action",
    "Argument",
    "Command",
    "LaunchError",
    "LaunchPlan",
    "Machine",
    "MissingArgumentError",
    "MissingPackageError",
    "NodePlan",
    "Packages",
    "Parameter",
    "SubstitutionError",
    "TestPlan",
    "load_launch",
    "load_launch_text",
]
