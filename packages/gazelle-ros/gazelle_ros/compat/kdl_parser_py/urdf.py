"""``treeFromFile`` and its like: whether a tree could be made, and the tree."""
# ruff: noqa: N802 - the names are kdl_parser's

from __future__ import annotations

from pathlib import Path
from typing import Any

from gazelle_ros.base.errors import RosError
from gazelle_ros.base.text_files import read_text
from gazelle_ros.compat.PyKDL import Frame, Joint, Rotation, Segment, Tree, Vector
from gazelle_ros.robot.tree import MOVABLE, JointTree, TreeJoint, read_joints


def treeFromFile(filename: str) -> tuple[bool, Tree | None]:
    """Return the tree of a URDF file."""
    return treeFromString(read_text(Path(filename)))


def treeFromParam(param: str) -> tuple[bool, Tree | None]:
    """Return the tree of the URDF in a parameter."""
    from gazelle_ros.compat import rospy

    return treeFromString(rospy.get_param(param))


def treeFromUrdfModel(robot_model: Any, quiet: bool = False) -> tuple[bool, Tree | None]:  # noqa: FBT001, FBT002
    """Return the tree of a robot of ``urdf_parser_py``."""
    del quiet
    return treeFromString(robot_model.to_xml_string())


def treeFromString(xml: str) -> tuple[bool, Tree | None]:
    """Return the tree of URDF text."""
    try:
        joints = read_joints(xml)
    except RosError:
        return False, None
    roots = root_links(joints)
    if len(roots) != 1:
        return False, None
    tree = Tree(roots[0])
    waiting = list(joints.values())
    while waiting:
        left = [joint for joint in waiting if not tree.addSegment(segment_of(joint), joint.parent)]
        if len(left) == len(waiting):
            return False, None
        waiting = left
    return True, tree


def root_links(joints: JointTree) -> list[str]:
    """Return the links that no joint moves, in the order of the file."""
    moved = {joint.child for joint in joints.values()}
    return [each for each in dict.fromkeys(j.parent for j in joints.values()) if each not in moved]


def segment_of(joint: TreeJoint) -> Segment:
    """Return the segment of a joint and the link that it moves."""
    frame = Frame(Rotation.Quaternion(*joint.rotation), Vector(*joint.translation))
    if joint.kind not in MOVABLE:
        return Segment(joint.child, Joint(joint.name, Joint.Fixed), frame)
    kind = Joint.TransAxis if joint.kind == "prismatic" else Joint.RotAxis
    axis = frame.M * Vector(*joint.axis)
    return Segment(joint.child, Joint(joint.name, frame.p, axis, kind), frame)
