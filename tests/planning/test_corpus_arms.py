"""Other people's arms, with their own SRDF and meshes: Panda and UR5."""

import numpy as np
import pytest

from gazelle.description import Box, Pose
from gazelle.formats import load_mesh, load_model, load_srdf
from gazelle.planning import (
    AllowedCollisionMatrix,
    InverseKinematics,
    MotionPlanner,
    PlanningScene,
    PlanOptions,
    RobotModel,
)
from gazelle.planning.robot_bodies import shapes_of
from gazelle.planning.state_validity import StateValidity

pytestmark = pytest.mark.corpus
ARMS = {
    "panda": (
        "moveit__moveit_resources/panda_description/urdf/panda_arm_hand.urdf.xacro",
        "moveit__moveit_resources/panda_moveit_config/config/panda.srdf",
        "panda_arm",
    ),
    "ur5": (
        "ros-industrial__universal_robot/ur_description/urdf/ur5.xacro",
        "ros-industrial__universal_robot/ur5_moveit_config/config/ur5.srdf",
        "manipulator",
    ),
}
"""Description, SRDF, and the arm's group."""


def load(name, corpus):
    urdf, srdf, group = ARMS[name]
    folders = [corpus / urdf.split("/")[0]]
    robot = RobotModel(load_model(corpus / urdf, paths=folders), load_srdf(corpus / srdf))
    return robot, robot.group(group)


def intersect(first, second):
    """Whether the convex hulls of points share a point: one that both are weighted means to."""
    linprog = pytest.importorskip("scipy.optimize").linprog
    a, b = len(first), len(second)
    rows = np.zeros((5, a + b))
    rows[:3, :a], rows[:3, a:] = first.T, -second.T
    rows[3, :a] = rows[4, a:] = 1.0
    return linprog(np.zeros(a + b), A_eq=rows, b_eq=[0, 0, 0, 1, 1], bounds=(0, None)).status == 0


@pytest.mark.filterwarnings("ignore::gazelle.errors.GazelleWarning")
@pytest.mark.parametrize("name", ARMS)
def test_reachable_poses_are_reached(name, corpus):
    robot, group = load(name, corpus)
    states = np.tile(robot.zero(), (500, 1))
    states[:, group.columns] = group.sample(np.random.default_rng(0), 500)
    wanted = robot.forward(states, group.tip)
    assert InverseKinematics(robot, group).solve_many(wanted).found.mean() >= 0.999


@pytest.mark.filterwarnings("ignore::gazelle.errors.GazelleWarning")
def test_meshes_collide_where_their_hulls_share_a_point(corpus):
    """All of Panda's meshes are convex to a hundredth of a millimetre."""
    robot, group = load("panda", corpus)
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
@pytest.mark.parametrize("name", ARMS)
def test_plans_among_obstacles(name, corpus):
    robot, group = load(name, corpus)
    scene = PlanningScene(robot)
    scene.add("table", Box((0.6, 1.4, 0.05)), Pose(0.65, 0.0, 0.1))
    scene.add("box", Box((0.15, 0.15, 0.35)), Pose(0.5, 0.2, 0.3))
    valid, random, free = StateValidity(scene, group, robot.zero()), np.random.default_rng(0), []
    while len(free) < 10:
        drawn = group.sample(random, 1)[0]
        if valid(drawn):
            free.append(drawn)
    state = robot.zero()
    for number in range(0, 10, 2):
        state[group.columns] = free[number]
        options = PlanOptions(seed=number, time=60.0)
        plan = MotionPlanner(scene, group, options).plan(free[number + 1], start=state)
        fine = StateValidity(scene, group, state)
        assert fine.path(plan.trajectory.positions, fine.resolution / 10.0)
