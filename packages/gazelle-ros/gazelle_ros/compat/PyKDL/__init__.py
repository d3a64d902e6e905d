"""PyKDL's frames, chains, trees and kinematics; dynamics (inertias, wrenches of chains) are not here."""

from gazelle_ros.compat.PyKDL.arrays import Jacobian, JntArray
from gazelle_ros.compat.PyKDL.chain import Chain, Joint, Segment, Tree
from gazelle_ros.compat.PyKDL.difference import addDelta, diff
from gazelle_ros.compat.PyKDL.frame import Frame
from gazelle_ros.compat.PyKDL.motion import Twist, Wrench
from gazelle_ros.compat.PyKDL.rotation import Rotation
from gazelle_ros.compat.PyKDL.solvers import (
    ChainFkSolverPos_recursive,
    ChainIkSolverPos_LMA,
    ChainIkSolverPos_NR,
    ChainIkSolverPos_NR_JL,
    ChainIkSolverVel_pinv,
    ChainJntToJacSolver,
)
from gazelle_ros.compat.PyKDL.vector import Vector, dot

__all__ = [
    "Chain",
    "ChainFkSolverPos_recursive",
    "ChainIkSolverPos_LMA",
    "ChainIkSolverPos_NR",
    "ChainIkSolverPos_NR_JL",
    "ChainIkSolverVel_pinv",
    "ChainJntToJacSolver",
    "Frame",
    "Jacobian",
    "JntArray",
    "Joint",
    "Rotation",
    "Segment",
    "Tree",
    "Twist",
    "Vector",
    "Wrench",
    "addDelta",
    "diff",
    "dot",
]
