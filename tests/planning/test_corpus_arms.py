"""Other people's arms, with their own SRDF and meshes: Panda, UR5, Fetch, xArm 7."""

import os
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
import pytest

import gazelle
from gazelle.description import Box, Joint, Pose
from gazelle.formats import load_mesh, load_model, load_srdf
from gazelle.kinematics import InverseKinematics, RobotModel
from gazelle.planning import (
    AllowedCollisionMatrix,
    Group,
    MotionPlanner,
    PlanningScene,
    PlanOptions,
)
from gazelle.planning.robot_bodies import shapes_of
from gazelle.planning.state_validity import StateValidity


@dataclass(frozen=True)
class PublicArm:
    """Files of an arm.

    Attributes:
        urdf: Its description.
        srdf: Of its package for MoveIt.
        group: The arm.
        arguments: Of the xacro file.
    """

    urdf: str
    srdf: str
    group: str
    arguments: Mapping[str, str] = field(default_factory=dict)


ARMS = {
    "panda": PublicArm(
        "moveit__moveit_resources/panda_description/urdf/panda_arm_hand.urdf.xacro",
        "moveit__moveit_resources/panda_moveit_config/config/panda.srdf",
        "panda_arm",
    ),
    "ur5": PublicArm(
        "ros-industrial__universal_robot/ur_description/urdf/ur5.xacro",
        "ros-industrial__universal_robot/ur5_moveit_config/config/ur5.srdf",
        "manipulator",
    ),
}
OTHERS = {
    "fetch": PublicArm(
        "fetch_ros/fetch_description/robots/fetch.urdf",
        "fetch_ros/fetch_moveit_config/config/fetch.srdf",
        "arm",
    ),
    "xarm7": PublicArm(
        "xarm_ros/xarm_description/urdf/xarm_device.urdf.xacro",
        "xarm_ros/xarm7_moveit_config/config/xarm7.srdf",
        "xarm7",
        {"robot_type": "xarm", "dof": "7", "limited": "true"},
    ),
}
"""Of checkouts in the folder that ``GAZELLE_ROBOTS`` names; the others are of the corpus."""


PREFIX = "hardware_interface/"


def model_of(name, request):
    """Return the description, and the text of the SRDF."""
    if name in OTHERS:
        arm, folder = OTHERS[name], Path(os.environ.get("GAZELLE_ROBOTS", ""))
        if not (folder / arm.urdf).is_file():
            pytest.skip(f"no checkout of {arm.urdf.split('/')[0]} is at hand (set GAZELLE_ROBOTS)")
    else:
        arm, folder = ARMS[name], request.getfixturevalue("corpus")
    paths = [folder / arm.urdf.split("/")[0]]
    made = load_model(folder / arm.urdf, paths=paths, xacro_args=dict(arm.arguments))
    return made, load_srdf(folder / arm.srdf), arm.group


def load(name, request):
    model, semantics, group = model_of(name, request)
    robot = RobotModel(model, semantics)
    return robot, robot.group(group)


def free_positions(scene, group, count):
    """Return valid positions of the group."""
    valid, random = StateValidity(scene, group, scene.robot.zero()), np.random.default_rng(0)
    return [each for each in group.sample(random, 500) if valid(each)][:count]


def held(model, root):
    """Return the same robot with its root held by the world."""
    if any(joint.parent == "world" for joint in model.joints):
        return model
    return replace(model, joints=(Joint("held", "fixed", "world", root), *model.joints))


def intersect(first, second):
    """Return whether the convex hulls of points share a point: a weighted mean of both."""
    linprog = pytest.importorskip("scipy.optimize").linprog
    a, b = len(first), len(second)
    rows = np.zeros((5, a + b))
    rows[:3, :a], rows[:3, a:] = first.T, -second.T
    rows[3, :a] = rows[4, a:] = 1.0
    return linprog(np.zeros(a + b), A_eq=rows, b_eq=[0, 0, 0, 1, 1], bounds=(0, None)).status == 0


@pytest.mark.filterwarnings("ignore::gazelle.errors.GazelleWarning")
@pytest.mark.parametrize("name", [*ARMS, *OTHERS])
def test_reachable_poses_are_reached(name, request):
    robot, group = load(name, request)
    states = np.tile(robot.zero(), (500, 1))
    states[:, group.columns] = group.sample(np.random.default_rng(0), 500)
    wanted = robot.forward(states, group.tip)
    assert InverseKinematics(robot, group).solve_many(wanted).found.mean() >= 0.999


