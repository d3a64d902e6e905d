"""Motion planning for arms: planning scenes, plans and trajectories, without ROS.

``Group`` plans for a robot in a running simulation; all other classes work on descriptions.
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
from gazelle.planning.scene import PlanningScene
from gazelle.planning.scene_contact import SceneContact
from gazelle.planning.scene_objects import AttachedObject, SceneObject, voxel_boxes
from gazelle.planning.time_parameterization import PathLimits, TimedPath, parameterize

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
    "JointConstraint",
    "JumpLimits",
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
    "SceneContact",
    "SceneObject",
    "TimedPath",
    "box_grasps",
    "goal_of_pose",
    "octree_object",
    "parameterize",
    "voxel_boxes",
]
