"""Every type of controller that Gazelle has: one row each."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from gazelle.control.interfaces import (
    EFFORT,
    FORCE_TORQUE,
    IMU,
    JOINT_STATE,
    POS_VEL,
    POS_VEL_ACC,
    POSITION,
    VELOCITY,
)


@dataclass(frozen=True, slots=True)
class KnownController:
    """A controller type: its class, and the interfaces it requires.

    Attributes:
        code: ``module:Class`` in this package.
        interfaces: Interfaces that the robot must have.
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
    "imu_sensor_controller/ImuSensorController": KnownController("sensor_controllers:ImuSensorController", (IMU,)),
    "force_torque_sensor_controller/ForceTorqueSensorController": KnownController("sensor_controllers:ForceTorqueSensorController", (FORCE_TORQUE,)),
    "effort_controllers/JointPositionController": KnownController("joint_pid:JointPositionController", (EFFORT,)),
    "velocity_controllers/JointPositionController": KnownController("joint_pid:JointPositionController", (VELOCITY,)),
    "effort_controllers/JointVelocityController": KnownController("joint_pid:JointVelocityController", (EFFORT,)),
    "effort_controllers/JointGroupPositionController": KnownController("joint_pid:JointGroupPositionController", (EFFORT,)),
    "position_controllers/GripperActionController": KnownController("gripper:GripperActionController", (POSITION,)),
    "effort_controllers/GripperActionController": KnownController("gripper:GripperActionController", (EFFORT,)),
    "robot_controllers/ParallelGripperController": KnownController("parallel_gripper:ParallelGripperController", (EFFORT,)),
    "diff_drive_controller/DiffDriveController": KnownController("diff_drive_controller:DiffDriveController", (VELOCITY,)),
    "ackermann_steering_controller/AckermannSteeringController": KnownController("ackermann:AckermannSteeringController", (VELOCITY, POSITION)),
    "four_wheel_steering_controller/FourWheelSteeringController": KnownController("four_wheel:FourWheelSteeringController", (VELOCITY, POSITION)),
    "mecanum_drive_controller/MecanumDriveController": KnownController("mecanum:MecanumDriveController", (VELOCITY,)),
}
# fmt: on
