"""Every type of controller that Gazelle has: one row each."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from gazelle.control.interfaces import (
    EFFORT,
    JOINT_STATE,
    POS_VEL,
    POS_VEL_ACC,
    POSITION,
    VELOCITY,
)


@dataclass(frozen=True, slots=True)
class KnownController:
    """A row: where the class is, and what it needs of a robot.

    Attributes:
        code: ``module:Class`` in this package.
        interfaces: That the robot must have.
    """

    code: str
    interfaces: tuple[str, ...]


# fmt: off
_FORWARD = "forward:ForwardCommandController"
_GROUP = "forward:ForwardGroupController"
_TRAJECTORY = "trajectory_controller:JointTrajectoryController"
CONTROLLERS: Mapping[str, KnownController] = {
    "joint_state_controller/JointStateController": KnownController("joint_state:JointStateController", (JOINT_STATE,)),
    "effort_controllers/JointEffortController": KnownController(_FORWARD, (EFFORT,)),
    "position_controllers/JointPositionController": KnownController(_FORWARD, (POSITION,)),
    "velocity_controllers/JointVelocityController": KnownController(_FORWARD, (VELOCITY,)),
    "effort_controllers/JointGroupEffortController": KnownController(_GROUP, (EFFORT,)),
    "position_controllers/JointGroupPositionController": KnownController(_GROUP, (POSITION,)),
    "velocity_controllers/JointGroupVelocityController": KnownController(_GROUP, (VELOCITY,)),
    "position_controllers/JointTrajectoryController": KnownController(_TRAJECTORY, (POSITION,)),
    "velocity_controllers/JointTrajectoryController": KnownController(_TRAJECTORY, (VELOCITY,)),
    "effort_controllers/JointTrajectoryController": KnownController(_TRAJECTORY, (EFFORT,)),
    "pos_vel_controllers/JointTrajectoryController": KnownController(_TRAJECTORY, (POS_VEL,)),
    "pos_vel_acc_controllers/JointTrajectoryController": KnownController(_TRAJECTORY, (POS_VEL_ACC,)),
}
# fmt: on
