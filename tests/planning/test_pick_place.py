"""Fetch takes a cube, carries it and puts it down: plans, and the simulation with real contact."""

from __future__ import annotations

import math
from dataclasses import replace

import fetch_robot
import numpy as np
import pytest

from gazelle import assets
from gazelle.description import Box, Pose
from gazelle.errors import PlanningError
from gazelle.formats import load_model, load_srdf
from gazelle.kinematics import RobotModel
from gazelle.planning import (
    ContactRules,
    Grasp,
    GripperTranslation,
    NoPlanError,
    PickPlacePlanner,
    PlaceLocation,
    PlanningScene,
    PlanOptions,
    PlanOutcome,
    RobotGripper,
    box_grasps,
)
from gazelle.planning.state_validity import StateValidity

HAND = fetch_robot.HAND
SIZE = (0.06, 0.06, 0.06)


@pytest.fixture(scope="module")
def model():
    root = assets.root()
    return RobotModel(
        load_model(root / "fetch_description" / "robots" / "fetch.urdf"),
        load_srdf(root / "fetch_moveit_config" / "config" / "fetch.srdf"),
    )


@pytest.fixture
def scene(model):
    """Return a table with a cube on it; the arm is ready."""
    made = PlanningScene(model)
    for name, value in fetch_robot.READY.items():
        made.state[model.column(name)] = value
    made.add("table", Box((0.7, 1.4, 0.7)), Pose(0.85, 0.0, 0.35))
    made.add("cube", Box(SIZE), Pose(0.7, -0.1, 0.73, yaw=0.4))
    return made


def planner(scene, **options):
    return PickPlacePlanner(scene, scene.robot.group("arm"), options=PlanOptions(**options))


def grasps(scene, **options):
    return box_grasps(HAND, scene.objects["cube"].pose, SIZE, **options)


def straight(model, motion):
    """Return the distance of the tip, and its deviation from the straight line [m]."""
    states = np.tile(motion.start, (len(motion.trajectory.times), 1))
    states[:, motion.group.columns] = motion.trajectory.positions
    points = model.forward(states, "wrist_roll_link")[:, :3, 3]
    way = points[-1] - points[0]
    unit = way / np.linalg.norm(way)
    aside = points - points[0] - np.outer((points - points[0]) @ unit, unit)
    return way, float(np.linalg.norm(aside, axis=1).max())


def test_stages_follow_one_another(scene, model):
    before = scene.state.copy()
    plan = planner(scene).pick("cube", grasps(scene))
    assert [each.name for each in plan.stages] == [
        "pre_grasp", "plan", "approach", "grasp", "retreat",
    ]  # fmt: skip
    opened, to, approach, grip, retreat = plan.stages
    assert opened.posture == HAND.open
    assert grip.posture == HAND.closed
    assert (grip.effort, grip.then) == (60.0, "attach")
    np.testing.assert_array_equal(
        to.motion.trajectory.positions[0], before[to.motion.group.columns]
    )
    for first, second in ((to, approach), (approach, retreat)):
        np.testing.assert_allclose(
            first.motion.trajectory.positions[-1], second.motion.trajectory.positions[0], atol=1e-9
        )
    # Straight down onto the cube, and straight up.
    for motion, sign in ((approach.motion, -1.0), (retreat.motion, 1.0)):
        way, aside = straight(model, motion)
        assert way == pytest.approx((0.0, 0.0, 0.1 * sign), abs=2e-3)
        assert aside < 2e-3
    assert (np.abs(to.motion.trajectory.velocities) <= to.motion.group.max_velocity + 1e-9).all()
    # The scene is as it was.
    np.testing.assert_array_equal(scene.state, before)
    assert {*scene.objects} == {"table", "cube"}


def test_the_way_there_touches_nothing(scene, model):
    plan = planner(scene).pick("cube", grasps(scene))
    motion = plan.stages[1].motion
    free = scene.copy()
    free.state = motion.start
    validity = StateValidity(free, motion.group, motion.start)
    assert validity.path(motion.trajectory.positions, validity.resolution / 10.0)


def test_the_best_grasp_that_can_be_done_is_taken(scene):
    tall = (0.06, 0.06, 0.2)
    scene.add("cube", Box(tall), Pose(0.7, -0.1, 0.801, yaw=0.4))
    found = box_grasps(HAND, scene.objects["cube"].pose, tall)
    plan = planner(scene).pick("cube", found)
    down = found[plan.choice].pose.rotate((1.0, 0.0, 0.0))
    assert down == pytest.approx((0.0, 0.0, -1.0), abs=1e-9)
    # Where the sides are said to be better, one of them is.
    found = [replace(each, quality=-abs(each.quality)) for each in found]
    aside = found[planner(scene).pick("cube", found).choice]
    assert abs(aside.pose.rotate((1.0, 0.0, 0.0))[2]) < 1e-9


def test_what_cannot_be_taken_is_refused_with_the_reason(scene):
    with pytest.raises(NoPlanError, match="no object 'cub'") as caught:
        planner(scene).pick("cub", grasps(scene))
    assert caught.value.outcome == PlanOutcome.INVALID_OBJECT_NAME
    with pytest.raises(NoPlanError, match="no grasp"):
        planner(scene).pick("cube", [])
    scene.move("cube", Pose(2.0, 0.0, 0.73))
    with pytest.raises(NoPlanError, match="no positions of the joints") as caught:
        planner(scene).pick("cube", grasps(scene)[:2])
    assert caught.value.outcome == PlanOutcome.NO_IK_SOLUTION
    scene.move("cube", Pose(0.7, 0.0, 0.73))
    scene.add("cage", Box((0.2, 0.2, 0.1)), Pose(0.7, 0.0, 0.81))
    with pytest.raises(NoPlanError, match="'cage'"):
        planner(scene).pick("cube", grasps(scene)[:2])
    with pytest.raises(PlanningError, match="end effector 'grip'"):
        PickPlacePlanner(scene, scene.robot.group("arm"), "grip")


