"""A group of a robot in a running simulation: where it is, plans, and what comes of running them."""

import threading
from dataclasses import replace

import arms
import numpy as np
import pytest

import gazelle
from gazelle.description import Box, Collision, Link, Model, Plane, Pose, World
from gazelle.errors import PlanningError
from gazelle.formats import load_model
from gazelle.planning import Group, PlanOutcome

JOINTS = (
    "shoulder_pan_joint",
    "shoulder_lift_joint",
    "upperarm_roll_joint",
    "elbow_flex_joint",
    "forearm_roll_joint",
    "wrist_flex_joint",
    "wrist_roll_joint",
)
READY = (0.0, -0.8, 0.0, 1.2, 0.0, -0.4, 0.0)
TUCK = (1.32, 1.40, -0.2, 1.72, 0.0, 1.66, 0.0)


def simulation(*models, nworld=1, start=READY):
    """Fetch on a floor, its joints moved by position controllers."""
    floor = Model("floor", static=True, links=(Link("f", collisions=(Collision("c", Plane()),)),))
    sim = gazelle.Simulation(World("lab", models=(floor, *models)), nworld=nworld)
    robot = sim.spawn(load_model(arms.DATA / "fetch_arm.urdf"), name="fetch")
    robot.set_configuration(JOINTS, start)
    parts = {
        "torso": ("torso_lift_joint",),
        "arm_controller": JOINTS,
        "gripper": ("r_gripper_finger_joint",),
    }
    for name, joints in parts.items():
        robot.controllers.load(
            name, {"type": "position_controllers/JointTrajectoryController", "joints": [*joints]}
        )
    robot.controllers.start(*parts)
    return sim, robot


def fetch_group(robot, name="arm", **options):
    limits = {
        each.name: replace(each.bounds, acceleration=6.0) for each in arms.arm("fetch").variables
    }
    srdf = arms.DATA / "fetch_arm.srdf"
    return Group(robot, name, semantics=srdf, limits=limits, **options)


@pytest.fixture
def lab():
    sim, robot = simulation()
    with sim:
        yield sim, robot


def test_the_arm_goes_where_it_is_told(lab):
    sim, robot = lab
    arm = fetch_group(robot)
    np.testing.assert_allclose(arm.positions, READY, atol=1e-6)
    turned = [0.8, *READY[1:]]
    assert arm.plan(turned).run()
    np.testing.assert_allclose(arm.positions, turned, atol=0.01)
    there = arm.pose() * Pose(0.0, 0.05, 0.05)
    report = arm.go(there)
    assert report.outcome is PlanOutcome.SUCCESS
    assert report.message == ""
    assert arm.pose().is_close(there, position=0.01, angle=0.02)
    straight = arm.follow([arm.pose() * Pose(-0.1)])
    assert straight.fraction == 1.0
    assert straight.run()
    assert arm.pose().is_close(there * Pose(-0.1), position=0.01, angle=0.02)
    # The simulated hand is where the kinematics say.
    hand, offset = robot.frame("gripper_link")
    assert (hand.pose * offset).is_close(arm.base * arm.pose(), position=1e-3, angle=1e-3)
    assert sim.time > report.seconds > 0.1


def test_obstacles_of_the_simulation():
    block = Box((0.2, 0.2, 0.4))
    shape = Collision("c", block, Pose(z=0.1))
    post = Model("post", Pose(0.9, 0.0, 0.85), static=True, links=(Link("l", collisions=(shape,)),))
    sim, robot = simulation(post, start=TUCK)
    with sim:
        arm = fetch_group(robot)
        arm.see()
        assert set(arm.scene.objects) == {"floor::f", "post::l"}
        # Seen from the robot's root link, which stands a little higher or lower.
        placed = arm.base * arm.scene.objects["post::l"].pose
        assert placed.is_close(post.pose, position=1e-6, angle=1e-6)
        with pytest.raises(PlanningError, match="'post::l'"):
            arm.plan("ready")
        assert arm.plan({"shoulder_pan_joint": 1.4}).duration > 0.0
        with pytest.raises(PlanningError, match="no model 'pole'"):
            arm.see("pole")


