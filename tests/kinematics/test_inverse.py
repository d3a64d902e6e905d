"""Inverse kinematics: found where a pose can be reached, within limits, the same again."""

import arms
import numpy as np
import pytest

from gazelle.description import Pose
from gazelle.errors import PlanningError
from gazelle.kinematics import InverseKinematics


def reachable(robot, group, count, seed=0):
    """Return poses of the group's tip at random positions within the limits."""
    full = np.tile(robot.zero(), (count, 1))
    full[:, group.columns] = group.sample(np.random.default_rng(seed), count)
    return robot.forward(full, group.tip)


def errors(robot, group, positions, wanted):
    """Return distances and angles between the tip and its target."""
    full = np.tile(robot.zero(), (len(positions), 1))
    full[:, group.columns] = positions
    found = robot.forward(full, group.tip)
    turned = np.swapaxes(found[:, :3, :3], 1, 2) @ wanted[:, :3, :3]
    axis = np.stack(
        [turned[:, 2, 1] - turned[:, 1, 2], turned[:, 0, 2] - turned[:, 2, 0],
         turned[:, 1, 0] - turned[:, 0, 1]], axis=1
    )  # fmt: skip
    sine = np.linalg.norm(axis, axis=1) / 2.0
    cosine = (np.trace(turned, axis1=1, axis2=2) - 1.0) / 2.0
    moved = np.linalg.norm(found[:, :3, 3] - wanted[:, :3, 3], axis=1)
    return moved, np.arctan2(sine, cosine)


@pytest.mark.parametrize("name", arms.ARMS)
def test_poses_that_can_be_reached_are(name):
    robot, group = arms.arm_group(name)
    wanted = reachable(robot, group, 1000)
    found = InverseKinematics(robot, group).solve_many(wanted)
    assert found.found.mean() >= 0.999
    positions = found.positions[found.found]
    assert not [text for row in positions for text in group.beyond(row)]
    moved, turned = errors(robot, group, positions, wanted[found.found])
    assert moved.max() <= 1e-5
    assert turned.max() <= 1e-5


@pytest.mark.parametrize("aim", ["position", "orientation"])
def test_a_part_of_a_pose(aim):
    robot, group = arms.arm_group("fetch")
    wanted = reachable(robot, group, 200)
    found = InverseKinematics(robot, group, aim=aim).solve_many(wanted)
    assert found.found.all()
    moved, turned = errors(robot, group, found.positions, wanted)
    asked, other = (moved, turned) if aim == "position" else (turned, moved)
    assert asked.max() <= 1e-5
    assert other.max() > 0.1


def test_it_starts_at_the_state_it_is_given():
    robot, group = arms.arm_group("panda")
    state = robot.zero()
    state[group.columns] = group.positions([0.1, -0.7, 0.0, -2.3, 0.0, 1.6, 0.7], np.zeros(7))
    pose = robot.pose(state, group.tip) * Pose(0.0, 0.0, 0.02)
    found = InverseKinematics(robot, group).solve(pose, state)
    assert np.abs(found - state[group.columns]).max() < 0.2
    exact = InverseKinematics(robot, group).solve(robot.pose(state, group.tip), state)
    np.testing.assert_array_equal(exact, state[group.columns])


def test_endless_joints_stay_near_where_they_are():
    robot, group = arms.arm_group("fetch")
    state = robot.zero()
    state[group.columns] = [0.2, 0.3, 40.0, 1.0, -30.0, 0.5, 0.1]
    pose = robot.pose(state, group.tip) * Pose(0.01, 0.02, -0.03, 0.1, 0.2, 0.3)
    found = InverseKinematics(robot, group).solve(pose, state)
    assert np.abs(found - state[group.columns]).max() <= np.pi + 1e-9


def test_a_pose_has_one_solution_whatever_else_is_asked():
    robot, group = arms.arm_group("iiwa")
    wanted = reachable(robot, group, 50)
    solver = InverseKinematics(robot, group, seed=4)
    together = solver.solve_many(wanted)
    again = InverseKinematics(robot, group, seed=4).solve_many(wanted[::-1])
    np.testing.assert_array_equal(together.positions, again.positions[::-1])
    alone = solver.solve(Pose.from_matrix(wanted[3]))
    np.testing.assert_allclose(alone, together.positions[3], atol=1e-6)


def test_what_is_refused_is_looked_for_elsewhere():
    robot, group = arms.arm_group("ur5")
    pose = Pose.from_matrix(reachable(robot, group, 1)[0])
    solver = InverseKinematics(robot, group)
    seen = []

    def third(positions):
        seen.append(positions)
        return len(seen) == 3

    found = solver.solve(pose, valid=third)
    assert len(seen) == 3
    np.testing.assert_array_equal(found, seen[-1])
    assert solver.solve(pose, valid=lambda _: False) is None


