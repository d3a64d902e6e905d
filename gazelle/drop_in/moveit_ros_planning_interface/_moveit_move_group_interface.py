"""The module that ``moveit_commander.move_group`` stands on in MoveIt."""

from __future__ import annotations

from typing import Any, ClassVar

from gazelle.drop_in.moveit_client.byte_interface import ByteInterface
from gazelle.drop_in.moveit_commander.move_group import MoveGroupCommander

__all__ = ["MoveGroupInterface"]

_FROM = "set_joint_value_target_from_"


class MoveGroupInterface(ByteInterface):
    """Plans and moves a group; its setters return success, and raise nothing."""

    client: ClassVar[type[Any]] = MoveGroupCommander
    takes: ClassVar = {
        f"{_FROM}joint_state_message": ("sensor_msgs/JointState",),
        f"{_FROM}pose": ("geometry_msgs/Pose",),
        f"{_FROM}pose_stamped": ("geometry_msgs/PoseStamped",),
        "async_execute": ("moveit_msgs/RobotTrajectory",),
        "compute_cartesian_path": ("moveit_msgs/Constraints",),
        "enforce_bounds": ("moveit_msgs/RobotState",),
        "execute": ("moveit_msgs/RobotTrajectory",),
        "pick": ("moveit_msgs/Grasp",),
        "place": ("moveit_msgs/PlaceLocation",),
        "place_locations_list": ("moveit_msgs/PlaceLocation",),
        "place_poses_list": ("geometry_msgs/PoseStamped",),
        "retime_trajectory": ("moveit_msgs/RobotState", "moveit_msgs/RobotTrajectory"),
        "set_path_constraints_from_msg": ("moveit_msgs/Constraints",),
        "set_start_state": ("moveit_msgs/RobotState",),
        "set_trajectory_constraints_from_msg": ("moveit_msgs/TrajectoryConstraints",),
    }
    names: ClassVar = {
        f"{_FROM}joint_state_message": "_set_joint_state",
        f"{_FROM}pose": "_set_joints_by",
        f"{_FROM}pose_stamped": "_set_joints_by_stamped",
        "async_execute": "_async_execute",
        "execute": "_execute",
        "get_current_pose": "_current_pose",
        "get_current_rpy": "_current_rpy",
        "get_current_state_bounded": "_bounded_positions",
        "get_random_pose": "_random_pose",
        "limit_max_cartesian_link_speed": "_limit_link_speed",
        "place_locations_list": "place",
        "place_poses_list": "place",
        "plan": "_plan",
        "set_end_effector_link": "_set_link",
        "set_joint_value_target": "_set_joints",
        "set_max_acceleration_scaling_factor": "_set_acceleration_factor",
        "set_max_velocity_scaling_factor": "_set_velocity_factor",
        "set_named_target": "_set_named",
        "set_orientation_target": "_set_orientation",
        "set_path_constraints": "_use_stored",
        "set_path_constraints_from_msg": "set_path_constraints",
        "set_pose_target": "_set_pose",
        "set_pose_targets": "_set_each_pose",
        "set_position_target": "_set_position",
        "set_rpy_target": "_set_rpy",
        "set_trajectory_constraints_from_msg": "set_trajectory_constraints",
        "set_workspace": "_set_workspace",
    }
