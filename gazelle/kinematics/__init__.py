"""Forward kinematics, Jacobians and inverse kinematics of trees of joints.

`RobotModel` is a robot with its groups and variables; `InverseKinematics` finds joint positions
of a group for a pose.
"""

from __future__ import annotations

from pathlib import Path

from gazelle.native import search_path

__path__ = search_path([str(Path(__file__).parent)])

from gazelle.kinematics.inverse import IkSolutions, InverseKinematics
from gazelle.kinematics.joint_group import JointModelGroup
from gazelle.kinematics.pointing import Pointing
from gazelle.kinematics.robot_model import RobotModel
from gazelle.kinematics.robot_tree import LinkFrame
from gazelle.kinematics.variables import JointBounds, Variable

__all__ = [
    "IkSolutions",
    "InverseKinematics",
    "JointBounds",
    "JointModelGroup",
    "LinkFrame",
    "Pointing",
    "RobotModel",
    "Variable",
]