def test_half_a_turn_away():
    robot, group = arms.arm_group("panda")
    state = robot.zero()
    state[group.columns] = [0.0, 0.4, 0.0, -1.8, 0.0, 2.2, 0.0]
    for axis in np.eye(3):
        turned = Pose.from_quaternion((0, 0, 0), (*axis, 0.0))
        pose = robot.pose(state, group.tip) * turned
        found = InverseKinematics(robot, group, aim="orientation").solve(pose, state)
        assert found is not None
        state_there = state.copy()
        state_there[group.columns] = found
        there = Pose.from_quaternion((0, 0, 0), robot.pose(state_there, group.tip).quaternion)
        assert there.is_close(Pose.from_quaternion((0, 0, 0), pose.quaternion), angle=2e-5)


def test_out_of_reach():
    robot, group = arms.arm_group("ur5")
    assert InverseKinematics(robot, group, attempts=5).solve(Pose(3.0, 0.0, 0.0)) is None
    found = InverseKinematics(robot, group, attempts=5).solve_many(Pose(3.0).matrix()[None])
    assert not found.found.any()
    assert np.isnan(found.positions).all()
    assert found.attempts.tolist() == [5]


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"aim": "place"}, "aim must be one of"),
        ({"attempts": 0}, "attempts and tolerances"),
        ({"tolerance": (0.0, 1.0)}, "above zero"),
        ({"link": "head_pan_link"}, "no joint of the group 'arm' moves 'head_pan_link'"),
        ({"link": "hand"}, "no link 'hand'"),
    ],
)
def test_arguments_that_cannot_be(options, words):
    robot, group = arms.arm_group("fetch")
    with pytest.raises(PlanningError, match=words):
        InverseKinematics(robot, group, **options)


def test_poses_have_a_shape():
    robot, group = arms.arm_group("fetch")
    with pytest.raises(PlanningError, match="the shape"):
        InverseKinematics(robot, group).solve_many(np.eye(4))


@pytest.mark.parametrize("name", arms.ARMS)
def test_poses_a_little_way_off_are_followed_from_many_states(name):
    """As near as a descent leads from each state, without a jump to another branch."""
    robot, group = arms.arm_group(name)
    rng = np.random.default_rng(5)
    states = np.tile(robot.zero(), (200, 1))
    middle = np.clip(group.sample(rng, 200) * 0.5, group.lower + 0.2, group.upper - 0.2)
    states[:, group.columns] = middle
    near = states.copy()
    near[:, group.columns] += rng.uniform(-0.05, 0.05, middle.shape)
    wanted = robot.forward(near, group.tip)
    ik = InverseKinematics(robot, group)
    found = ik.follow(wanted, states)
    moved, turned = errors(robot, group, found, wanted)
    assert (moved < 1e-4).mean() > 0.97
    assert (turned < 1e-4).mean() > 0.97
    assert np.median(np.abs(found - middle).max(axis=1)) < 0.15
    np.testing.assert_array_equal(ik.follow(wanted[7:8], states[7:8])[0], found[7])
    np.testing.assert_array_equal(ik.follow(wanted[:3], states[0])[0], found[0])
    assert not [text for row in found for text in group.beyond(row)]


@pytest.mark.parametrize("ahead", [0.05, 0.3, 1.0, 3.0])
def test_what_is_out_of_reach_is_never_farther_away_than_before(ahead):
    robot, group = arms.arm_group("fetch")
    state = robot.zero()
    state[group.columns] = (0.0, 0.3, 0.0, 0.5, 0.0, 0.3, 0.0)
    far = robot.forward(state[None], group.tip)
    far[:, 0, 3] += ahead
    found = InverseKinematics(robot, group, aim="position").follow(far, state)
    after = errors(robot, group, found, far)[0]
    assert np.isfinite(found).all()
    assert after[0] <= ahead + 1e-12
    assert not group.beyond(found[0])


@pytest.mark.parametrize(
    ("poses", "states", "words"),
    [((3, 4), None, "poses have the shape"), ((3, 4, 4), (2, 5), "states have the shape")],
)
def test_shapes_to_follow_are_checked(poses, states, words):
    robot, group = arms.arm_group("fetch")
    given = robot.zero() if states is None else np.zeros(states)
    with pytest.raises(PlanningError, match=words):
        InverseKinematics(robot, group).follow(np.zeros(poses), given)
