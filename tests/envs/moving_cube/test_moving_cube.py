"""The cube that walks: its mechanics, and the rules of openai_ros' task."""

from __future__ import annotations

import gymnasium as gym
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

import gazelle.envs
from gazelle.envs.moving_cube.task import MovingCubeSettings, MovingCubeTask
from gazelle.rotations import roll_pitch_yaw

ID = "gazelle/MovingCubeOneDiskWalk-v0"
FORWARD, BACKWARD, STOP = 0, 1, 2


def vector(count, **options):
    return gym.make_vec(ID, num_envs=count, vectorization_mode="vector_entry_point", **options)


def begun(nworld=1, **options):
    task = MovingCubeTask(nworld, MovingCubeSettings(**options))
    task.seed(0)
    task.begin(np.arange(nworld))
    return task


def played(task, actions):
    return [task.advance(np.full(task.nworld, action)) for action in actions]


def test_gymnasiums_checker_finds_nothing():
    env = gym.make(ID, render_mode="rgb_array")
    check_env(env.unwrapped)
    env.close()


def test_a_jump_of_the_wheels_speed_turns_the_cube_by_its_angular_momentum():
    """About the edge: L = I_wheel * jump; it rises until the turning is used up by gravity."""
    task = begun(1, time_step=0.001)
    played(task, [STOP] * 25)
    heights = []
    for _ in range(6):
        task.advance(np.array([FORWARD]))
        placement = task._cube.placement(None)
        heights.append(placement.position[0, 2])
    wheel, side, mass = 0.5 * 0.08**2 / 2, 0.2, 0.5
    # The cube with the wheel's mass in its middle (along x), about an edge.
    about = mass * side**2 / 6 + 2 * mass * (side**2 / 2)
    about += mass * 0.08**2 / 2  # the wheel turns with the cube once its motor holds it
    momentum = wheel * 50.0
    risen = 0.5 * momentum**2 / about / (2 * mass * 9.81)
    assert max(heights) - side / 2 == pytest.approx(risen, rel=0.2)
    assert task.observe(None)[0, 2] <= 0.0  # it rocks towards +y


def test_a_jump_by_a_hundred_rolls_it_over_and_by_fifty_does_not():
    task = begun(1)
    played(task, [STOP] * 25)
    assert abs(played(task, [FORWARD] * 30)[-1].observation[0, 1]) < 0.05
    played(task, [STOP] * 25 + [BACKWARD] * 25)
    steps = played(task, [FORWARD] * 30)
    y = steps[-1].observation[0, 1]
    assert y == pytest.approx(0.2, abs=0.051)
    assert sum(step.reward[0] for step in steps) > 300


def test_speeding_up_at_once_and_slowing_down_in_two_steps_walks():
    """As its friction is published, it stays on its way: 1 m in 200 steps, from any start."""
    task = begun(8)
    actions = [STOP] * 12 + [BACKWARD] * 12 + [FORWARD] * 12
    steps = played(task, actions * 6)
    assert not any(step.terminated.any() for step in steps)
    np.testing.assert_allclose(steps[-1].observation[:, 1], 1.2, atol=0.051)
    assert (steps[-1].info["distance"] == 0.0).all()
    placement = task._cube.placement(None)
    turned = roll_pitch_yaw(placement.quaternion)[:, 2] - task.memory["start"][:, 0]
    assert np.abs(turned).max() < 0.01


def test_what_is_left_to_walk_is_told_from_the_start():
    env = vector(2)
    info = env.reset(seed=0)[1]
    assert info["distance"].tolist() == [1.0, 1.0]
    assert not info["is_success"].any()
    env.close()


def test_the_reward_is_the_published_sum_of_rounded_parts():
    task = begun(4)
    before = task.observe(None)
    rng = np.random.default_rng(1)
    for _ in range(60):
        step = task.advance(rng.integers(0, 3, 4))
        for world, seen in enumerate(step.observation.astype(float).round(1).tolist()):
            moved = seen[1] - round(float(before[world, 1]), 1)
            wanted = round(moved * 100, 0) + round(seen[4] * 100, 0)
            wanted += round(-abs(np.sin(seen[5])) * 100, 0)
            ended = abs(seen[3]) > 0.3 or abs(seen[5]) > 0.3
            assert step.terminated[world] == ended
            assert step.reward[world] == (10.0 if ended else wanted)
        before = step.observation.astype(float)


def test_tilting_too_far_earns_ten_as_published_or_what_is_asked_for():
    for options, wanted in (({}, 10.0), ({"failure_reward": -10.0}, -10.0)):
        task = begun(1, **options)
        task._cube.set_pose((0.0, 0.0, 0.1), yaw=0.5)
        step = task.advance(np.array([STOP]))
        assert step.terminated[0]
        assert step.reward[0] == wanted


def test_five_actions_add_and_take_speed_within_bounds():
    task = begun(2, n_actions=5)
    played(task, [STOP])
    for actions, wanted in (
        ([3, 4], [10, -10]),
        ([3, 4], [20, -20]),
        ([0, 1], [50, -50]),
        ([3, 4], [50, -50]),
    ):
        step = task.advance(np.array(actions))
        np.testing.assert_array_equal(step.observation[:, 0], wanted)


def test_steps_with_the_same_command_are_shown_if_asked_for():
    shown, plain = (begun(2, n_actions=5, shows_hold=shows) for shows in (True, False))
    np.testing.assert_array_equal(shown.observe(None)[:, 6], 0.0)
    held = []
    for first in [STOP, STOP, BACKWARD, *[FORWARD] * 30, 3, 4]:  # it is no faster than 50
        actions = np.array([first, STOP])
        seen, published = (task.advance(actions).observation for task in (shown, plain))
        np.testing.assert_array_equal(seen[:, :6], published)
        held.append(seen[:, 6])
    both = np.transpose(held)
    assert both[0].tolist() == [0, 1, 0, *range(25), *[25] * 6, 0]
    assert both[1].tolist() == [*range(26), *[25] * 9]
    shown.begin(np.array([1]))
    assert shown.observe(None)[:, 6].tolist() == [0, 0]
    assert shown.observe(np.array([0]))[:, 6].tolist() == [0]


@pytest.mark.parametrize(
    "options",
    [{"n_actions": 4}, {"failure_reward": np.nan}, {"n_action": 3}, {"shows_hold": 1}],
)
def test_options_that_cannot_be_are_refused(options):
    with pytest.raises(gazelle.TaskError):
        gym.make(ID, **options)


def test_a_world_does_not_know_of_others_and_goes_on_from_a_saved_state():
    many, one, other = vector(3), vector(1), vector(3).unwrapped
    assert np.array_equal(many.reset(seed=9)[0][:1], one.reset(seed=9)[0])
    actions = np.random.default_rng(0).integers(0, 3, (20, 3))
    for row in actions[:10]:
        np.testing.assert_array_equal(many.step(row)[0][:1], one.step(row[:1])[0])
    other.reset(seed=1)
    other.set_state(many.unwrapped.get_state())
    for row in actions[10:]:
        np.testing.assert_array_equal(many.step(row)[0], other.step(row)[0])
    for env in (many, one, other):
        env.close()