@pytest.mark.long
def test_a_lift_that_would_be_too_short_is_none(scene):
    far = GripperTranslation((0.0, 0.0, 1.0), desired=1.5, minimum=1.4)
    found = [
        Grasp(each.pose, each.approach, far, each.open, each.closed, link=each.link)
        for each in grasps(scene)[:1]
    ]
    with pytest.raises(NoPlanError, match="cannot lift it straight"):
        planner(scene).pick("cube", found)


def hold(scene, model):
    """Attach the cube to the hand, a little above the table; return the planner's plan."""
    plan = planner(scene).pick("cube", grasps(scene))
    scene.state = plan.stages[3 - 1].motion.end
    scene.attach("cube", plan.link, sorted(plan.touch_links))
    scene.state = plan.stages[-1].motion.end
    for name in fetch_robot.FINGERS:
        scene.state[model.column(name)] = 0.03
    return plan


@pytest.mark.parametrize("of_tip", [False, True])
def test_a_thing_is_put_where_it_is_wanted(scene, model, of_tip):
    hold(scene, model)
    goal = Pose(0.65, 0.15, 0.731, yaw=0.2)
    place = PlaceLocation(goal, open=HAND.open)
    if of_tip:
        in_tip = scene.attached["cube"].object.pose
        place = PlaceLocation(goal * in_tip.inverse(), open=HAND.open, of_tip=True)
    plan = planner(scene).place("cube", [place])
    assert [each.name for each in plan.stages] == ["plan", "approach", "release", "retreat"]
    assert plan.stages[2].then == "detach"
    scene.state = plan.stages[1].motion.end
    assert scene.pose_of("cube").is_close(goal, position=1e-4, angle=1e-4)
    way, _ = straight(model, plan.stages[-1].motion)
    assert way == pytest.approx((0.0, 0.0, 0.1), abs=2e-3)


def test_where_nothing_can_be_put_is_said(scene, model):
    hold(scene, model)
    inside = PlaceLocation(Pose(0.65, 0.15, 0.6), open=HAND.open)
    with pytest.raises(NoPlanError, match="'table'"):
        planner(scene).place("cube", [inside])
    with pytest.raises(NoPlanError, match="held"):
        planner(scene).place("ball", [inside])


def test_a_support_may_be_touched_by_the_hand_if_that_is_allowed(scene):
    scene.move("cube", Pose(0.7, -0.1, 0.725))
    best = grasps(scene)[:1]
    low = [
        Grasp(each.pose * Pose(0.012), each.approach, each.retreat, each.open, each.closed, link=each.link)
        for each in best
    ]  # fmt: skip
    with pytest.raises(NoPlanError, match="table"):
        planner(scene).pick("cube", low, rules=ContactRules("table"))
    planner(scene).pick("cube", low, rules=ContactRules("table", hand_on_support=True))


def test_grasps_of_a_box_have_the_fingers_on_two_faces():
    pose = Pose(0.5, 0.2, 0.8, yaw=0.7)
    found = box_grasps(HAND, pose, (0.2, 0.04, 0.06))
    assert found
    for each in found:
        across = pose.inverse().rotate(each.pose.rotate((0.0, 1.0, 0.0)))
        assert max(map(abs, across)) == pytest.approx(1.0)
        assert abs(across[0]) < 1e-6  # 0.2 m is wider than the hand
    assert np.diff([each.quality for each in found]).max() < 1e-9
    assert not box_grasps(HAND, pose, (0.2, 0.2, 0.2))


@pytest.mark.parametrize(
    "numbers", [{"desired": -1.0}, {"minimum": math.nan}, {"direction": (0, 0, 0)}]
)
def test_ways_that_are_none_are_refused(numbers):
    with pytest.raises(PlanningError):
        GripperTranslation(**({"direction": (0.0, 0.0, 1.0)} | numbers))


# -- in simulation ---------------------------------------------------------------------------


@pytest.mark.long
def test_a_cube_is_taken_carried_and_put_down():
    before, there = fetch_robot.errand(0)
    with fetch_robot.kitchen(*before) as (robot, cube):
        lifted, away = fetch_robot.carry(robot, cube, there)
    assert lifted == pytest.approx(0.1, abs=0.01)
    assert away < 0.01


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(50))
def test_fifty_of_fifty_cubes_are_put_within_a_centimetre(seed):
    before, there = fetch_robot.errand(seed)
    with fetch_robot.kitchen(*before) as (robot, cube):
        lifted, away = fetch_robot.carry(robot, cube, there, seed)
    assert lifted > 0.08
    assert away < 0.01


@pytest.mark.long
def test_a_gripper_says_whether_it_closed_on_something():
    with fetch_robot.kitchen() as (robot, _):
        gripper = RobotGripper(robot)
        assert gripper.name == "gripper_controller"
        assert {*gripper.joints} == {*fetch_robot.FINGERS}
        assert gripper.move(0.05)
        report = gripper.take(HAND.closed, 20.0)
        assert report.reached
        assert not report.stalled
        with pytest.raises(PlanningError, match="none of the joints"):
            gripper.take({"elbow_flex_joint": 0.0})
        with pytest.raises(PlanningError, match="no running controller"):
            RobotGripper(robot, "gripper_controler")
