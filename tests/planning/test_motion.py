"""Plans: found, free of collisions, within limits, the same again; and why there is none."""

import functools

import arms
import numpy as np
import pytest

from gazelle.description import Box, Cylinder, Pose, Sphere
from gazelle.errors import MissingExtraError, PlanningError, PlanningWarning
from gazelle.planning import (
    ConstraintSet,
    JointConstraint,
    JumpLimits,
    MotionPlanner,
    NoPlanError,
    OrientationConstraint,
    PlanningScene,
    PlanOptions,
    PlanOutcome,
    PositionConstraint,
    goal_of_pose,
    ompl_planners,
)
from gazelle.planning.state_validity import StateValidity

WAYS = [False, pytest.param(True, marks=pytest.mark.skipif(
    not ompl_planners.is_installed(), reason="needs the package ompl"
))]  # fmt: skip
ACCELERATION = 1.0
"""Of joints without a limit."""


def kitchen():
    """Fetch, tucked, before a table with boxes below a shelf."""
    robot, group = arms.arm_group("fetch")
    scene = PlanningScene(robot)
    scene.add("table", Box((0.6, 1.4, 0.05)), Pose(0.85, 0.0, 0.55))
    scene.add("box", Box((0.15, 0.15, 0.35)), Pose(0.75, 0.3, 0.75))
    scene.add("can", Cylinder(0.08, 0.4), Pose(0.65, -0.35, 0.78))
    scene.add("shelf", Box((0.4, 1.2, 0.04)), Pose(0.9, 0.0, 1.25))
    scene.state[group.columns] = group.positions(group.named("tuck"), np.zeros(7))
    return scene, group


@functools.cache
def free_states(count):
    scene, group = kitchen()
    valid = StateValidity(scene, group, scene.state)
    random, found = np.random.default_rng(1), []
    while len(found) < count:
        drawn = group.sample(random, 1)[0]
        if valid(drawn):
            found.append(drawn)
    return found


def from_positions(scene, group, positions):
    state = scene.state.copy()
    state[group.columns] = positions
    return state


def assert_sound(scene, plan, velocity=1.0, acceleration=1.0):
    """Check a trajectory: no collision, no limit exceeded, at rest at its ends."""
    timed, group = plan.trajectory, plan.group
    fine = StateValidity(scene, group, plan.start)
    assert fine.path(timed.positions, fine.resolution / 10.0)
    assert (np.diff(timed.times) > 0.0).all()
    assert (np.abs(timed.velocities) <= velocity * group.max_velocity * (1 + 1e-9)).all()
    assert (np.abs(timed.accelerations) <= acceleration * ACCELERATION * (1 + 1e-9)).all()
    spans = np.diff(timed.times)[:, None]
    rates = np.diff(timed.positions, axis=0) / spans
    assert (np.abs(rates) <= velocity * group.max_velocity * (1 + 1e-9)).all()
    middles = (spans[1:] + spans[:-1]) / 2.0
    pushes = np.diff(rates, axis=0) / middles
    assert (np.abs(pushes) <= acceleration * ACCELERATION * (1 + 1e-6)).all()
    assert not timed.velocities[[0, -1]].any()
    np.testing.assert_allclose(timed.positions[0], plan.start[group.columns], atol=1e-9)


@pytest.mark.parametrize("use_ompl", WAYS)
def test_plans_are_sound(use_ompl):
    scene, group = kitchen()
    states = free_states(16)
    for number in range(0, 16, 2):
        options = PlanOptions(seed=number, use_ompl=use_ompl, time=30.0)
        start = from_positions(scene, group, states[number])
        plan = MotionPlanner(scene, group, options).plan(states[number + 1], start=start)
        assert_sound(scene, plan)
        turns = group.difference(plan.trajectory.positions[-1], states[number + 1])
        np.testing.assert_allclose(turns, 0.0, atol=1e-9)


@pytest.mark.parametrize("use_ompl", WAYS)
def test_the_same_seed_gives_the_same_plan(use_ompl):
    scene, group = kitchen()
    start = from_positions(scene, group, free_states(16)[4])
    goal = free_states(16)[3]

    def plan(seed):
        options = PlanOptions(seed=seed, use_ompl=use_ompl, time=30.0)
        return MotionPlanner(scene, group, options).plan(goal, start=start).trajectory

    first, again = plan(5), plan(5)
    assert (first.positions == again.positions).all()
    assert (first.times == again.times).all()


