"""Names of the joints that a robot controller moves."""

from __future__ import annotations

from gazelle_ros.builtin.robot import described_joints
from gazelle_ros.errors import RosError
from gazelle_ros.node import Node
from gazelle_ros.robot import JointTree

_PARAMETER = "controller_joint_names"


def given_joints(node: Node) -> list[str] | None:
    """Return the parameter ``controller_joint_names`` of a node's namespace, or None.

    Raises:
        RosError: It is not a list of names.
    """
    found = node.get_param(_PARAMETER, None)
    if found is None:
        return None
    if not isinstance(found, list) or not all(isinstance(each, str) for each in found):
        raise RosError(f"the parameter '{_PARAMETER}' must be a list of names, not {found!r:.60}")
    return found


def controller_joints(node: Node) -> list[str]:
    """Return the given joints, else those of the chain that is the described robot.

    Joints without a name, which the controller does not have, are left out.

    Raises:
        RosError: There are none, or the robot is no chain.
    """
    given = given_joints(node)
    return [each for each in given if each] if given else _chain(described_joints(node))


def _chain(joints: JointTree) -> list[str]:
    """Return the joints that move, from the first link to the last.

    Raises:
        RosError: Two of them branch.
    """
    parents = {joint.child: joint for joint in joints.values()}
    depths: dict[int, str] = {}
    for name, joint in joints.items():
        if joint.kind == "fixed":
            continue
        depth, link = 0, joint.parent
        while link in parents:
            depth += parents[link].kind != "fixed"
            link = parents[link].parent
        if depth in depths:
            raise RosError(
                f"joints '{depths[depth]}' and '{name}' branch",
                hint=f"name those of the controller in the parameter '{_PARAMETER}'",
            )
        depths[depth] = name
    return [depths[depth] for depth in sorted(depths)]
