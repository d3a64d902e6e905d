"""The cart and pole: its mechanics, and the rules of openai_ros' task."""

from __future__ import annotations

import gymnasium as gym
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

import gazelle.envs
from gazelle.envs.cartpole.task import CartPoleTask
from gazelle.envs.options import TaskSettings

ID = "gazelle/CartPoleStayUp-v0"


def vector(count, **options):
    return gym.make_vec(ID, num_envs=count, vectorization_mode="vector_entry_point", **options)


def made(nworld=1, **options):
    task = CartPoleTask(nworld, TaskSettings(**options))
    task.seed(0)
    return task


def test_gymnasiums_checker_finds_nothing():
    env = gym.make(ID, render_mode="rgb_array")
    check_env(env.unwrapped)
    env.close()


def test_bounds_are_the_published_ones():
    """Velocities have none: with bounds of 50 they were squeezed, and nothing was learnt."""
    space = made().observation_space
    np.testing.assert_allclose(space.high, [5.0, np.inf, 1.4, np.inf])
    np.testing.assert_array_equal(space.low, -space.high)


def test_a_pole_on_a_cart_that_stands_falls_as_a_rod_does():
    """Energy of a rod about its end: w^2 = 3 g / l (cos a0 - cos a)."""
    task = made(time_step=0.0005)
    task.begin(np.array([0]))
    angle = task.observe(None)[0, 2]
    for _ in range(12):
        task.simulation.run(task.control_period)
    place, speed, fallen, rate = task.observe(None)[0]
    assert abs(place) < 1e-3
    assert abs(speed) < 1e-2
    assert abs(fallen) > 2 * abs(angle)
    wanted = np.sqrt(3 * 9.81 * (np.cos(angle) - np.cos(fallen)))
    assert abs(rate) == pytest.approx(wanted, rel=0.01)


def test_actions_add_up_to_the_velocity_that_is_commanded():
    env = vector(2)
    env.reset(seed=1)
    for actions in ([0, 1], [0, 1], [0, 0]):
        seen, *_ = env.step(np.array(actions))
    np.testing.assert_allclose(seen[:, 1], [-3.0, 1.0], atol=0.05)
    env.close()


def test_moving_under_the_pole_takes_it_back():
    task = made(64)
    task.begin(np.arange(64))
    before = task.observe(None)
    lean = before[:, 2]
    moved = task.advance(np.where(lean > 0, 0, 1))  # a pole that leans left stands right of it
    against = task.advance(np.where(lean > 0, 1, 0))
    assert np.all(np.sign(moved.observation[:, 3]) == -np.sign(lean))
    assert np.all(moved.reward == 1.0)
    assert np.all(against.reward == 1.0)


def test_an_episode_ends_where_the_task_says():
    env = vector(16, max_episode_steps=None, autoreset_mode="Disabled")
    env.reset(seed=3)
    ended = np.zeros(16, bool)
    for _ in range(60):
        seen, reward, terminated, truncated, _ = env.step(np.ones(16, int))
        far = (np.abs(seen[:, 0]) > 1.0) | (np.abs(seen[:, 2]) > 0.7)
        np.testing.assert_array_equal(terminated, far)
        assert not truncated.any()
        assert (reward == 1.0).all()
        ended |= terminated
        if terminated.any():
            env.reset(options={"reset_mask": terminated})
    assert ended.all()
    env.close()


def test_staying_up_to_the_end_is_a_success():
    """A law of four gains keeps it up: on average it commands what they ask for."""
    env = vector(8, max_episode_steps=120)
    seen, _ = env.reset(seed=5)
    commanded = np.zeros(8)
    for _ in range(120):
        wanted = -(seen @ np.array([-0.8, 0.0, 12.0, 3.2])) + 0.2 * commanded
        actions = (wanted > commanded).astype(int)
        commanded += np.where(actions == 0, -1.0, 1.0)
        seen, _, terminated, truncated, info = env.step(actions)
        assert not terminated.any()
    assert truncated.all()
    assert info["final_info"]["is_success"].all()
    env.close()


def test_a_world_does_not_know_of_others():
    actions = np.random.default_rng(0).integers(0, 2, (40, 5))
    many, one = vector(5), vector(1)
    assert np.array_equal(many.reset(seed=9)[0][:1], one.reset(seed=9)[0])
    for row in actions:
        seen = many.step(row)[0]
        np.testing.assert_array_equal(seen[:1], one.step(row[:1])[0])
    many.close()
    one.close()


def test_it_goes_on_from_a_saved_state():
    env, other = vector(3).unwrapped, vector(3).unwrapped
    env.reset(seed=2)
    env.step(np.array([0, 1, 1]))
    other.reset(seed=7)
    other.set_state(env.get_state())
    for actions in ([1, 1, 0], [0, 0, 1]):
        np.testing.assert_array_equal(
            env.step(np.array(actions))[0], other.step(np.array(actions))[0]
        )
    env.close()
    other.close()


@pytest.mark.parametrize("actions", [[0.5], [2], [[0]], [0, 1]])
def test_actions_that_cannot_be_are_refused(actions):
    env = vector(1)
    env.reset(seed=0)
    with pytest.raises(gazelle.TaskError, match="ints from 0 to 1"):
        env.step(np.array(actions))
    env.close()