def test_goals_of_all_kinds():
    scene, group = kitchen()
    planner = MotionPlanner(scene, group, PlanOptions(time=30.0))
    there = from_positions(scene, group, group.positions(group.named("ready"), np.zeros(7)))
    pose = scene.robot.pose(there, "gripper_link")
    for goal in (pose, "ready", group.named("ready"), there[group.columns], goal_of_pose("gripper_link", pose)):  # fmt: skip
        plan = planner.plan(goal)
        assert_sound(scene, plan)
        found = scene.robot.pose(plan.end, "gripper_link")
        assert found.is_close(pose, position=2e-4, angle=2e-3)
    wrist = scene.robot.pose(there, "wrist_flex_link")
    plan = planner.plan(wrist, link="wrist_flex_link")
    assert scene.robot.pose(plan.end, "wrist_flex_link").is_close(wrist, position=1e-4, angle=1e-4)


def test_goals_with_room():
    scene, group = kitchen()
    planner = MotionPlanner(scene, group, PlanOptions(time=30.0))
    region = PositionConstraint("gripper_link", Box((0.1, 0.2, 0.1)), Pose(0.7, 0.0, 1.05))
    goal = ConstraintSet(positions=(region,))
    plan = planner.plan(goal)
    assert goal.violations(scene.robot, plan.end) == []
    down = OrientationConstraint("gripper_link", Pose(pitch=np.pi / 2), (0.1, 0.1, 3.2))
    goal = ConstraintSet(orientations=(down,))
    assert goal.violations(scene.robot, planner.plan(goal).end) == []
    joint = ConstraintSet((JointConstraint("wrist_flex_joint", 1.2, 0.1, 0.1),))
    plan = planner.plan(joint)
    assert joint.violations(scene.robot, plan.end) == []


def test_scaling_and_other_times():
    scene, group = kitchen()
    full = MotionPlanner(scene, group, PlanOptions(time=30.0)).plan("ready")
    slow = PlanOptions(velocity=0.1, acceleration=0.1, time=30.0)
    plan = MotionPlanner(scene, group, slow).plan("ready")
    assert_sound(scene, plan, 0.1, 0.1)
    assert plan.trajectory.duration > 2.5 * full.trajectory.duration
    parabolic = PlanOptions(timing="iterative parabolic", time=30.0)
    assert_sound(scene, MotionPlanner(scene, group, parabolic).plan("ready"))


def tray():
    robot, group = arms.arm_group("panda")
    scene = PlanningScene(robot)
    scene.add("post", Cylinder(0.05, 1.0), Pose(0.5, 0.0, 0.5))
    scene.state[group.columns] = [0.9, 0.4, 0.0, -1.8, 0.0, 2.2, 0.0]
    return scene, group


def test_a_link_stays_upright():
    scene, group = tray()
    level = scene.robot.pose(scene.state, group.tip)
    upright = OrientationConstraint(group.tip, level, (0.2, 0.2, 6.3), "rotation vector")
    constraints = ConstraintSet(orientations=(upright,))
    goal = Pose(0.0, 0.0, 0.0, yaw=-1.8) * level
    plan = MotionPlanner(scene, group, PlanOptions(time=60.0)).plan(goal, constraints=constraints)
    for positions in plan.trajectory.positions:
        state = from_positions(scene, group, positions)
        assert constraints.violations(scene.robot, state) == []
    assert_sound(scene, plan)


@pytest.mark.parametrize(
    ("goal", "outcome", "words"),
    [
        (Pose(3.0, 0.0, 1.0), PlanOutcome.NO_IK_SOLUTION, "out of reach"),
        (Pose(0.75, 0.3, 0.75), PlanOutcome.GOAL_IN_COLLISION, "'gripper_link' collide"),
        ({"elbow_flex_joint": 2.5}, PlanOutcome.INVALID_GOAL_CONSTRAINTS, "2.5000 is beyond its limits"),
        (ConstraintSet(), PlanOutcome.INVALID_GOAL_CONSTRAINTS, "has no constraints"),
        (
            ConstraintSet((JointConstraint("torso_lift_joint", 0.3),)),
            PlanOutcome.INVALID_GOAL_CONSTRAINTS,
            "'torso_lift_joint' at 0.0000 is not within",
        ),
    ],
)  # fmt: skip
def test_an_unreachable_goal_says_what_is_in_the_way(goal, outcome, words):
    scene, group = kitchen()
    with pytest.raises(NoPlanError) as raised:
        MotionPlanner(scene, group, PlanOptions(time=30.0)).plan(goal)
    text = str(raised.value).replace("'gripper_link' and 'box' collide", "'gripper_link' collide")
    text = text.replace("'box' and 'gripper_link' collide", "'gripper_link' collide")
    assert raised.value.outcome == outcome, text
    assert words in text


