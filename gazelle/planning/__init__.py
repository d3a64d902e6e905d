"""Arms: groups of joints, kinematics, planning scenes, plans and trajectories, without ROS.

``Group`` plans for a robot in a running simulation; all below it works on descriptions alone.
"""

from __future__ import annotations

from pathlib import Path

from gazelle.native import search_path

__path__ = search_path([str(Path(__file__).parent)])

from gazelle.planning.allowed_collisions import AllowedCollisionMatrix
from gazelle.planning.cartesian_path import CartesianPath, JumpLimits
from gazelle.planning.constraints import (
    ConstraintSet,
    JointConstraint,
    OrientationConstraint,
    PositionConstraint,
    goal_of_pose,
)
from gazelle.planning.execution import Execution, ExecutionReport
from gazelle.planning.grasps import (
    Grasp,
    GripperTranslation,
    ParallelHand,
    PlaceLocation,
    box_grasps,
)
from gazelle.planning.gripper import GripperReport, RobotGripper
from gazelle.planning.group import Group, GroupPlan
from gazelle.planning.inverse import IkSolutions, InverseKinematics
from gazelle.planning.joint_group import JointModelGroup
from gazelle.planning.manipulation import Manipulation
from gazelle.planning.manipulation_plan import (
    ContactRules,
    ManipulationPlan,
    ManipulationStage,
)
from gazelle.planning.motion_planner import MotionPlan, MotionPlanner, PlanOptions
from gazelle.planning.octomaps import OCTOMAP, octree_object
from gazelle.planning.outcomes import NoPlanError, PlanOutcome
from gazelle.planning.pick_place import PickPlacePlanner
from gazelle.planning.robot_model import RobotModel
from gazelle.planning.scene import PlanningScene, SceneContact
from gazelle.planning.scene_objects import AttachedObject, SceneObject, voxel_boxes
from gazelle.planning.time_parameterization import PathLimits, TimedPath, parameterize
from gazelle.planning.tree_builder import LinkFrame
from gazelle.planning.variables import JointBounds, Variable

__all__ = [
    "OCTOMAP",
    "AllowedCollisionMatrix",
    "AttachedObject",
    "CartesianPath",
    "ConstraintSet",
    "ContactRules",
    "Execution",
    "ExecutionReport",
    "Grasp",
    "GripperReport",
    "GripperTranslation",
    "Group",
    "GroupPlan",
    "IkSolutions",
    "InverseKinematics",
    "JointBounds",
    "JointConstraint",
    "JointModelGroup",
    "JumpLimits",
    "LinkFrame",
    "Manipulation",
    "ManipulationPlan",
    "ManipulationStage",
    "MotionPlan",
    "MotionPlanner",
    "NoPlanError",
    "OrientationConstraint",
    "ParallelHand",
    "PathLimits",
    "PickPlacePlanner",
    "PlaceLocation",
    "PlanOptions",
    "PlanOutcome",
    "PlanningScene",
    "PositionConstraint",
    "RobotGripper",
    "RobotModel",
    "SceneContact",
    "SceneObject",
    "TimedPath",
    "Variable",
    "box_grasps",
    "goal_of_pose",
    "octree_object",
    "parameterize",
    "voxel_boxes",
]