@pytest.mark.long
@pytest.mark.filterwarnings("ignore::gazelle.errors.GazelleWarning")
def test_meshes_collide_where_their_hulls_share_a_point(request):
    """All of Panda's meshes are convex to a hundredth of a millimetre."""
    robot, group = load("panda", request)
    scene = PlanningScene(robot)
    shapes = shapes_of(robot)
    points = {
        name: load_mesh(parts[0][0].geometry).vertices @ parts[0][1].matrix()[:3, :3].T
        + parts[0][1].position
        for name, parts in shapes.items()
        if parts
    }
    scene.allowed = AllowedCollisionMatrix()
    joints = {name: link.joint for name, link in robot.links.items()}
    pairs = [
        (a, b) for i, a in enumerate(points) for b in list(points)[:i] if joints[a] != joints[b]
    ]
    state, seen = robot.zero(), 0
    for drawn in group.sample(np.random.default_rng(2), 4):
        state[group.columns] = drawn
        found = {frozenset((c.first, c.second)): c.depth for c in scene.contacts(state)}
        for pair in pairs:
            frames = [robot.forward(state, link) for link in pair]
            hulls = [
                points[link] @ frame[:3, :3].T + frame[:3, 3]
                for link, frame in zip(pair, frames, strict=True)
            ]
            depth = found.get(frozenset(pair), 0.0)
            if 0.0 < depth < 1e-4:
                continue  # too close to call
            assert (depth > 0.0) == intersect(*hulls), (pair, depth)
            seen += depth > 0.0
    assert 20 <= seen < 4 * len(pairs)


@pytest.mark.filterwarnings("ignore::gazelle.errors.GazelleWarning")
@pytest.mark.parametrize("name", [*ARMS, *OTHERS])
def test_plans_among_obstacles(name, request):
    robot, group = load(name, request)
    scene = PlanningScene(robot)
    scene.add("table", Box((0.6, 1.4, 0.05)), Pose(0.65, 0.0, 0.1))
    scene.add("box", Box((0.15, 0.15, 0.35)), Pose(0.5, 0.2, 0.3))
    free = free_positions(scene, group, 10)
    state = robot.zero()
    for number in range(0, 10, 2):
        state[group.columns] = free[number]
        options = PlanOptions(seed=number, time=60.0)
        plan = MotionPlanner(scene, group, options).plan(free[number + 1], start=state)
        fine = StateValidity(scene, group, state)
        assert fine.path(plan.trajectory.positions, fine.resolution / 10.0)


@pytest.mark.long
@pytest.mark.filterwarnings("ignore::gazelle.errors.GazelleWarning")
@pytest.mark.parametrize("name", [*ARMS, *OTHERS])
def test_it_follows_its_plans_in_simulation(name, request):
    """Held to the world by its root, its arm under a trajectory controller."""
    model, semantics, group = model_of(name, request)
    planned = RobotModel(model, semantics)
    joints = list(planned.group(group).names)
    floor, below = Box((4.0, 4.0, 0.1)), Pose(z=-0.06)
    scene = PlanningScene(planned)
    scene.add("floor", floor, below)
    free = free_positions(scene, planned.group(group), 2)
    with gazelle.Simulation("empty") as sim:
        robot = sim.spawn(held(model, planned.root))
        gains = {joint: {"p": 20.0} for joint in joints}
        offered = robot.controllers.hardware.interfaces
        # Panda's links have no inertials: a kilogramme each is too much for its motors.
        moves = name != "panda" and f"{PREFIX}VelocityJointInterface" in offered
        way = "Velocity" if moves else "Position"
        kind = f"{way.lower()}_controllers/JointTrajectoryController"
        forward = dict.fromkeys(joints, 1.0)
        told = {"type": kind, "joints": joints, "gains": gains, "velocity_ff": forward}
        robot.controllers.load("arm_controller", told)
        robot.controllers.start("arm_controller")
        robot.set_configuration(joints, free[0])
        arm = Group(robot, group, semantics=semantics, options=PlanOptions(velocity=0.5))
        arm.scene.add("floor", floor, below)
        report = arm.go(free[1])
        assert report, report.message
        away = arm.model.difference(arm.positions, free[1])
        assert np.abs(away).max() < 0.02