def test_a_place_within_reach_but_not_turned_so():
    robot, group = arms.arm_group("fetch")
    scene = PlanningScene(robot)
    stretched = np.array([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    far = robot.pose(from_positions(scene, group, stretched), "gripper_link")
    with pytest.raises(NoPlanError, match="but not with its orientation there"):
        MotionPlanner(scene, group).plan(far * Pose(yaw=3.0))


def test_a_start_that_cannot_be():
    scene, group = kitchen()
    planner = MotionPlanner(scene, group, PlanOptions(time=30.0))
    scene.add("ball", Sphere(0.1), scene.pose_of("gripper_link"))
    with pytest.raises(NoPlanError, match=r"the start cannot be: .*'ball'") as raised:
        planner.plan("ready")
    assert raised.value.outcome == PlanOutcome.START_STATE_IN_COLLISION
    scene.remove("ball")
    beyond = scene.state.copy()
    beyond[scene.robot.column("elbow_flex_joint")] = 2.4
    with pytest.raises(NoPlanError, match="beyond its limits") as raised:
        planner.plan("ready", start=beyond)
    assert raised.value.outcome == PlanOutcome.START_STATE_INVALID
    beyond[scene.robot.column("elbow_flex_joint")] = -2.2
    with pytest.raises(NoPlanError) as raised:
        planner.plan("ready", start=beyond[:3])
    assert raised.value.outcome == PlanOutcome.INVALID_ROBOT_STATE


def test_a_start_a_little_beyond_its_limits_is_moved_onto_them():
    scene, group = kitchen()
    column = scene.robot.column("shoulder_lift_joint")
    start = from_positions(scene, group, group.positions(group.named("ready"), np.zeros(7)))
    scene.clear()
    start[column] = -1.221 - 0.03
    plan = MotionPlanner(scene, group, PlanOptions(time=30.0)).plan("tuck", start=start)
    assert plan.trajectory.positions[0, 1] == pytest.approx(-1.221)


def test_no_way():
    """The goal is free, and closed in."""
    robot, group = arms.arm_group("panda")
    scene = PlanningScene(robot)
    scene.state[group.columns] = [0.9, 0.4, 0.0, -1.8, 0.0, 2.2, 0.0]
    for side in (-1, 1):
        scene.add(f"wall {side}", Box((2.0, 0.02, 3.0)), Pose(side * 1.05, 0.0, 1.5))
    goal = scene.state[group.columns].copy()
    goal[0] = -2.2
    with pytest.raises(NoPlanError, match="found no path to the goal"):
        MotionPlanner(scene, group, PlanOptions(time=0.5)).plan(goal)


def test_straight_ways():
    scene, group = tray()
    scene.clear()
    here = scene.robot.pose(scene.state, group.tip)
    poses = [Pose(0.0, 0.1, 0.0) * here, Pose(0.0, 0.1, -0.1) * here]
    plan, path = MotionPlanner(scene, group).follow(poses, max_step=0.01)
    assert path.fraction == 1.0
    assert path.reason == ""
    assert len(path.points) == 21
    tips = [scene.robot.pose(from_positions(scene, group, p), group.tip) for p in path.points]
    for number, tip in enumerate(tips):
        assert tip.is_close(Pose(0, min(number, 10) * 0.01, -max(0, number - 10) * 0.01) * here, position=2e-5, angle=1e-4)  # fmt: skip
    for one, two in zip(path.points[:-1], path.points[1:], strict=True):
        middle = scene.robot.pose(from_positions(scene, group, (one + two) / 2), group.tip)
        assert abs(middle.x - here.x) < 1e-3
    assert_sound(scene, plan)


def test_turns_are_steps_too():
    scene, group = tray()
    here = scene.robot.pose(scene.state, group.tip)
    _, path = MotionPlanner(scene, group).follow([here * Pose(yaw=0.7)], max_step=0.01)
    assert len(path.points) == 21  # 0.7 rad in steps of 0.035
    assert path.fraction == 1.0


def test_a_straight_way_ends_where_it_must():
    scene, group = tray()
    scene.clear()
    here = scene.robot.pose(scene.state, group.tip)
    planner = MotionPlanner(scene, group)
    plan, path = planner.follow([Pose(1.0) * here], max_step=0.02)
    assert 0.05 < path.fraction < 0.9
    assert "no positions" in path.reason or "joints jump" in path.reason
    scene.add("wall", Box((0.1, 2.0, 2.0)), Pose(here.x + 0.2))
    plan, path = planner.follow([Pose(0.15) * here], max_step=0.01)
    assert 0.3 < path.fraction < 1.0
    assert "'wall'" in path.reason
    assert_sound(scene, plan)
    _, through = planner.follow([Pose(0.15) * here], max_step=0.01, avoid_collisions=False)
    assert through.fraction == 1.0
    scene.clear()
    _, cut = planner.follow([Pose(0.1) * here], jumps=JumpLimits(revolute=1e-4))
    assert cut.fraction == 0.0
    assert "jump" in cut.reason
    with pytest.raises(PlanningError, match="above zero"):
        planner.follow([here], max_step=0.0)


def test_names_of_planners():
    scene, group = kitchen()
    for name in ("RRTConnect", "geometric::RRTConnect", "RRTConnectkConfigDefault", "arm[RRT]", "PRMstar"):  # fmt: skip
        MotionPlanner(scene, group, PlanOptions(name))
    with pytest.warns(PlanningWarning, match="no planner SBL; RRTConnect plans instead"):
        MotionPlanner(scene, group, PlanOptions("SBLkConfigDefault"))
    with pytest.raises(PlanningError, match="did you mean 'RRTConnect'"):
        MotionPlanner(scene, group, PlanOptions("RTTConnect"))


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"velocity": 0.0}, r"scaling factor of velocity must be within \(0, 1\]"),
        ({"acceleration": 1.5}, "scaling factor of acceleration"),
        ({"time": 0.0}, "above zero"),
        ({"timing": "soon"}, "no time parameterization"),
    ],
)
def test_options_that_cannot_be(options, words):
    scene, group = kitchen()
    with pytest.raises(PlanningError, match=words):
        MotionPlanner(scene, group, PlanOptions(**options)).plan("tuck")


