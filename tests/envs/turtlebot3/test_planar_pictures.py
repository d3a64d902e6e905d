"""Environments in the plane draw what those in three dimensions draw."""

import gymnasium as gym
import numpy as np

import gazelle.envs  # noqa: F401  # registers the environments

STAGE1 = "gazelle/TurtleBot3Stage1-v0"


def made(engine):
    env = gym.make(STAGE1, engine=engine, render_mode="rgb_array", goals=[(1.0, 0.5)])
    env.reset(seed=0)
    return env


def test_a_picture_is_that_of_three_dimensions():
    flat, deep = made("planar"), made("mujoco")
    ours, theirs = flat.render(), deep.render()
    assert ours.shape == theirs.shape
    assert ours.dtype == np.uint8
    off = np.abs(ours.astype(int) - theirs).max(axis=2)
    assert (off > 40).mean() < 0.005
    flat.close()
    deep.close()


def test_the_robot_moves_in_the_picture():
    env = made("planar")
    before = env.render()
    for _ in range(6):
        env.step(2)  # straight ahead
    changed = np.abs(env.render().astype(int) - before).max(axis=2) > 40
    assert 20 < changed.sum() < 0.05 * changed.size
    env.close()


def test_each_world_of_a_vector_has_a_picture():
    env = gym.make_vec(
        STAGE1,
        num_envs=3,
        engine="planar",
        render_mode="rgb_array",
        vectorization_mode="vector_entry_point",
    )
    env.reset(seed=0)
    for _ in range(6):
        env.step(np.array([0, 2, 4]))
    pictures = env.render()
    assert len(pictures) == 3
    assert len({picture.tobytes() for picture in pictures}) == 3
    env.close()
