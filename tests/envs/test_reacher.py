"""frobs_rl's reaching tasks: arms with the published lengths, and the published rewards."""

from __future__ import annotations

import gymnasium as gym
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

from gazelle.envs.options import SPLITS
from gazelle.envs.reacher.rules import IRB120, IRB140, IRB140_SPEED, UR5
from gazelle.envs.reacher.task import ReachSettings, ReachTask
from gazelle.errors import TaskError

NAMES = ("ABBIRB120Reach", "ABBIRB140Reach", "ABBIRB140VelocityReach", "UR5Reach")
# Denavit-Hartenberg figures of Universal Robots: d, a, alpha.
UR5_DH = [
    (0.089159, 0.0, np.pi / 2),
    (0.0, -0.425, 0.0),
    (0.0, -0.39225, 0.0),
    (0.10915, 0.0, np.pi / 2),
    (0.09465, 0.0, -np.pi / 2),
    (0.0823, 0.0, 0.0),
]


def begun(rules, nworld=1):
    task = ReachTask(rules, nworld, ReachSettings())
    task.seed(0)
    task.begin(np.arange(nworld))
    return task


def posed(task, angles):
    for number, joint in enumerate(task._joints):
        joint.set_position(angles[:, number])
    return task._see(None).tool


def link(theta, d, a, alpha):
    c, s, ca, sa = np.cos(theta), np.sin(theta), np.cos(alpha), np.sin(alpha)
    return np.array(
        [[c, -s * ca, s * sa, a * c], [s, c * ca, -c * sa, a * s], [0, sa, ca, d], [0, 0, 0, 1]]
    )


@pytest.mark.parametrize("name", NAMES)
def test_gymnasiums_checker_finds_nothing(name):
    env = gym.make(f"gazelle/{name}-v0")
    check_env(env.unwrapped, skip_render_check=True)
    env.close()


def test_the_ur5s_tool_is_where_its_makers_figures_put_it():
    """The base frame of Universal Robots looks the other way: x and y are turned by half a turn."""
    task = begun(UR5, 20)
    angles = np.random.default_rng(0).uniform(-3.0, 3.0, (20, 6))
    tool = posed(task, angles)
    for row, found in zip(angles, tool, strict=True):
        whole = np.eye(4)
        for theta, figures in zip(row, UR5_DH, strict=True):
            whole = whole @ link(theta, *figures)
        np.testing.assert_allclose(found, whole[:3, 3] * [-1, -1, 1], atol=1e-6)


@pytest.mark.parametrize(
    ("rules", "shoulder", "bones"),
    [
        (IRB120, (0.0, 0.29), (0.27, np.hypot(0.07, 0.302), 0.072)),
        (IRB140, (0.07, 0.352), (0.36, 0.38, 0.065)),
    ],
)
def test_the_abbs_tools_are_where_their_lengths_put_them(rules, shoulder, bones):
    """In the plane of the arm, with all turns about y, each bone adds its length at its angle."""
    task = begun(rules, 10)
    rng = np.random.default_rng(1)
    angles = np.zeros((10, 6))
    angles[:, [1, 2, 4]] = rng.uniform(-0.8, 0.8, (10, 3))
    first, second, third = np.cumsum(angles[:, [1, 2, 4]], axis=1).T
    # The second bone rises by 0.07 m first in the IRB 120; the zero posture has it look ahead.
    lift = 0.07 if rules is IRB120 else 0.0
    tilt = np.arctan2(lift, np.sqrt(bones[1] ** 2 - lift**2))
    x = shoulder[0] + bones[0] * np.sin(first) + bones[1] * np.cos(second - tilt)
    z = shoulder[1] + bones[0] * np.cos(first) - bones[1] * np.sin(second - tilt)
    x, z = x + bones[2] * np.cos(third), z - bones[2] * np.sin(third)
    wanted = np.column_stack((x, np.zeros(10), z))
    np.testing.assert_allclose(posed(task, angles), wanted, atol=1e-6)


@pytest.mark.long
def test_goals_lie_in_their_box_and_can_be_reached():
    for rules in (IRB120, IRB140, UR5):
        task = begun(rules, 100)
        goals = task.memory["goal"]
        assert (goals >= rules.goal_low).all()
        assert (goals <= rules.goal_high).all()
        assert len(np.unique(goals, axis=0)) > 90


def test_joints_turn_by_what_the_action_says_as_fast_as_they_can():
    task = begun(IRB140, 2)
    task.advance(np.array([[0.3, -0.2, 0.1, 0.5, -0.4, 0.6], [3.0, 0.0, 0.0, 0.0, 0.0, 0.0]]))
    angles = task._see(None).angles
    np.testing.assert_allclose(angles[0], [0.3, -0.2, 0.1, 0.5, -0.4, 0.6], atol=0.02)
    assert angles[1, 0] == pytest.approx(2.618 * 0.5, abs=0.03)  # 2.618 rad/s for half a second


