"""Goals of several links at once, and of joints that follow others."""

import itertools

import numpy as np
import pytest

from gazelle.description import Pose, Sphere
from gazelle.formats import load_model_string, load_srdf_string
from gazelle.kinematics import RobotModel
from gazelle.planning import (
    ConstraintSet,
    JointConstraint,
    MotionPlanner,
    NoPlanError,
    PlanningScene,
    PlanOptions,
    PlanOutcome,
    goal_of_pose,
)

_LINK = (
    '<link name="{0}"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" '
    'iyz="0"/></inertial><collision><origin xyz="0.1 0 0"/><geometry><box size="0.12 0.05 0.05"/>'
    "</geometry></collision></link>"
)
_JOINT = (
    '<joint name="{0}" type="{5}"><parent link="{1}"/><child link="{2}"/><origin xyz="{3}"/><axis '
    'xyz="{4}"/><limit lower="-2.5" upper="2.5" velocity="2" effort="9"/>{6}</joint>'
)
_AXES = ("0 0 1", "0 1 0", "1 0 0", "0 1 0", "0 0 1", "1 0 0")


def two_arms(apart=0.6, *, waist=False):
    """Return two arms of six joints, each with a finger that mimics its last joint."""
    urdf, srdf = two_arms_text(apart, waist=waist)
    return RobotModel(load_model_string(urdf), load_srdf_string(srdf))


def two_arms_text(apart=0.6, *, waist=False):
    """Return URDF and SRDF of these."""
    parts, base = ['<robot name="twins">', _LINK.format("base")], "base"
    if waist:
        parts += [_LINK.format("torso"), _JOINT.format("waist", base, "torso", "0 0 0.1", "0 0 1", "revolute", "")]  # fmt: skip
        base = "torso"
    groups = []
    for side, y in (("left", apart), ("right", -apart)):
        names = [base, *(f"{side}_{number}" for number in range(1, 7))]
        for number, (parent, child) in enumerate(itertools.pairwise(names)):
            place = f"0 {y} 0.2" if parent == base else "0.2 0 0"
            parts.append(_LINK.format(child))
            parts.append(_JOINT.format(f"{child}_joint", parent, child, place, _AXES[number], "revolute", ""))  # fmt: skip
        parts.append(_LINK.format(f"{side}_finger").replace("0.12 0.05 0.05", "0.02 0.02 0.02"))
        follows = f'<mimic joint="{side}_6_joint" multiplier="0.5" offset="0.1"/>'
        parts.append(_JOINT.format(f"{side}_finger_joint", f"{side}_6", f"{side}_finger", "0.2 0 0", "0 0 1", "revolute", follows))  # fmt: skip
        groups.append(
            f'<group name="{side}"><chain base_link="{base}" tip_link="{side}_6"/></group>'
        )
    both = '<group name="both"><group name="left"/><group name="right"/>{}</group>'
    extra = '<joint name="waist"/>' if waist else ""
    srdf = f'<robot name="twins">{"".join(groups)}{both.format(extra)}</robot>'
    return "".join([*parts, "</robot>"]), srdf


def posed(robot, seed):
    """Return a state of all joints, and goals for both hands that it fulfils."""
    random = np.random.default_rng(seed)
    state = robot.complete(random.uniform(-0.9, 0.9, len(robot.variables)))
    goals = [
        goal_of_pose(f"{side}_6", robot.pose(state, f"{side}_6")) for side in ("left", "right")
    ]
    return state, ConstraintSet(
        positions=sum((goal.positions for goal in goals), ()),
        orientations=sum((goal.orientations for goal in goals), ()),
    )


@pytest.mark.parametrize("seed", range(6))
def test_several_links_reach_their_poses_together(seed):
    robot = two_arms()
    scene = PlanningScene(robot)
    _, goal = posed(robot, seed)
    plan = MotionPlanner(scene, robot.group("both"), PlanOptions(time=30.0)).plan(goal)
    assert goal.violations(robot, plan.end) == []
    assert not scene.in_collision(plan.end)


def test_what_stands_where_one_of_them_shall_be_is_named():
    robot = two_arms()
    state, goal = posed(robot, 0)
    scene = PlanningScene(robot)
    scene.add("ball", Sphere(0.08), robot.pose(state, "left_6") * Pose(0.1))
    planner = MotionPlanner(scene, robot.group("both"), PlanOptions(time=30.0))
    with pytest.raises(NoPlanError, match="'ball' and 'left_6' collide") as caught:
        planner.plan(goal)
    assert caught.value.outcome == PlanOutcome.GOAL_IN_COLLISION


def test_one_of_several_poses_is_out_of_reach():
    robot = two_arms()
    _, goal = posed(robot, 1)
    far = goal_of_pose("right_6", Pose(9.0, 0.0, 0.0))
    goal = ConstraintSet(
        positions=(goal.positions[0], *far.positions), orientations=goal.orientations
    )
    planner = MotionPlanner(PlanningScene(robot), robot.group("both"), PlanOptions(time=30.0))
    with pytest.raises(NoPlanError, match=r"'right_6'.*out of reach"):
        planner.plan(goal)


def test_links_that_share_joints_are_refused():
    robot = two_arms(waist=True)
    _, goal = posed(robot, 2)
    planner = MotionPlanner(PlanningScene(robot), robot.group("both"), PlanOptions(time=30.0))
    with pytest.raises(NoPlanError, match="which the joints waist move together") as caught:
        planner.plan(goal)
    assert caught.value.outcome == PlanOutcome.INVALID_GOAL_CONSTRAINTS


@pytest.mark.parametrize("wanted", [-1.0, 0.0, 0.8])
def test_a_joint_that_follows_another_may_be_part_of_a_goal(wanted):
    robot = two_arms()
    planner = MotionPlanner(PlanningScene(robot), robot.group("left"), PlanOptions(time=30.0))
    leader = JointConstraint("left_6_joint", wanted)
    follower = JointConstraint("left_finger_joint", 0.5 * wanted + 0.1)
    plan = planner.plan(ConstraintSet((leader, follower)))
    assert plan.end[robot.column("left_6_joint")] == pytest.approx(wanted, abs=1e-4)
    with pytest.raises(NoPlanError, match="'left_finger_joint' at"):
        planner.plan(ConstraintSet((leader, JointConstraint("left_finger_joint", 2.0))))