def test_a_plan_from_elsewhere_is_not_run(lab):
    _, robot = lab
    arm = fetch_group(robot)
    plan = arm.plan({"shoulder_pan_joint": 0.2})
    assert plan.run()
    with pytest.raises(PlanningError, match="plan again from where the robot is"):
        plan.run()


def test_several_controllers_share_a_plan(lab):
    _, robot = lab
    both = fetch_group(robot, "arm_with_torso")
    goal = {"torso_lift_joint": 0.1, "shoulder_pan_joint": 0.5}
    assert both.plan(goal).run()
    assert robot.joints["torso_lift_joint"].position == pytest.approx(0.1, abs=0.01)
    assert robot.joints["shoulder_pan_joint"].position == pytest.approx(0.5, abs=0.01)


def test_joints_that_nobody_moves_are_named(lab):
    _, robot = lab
    both = fetch_group(robot, "arm_with_torso")
    plan = both.plan({"torso_lift_joint": 0.1})
    robot.controllers.stop("torso")
    with pytest.raises(
        PlanningError, match="no running trajectory controller moves torso_lift_joint"
    ):
        plan.run()


def test_other_joints_of_a_controller_are_held(lab):
    _, robot = lab
    robot.controllers.stop("arm_controller", "torso")
    everything = ("torso_lift_joint", *JOINTS)
    robot.controllers.load(
        "all",
        {"type": "position_controllers/JointTrajectoryController", "joints": [*everything]},
    )
    robot.controllers.start("all")
    before = robot.joints["torso_lift_joint"].position
    arm = fetch_group(robot)
    assert arm.plan({"shoulder_pan_joint": 0.5}).run()
    assert robot.joints["torso_lift_joint"].position == pytest.approx(before, abs=1e-3)


@pytest.mark.long
def test_a_controller_without_an_srdf_is_a_group(lab):
    _, robot = lab
    arm = Group(robot, "arm", tip="gripper_link")
    assert arm.names == JOINTS
    assert arm.plan({"shoulder_pan_joint": 0.1}).run()
    with pytest.raises(PlanningError, match="did you mean 'arm_controller'"):
        Group(robot, "arm_controler")


def test_cancelling_and_another_thread(lab):
    sim, robot = lab
    arm = fetch_group(robot)
    execution = arm.plan({"shoulder_pan_joint": 0.2}).start()
    stop = threading.Event()

    def steps():
        while not stop.is_set():
            sim.run(0.01)

    thread = threading.Thread(target=steps)
    thread.start()
    try:
        assert execution.wait(60.0)
    finally:
        stop.set()
        thread.join()
    execution = arm.plan({"shoulder_pan_joint": 0.9}).start()
    sim.run(0.2)
    assert not execution.done
    execution.cancel()
    report = execution.run()
    assert report.outcome is PlanOutcome.PREEMPTED
    assert not report


def test_a_failure_of_a_controller_is_told():
    """A controller whose tolerance cannot be met says so."""
    sim, robot = simulation()
    with sim:
        robot.controllers.stop("arm_controller")
        robot.controllers.load(
            "strict",
            {
                "type": "position_controllers/JointTrajectoryController",
                "joints": [*JOINTS],
                "constraints": {name: {"trajectory": 1e-9} for name in JOINTS},
            },
        )
        robot.controllers.start("strict")
        report = fetch_group(robot).plan({"shoulder_pan_joint": 0.9}).run()
        assert report.outcome is PlanOutcome.CONTROL_FAILED
        assert "strict" in report.message


def test_each_world_has_its_own_robot():
    sim, robot = simulation(nworld=2)
    with sim:
        second = fetch_group(robot, world=1)
        assert second.plan({"shoulder_pan_joint": 0.5}).run()
        positions = robot.joints["shoulder_pan_joint"].positions()[:, 0]
        np.testing.assert_allclose(positions, [0.0, 0.5], atol=0.01)
        first = fetch_group(robot)
        assert first.positions[0] == pytest.approx(0.0, abs=0.01)