def test_a_speed_holds_and_stops_before_limits():
    task = begun(IRB140_SPEED, 2)
    angles = np.zeros((2, 6))
    angles[1, 0] = 3.14159 - 0.05
    posed(task, angles)
    step = task.advance(np.full((2, 6), 5.0))
    np.testing.assert_allclose(task._see(None).angles[0], np.full(6, 0.02), atol=2e-3)
    assert task._see(None).angles[1, 0] == pytest.approx(angles[1, 0], abs=2e-3)
    assert step.reward[1] - (-step.info["distance"][1]) == pytest.approx(-10.0)


def test_a_speed_holds_for_a_longer_control_period():
    task = ReachTask(IRB140_SPEED, 2, ReachSettings(control_period=1.0))
    task.seed(0)
    task.begin(np.arange(2))
    posed(task, np.zeros((2, 6)))
    task.advance(np.full((2, 6), [[0.1], [-0.2]]))
    wanted = np.tile([[0.1], [-0.2]], (1, 6))
    np.testing.assert_allclose(task._see(None).angles, wanted, atol=2e-3)
    assert task.control_period == 1.0


@pytest.mark.parametrize("period", [0.0, -1.0, np.nan, 61.0, "1 s", True])
def test_a_wrong_control_period_is_refused(period):
    with pytest.raises(TaskError, match="control_period must be a number of seconds"):
        ReachSettings(control_period=period)


@pytest.mark.parametrize("rules", [IRB120, IRB140, IRB140_SPEED, UR5])
def test_rewards_are_the_published_ones(rules):
    task = begun(rules, 16)
    space = task.action_space
    rng = np.random.default_rng(2)
    for _ in range(3):
        step = task.advance(0.3 * rng.uniform(space.low, space.high, (16, 6)))
        seen = task._see(None)
        distance = np.linalg.norm(seen.goal - seen.tool, axis=1)
        low, high = np.array(rules.lower), np.array(rules.upper)
        margin = rules.limit_margin
        limits = ((seen.angles <= low + margin) | (seen.angles >= high - margin)).any(axis=1)
        there = distance <= rules.tolerance
        wanted = np.where(
            there, rules.goal_reward, rules.step_reward - rules.distance_weight * distance
        )
        np.testing.assert_allclose(step.reward, wanted + rules.limit_reward * limits, atol=1e-9)


def test_being_there_is_the_end_and_a_success_but_for_speeds():
    for rules in (IRB120, IRB140_SPEED):
        task = begun(rules, 1)
        task.memory["goal"][:] = task._see(None).tool
        step = task.advance(np.zeros((1, 6)))
        assert step.info["is_success"][0] == step.terminated[0] == rules.ends
    task.max_episode_steps = 3
    assert not task.advance(np.zeros((1, 6))).info["is_success"][0]
    last = task.advance(np.zeros((1, 6)))
    assert last.truncated[0]
    assert last.info["is_success"][0]


@pytest.mark.long
def test_worlds_do_not_know_of_others_and_states_go_on():
    many, one, other = (
        gym.make_vec("gazelle/UR5Reach-v0", num_envs=n, vectorization_mode="vector_entry_point")
        for n in (3, 1, 3)
    )
    np.testing.assert_array_equal(many.reset(seed=9)[0][:1], one.reset(seed=9)[0])
    actions = np.random.default_rng(0).uniform(-1, 1, (8, 3, 6))
    for row in actions[:4]:
        np.testing.assert_array_equal(many.step(row)[0][:1], one.step(row[:1])[0])
    other.reset(seed=1)
    other.unwrapped.set_state(many.unwrapped.get_state())
    for row in actions[4:]:
        np.testing.assert_array_equal(many.step(row)[0], other.step(row)[0])
    for env in (many, one, other):
        env.close()


@pytest.mark.long
def test_held_out_goals_are_other_places_of_the_same_box():
    pools = [ReachTask(IRB140, 1, ReachSettings(goals=kind))._goals for kind in SPLITS]
    np.testing.assert_array_equal(pools[0], pools[1])
    assert not set(map(tuple, pools[0])) & set(map(tuple, pools[2]))
    assert ((pools[2] >= IRB140.goal_low) & (pools[2] <= IRB140.goal_high)).all()
    assert len(pools[2]) == pytest.approx(len(pools[0]), rel=0.1)


def test_policies_are_evaluated_with_goals_that_they_were_not_trained_on():
    env = gym.make("gazelle/UR5Reach-v0")
    assert env.unwrapped.evaluation_options({}) == {"goals": "held-out"}
    env.close()
    with pytest.raises(TaskError, match="there is no kind of goals 'held'"):
        gym.make("gazelle/UR5Reach-v0", goals="held")
