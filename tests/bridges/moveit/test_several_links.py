"""``compute_ik`` for several links at once, on a robot with two arms."""

import numpy as np
import pytest
from bridges.moveit.moveit_graph import MoveGroupClient, message
from planning.test_goals_of_several_links import two_arms_text

from gazelle.bridges.moveit.frames import stamped_message
from gazelle.bridges.moveit.move_group import MoveGroupNode
from gazelle.description import Pose, Sphere
from gazelle.planning import PlanOutcome
from gazelle_ros import Master, Node

LINKS = ["left_6", "right_6"]


@pytest.fixture(scope="module")
def twins():
    urdf, srdf = two_arms_text()
    with (
        Master(port=0, rosout=False) as master,
        Node("/asking", master_uri=master.uri) as asking,
    ):
        asking.set_param("/robot_description", urdf)
        asking.set_param("/robot_description_semantic", srdf)
        with Node("/move_group", master_uri=master.uri) as node:
            yield MoveGroupClient(asking, MoveGroupNode(node))


def poses(client, seed):
    """Return the poses of both hands in a state with all joints within 0.9 rad of zero."""
    robot = client.group.context.robot
    state = robot.complete(np.random.default_rng(seed).uniform(-0.9, 0.9, len(robot.variables)))
    return [robot.pose(state, link) for link in LINKS]


def ik(client, wanted, names=LINKS, **fields):
    asked = message("PositionIKRequest", group_name="both", ik_link_names=names, **fields)
    asked.pose_stamped_vector = [stamped_message(pose, "base", 0) for pose in wanted]
    return client.call("compute_ik", "GetPositionIK", ik_request=asked)


def reached(client, answer):
    robot, joints = client.group.context.robot, answer.solution.joint_state
    state = robot.zero()
    state[robot.columns(joints.name)] = joints.position
    return [robot.pose(state, link) for link in LINKS]


@pytest.mark.parametrize("seed", range(4))
def test_all_of_them_are_brought_there(twins, seed):
    wanted = poses(twins, seed)
    found = ik(twins, wanted)
    assert found.error_code.val == PlanOutcome.SUCCESS
    for there, pose in zip(reached(twins, found), wanted, strict=True):
        assert there.is_close(pose, position=5e-5, angle=5e-5)


def test_collisions_count_where_they_shall(twins):
    wanted = poses(twins, 0)
    scene = twins.group.context.scene
    with twins.group.context.lock:
        scene.add("ball", Sphere(0.08), wanted[0] * Pose(0.1))
    try:
        assert ik(twins, wanted).error_code.val == PlanOutcome.SUCCESS
        found = ik(twins, wanted, avoid_collisions=True)
        assert found.error_code.val == PlanOutcome.NO_IK_SOLUTION
    finally:
        with twins.group.context.lock:
            scene.clear()


def test_what_cannot_be_has_a_code(twins):
    near, _ = poses(twins, 1)
    assert ik(twins, [near, Pose(9.0)]).error_code.val == PlanOutcome.NO_IK_SOLUTION
    assert (
        ik(twins, [near, near], ["left_6", "left_5"]).error_code.val == PlanOutcome.NO_IK_SOLUTION
    )
    assert ik(twins, [near, near], ["left_6", "nose"]).error_code.val == PlanOutcome.NO_IK_SOLUTION
    assert ik(twins, [near], LINKS).error_code.val == PlanOutcome.INVALID_LINK_NAME


def test_constraints_are_asked_of_all(twins):
    wanted = poses(twins, 2)
    free = ik(twins, wanted)
    values = dict(
        zip(free.solution.joint_state.name, free.solution.joint_state.position, strict=True)
    )
    here = message("JointConstraint", joint_name="left_3_joint", position=values["left_3_joint"],
                   tolerance_above=0.01, tolerance_below=0.01)  # fmt: skip
    kept = message("Constraints", joint_constraints=[here])
    assert ik(twins, wanted, constraints=kept).error_code.val == PlanOutcome.SUCCESS
    here.position = 2.4
    assert ik(twins, wanted, constraints=kept).error_code.val == PlanOutcome.NO_IK_SOLUTION