@pytest.mark.skipif(ompl_planners.is_installed(), reason="OMPL is installed")
def test_ompl_that_is_not_there():
    scene, group = kitchen()
    with pytest.raises(MissingExtraError, match="planning"):
        MotionPlanner(scene, group, PlanOptions(use_ompl=True)).plan("ready")


@pytest.mark.skipif(not ompl_planners.is_installed(), reason="needs the package ompl")
@pytest.mark.parametrize("planner", ["RRT", "BKPIECE", "KPIECE", "LBKPIECE", "PRM"])
def test_planners_of_ompl(planner):
    scene, group = kitchen()
    scene.remove("shelf")
    scene.remove("box")
    plan = MotionPlanner(scene, group, PlanOptions(planner, time=60.0)).plan("ready")
    assert_sound(scene, plan)


@pytest.mark.parametrize("position", [0.25, -0.1, 0.7])
def test_a_joint_that_mimics_another_may_be_the_goal(position):
    """``follow`` is -0.5 ``turn`` + 0.25, and no variable of the group."""
    robot = arms.odd()
    group = robot.chain("base", "tool", "arm")
    assert "follow" not in group.names
    planner = MotionPlanner(PlanningScene(robot), group)
    plan = planner.plan(ConstraintSet(joints=(JointConstraint("follow", position, 1e-3, 1e-3),)))
    turn = plan.end[robot.column("turn")]
    assert -0.5 * turn + 0.25 == pytest.approx(position, abs=1e-3)
    assert robot.complete(plan.end)[robot.column("follow")] == pytest.approx(position, abs=1e-3)


def test_a_joint_that_mimics_another_is_held_where_it_shall_be():
    robot = arms.odd()
    group = robot.chain("base", "tool", "arm")
    planner = MotionPlanner(PlanningScene(robot), group)
    held = ConstraintSet(joints=(JointConstraint("follow", 0.25, 0.05, 0.05),))
    plan = planner.plan({"slide": 0.3, "turn": 0.05}, constraints=held)
    states = np.tile(plan.start, (len(plan.trajectory.times), 1))
    states[:, group.columns] = plan.trajectory.positions
    assert np.abs(robot.complete(states)[:, robot.column("follow")] - 0.25).max() <= 0.05 + 1e-6
    with pytest.raises(NoPlanError, match="'follow' at"):
        planner.plan({"turn": 0.5}, constraints=held)
