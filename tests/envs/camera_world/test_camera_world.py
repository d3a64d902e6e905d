"""Finding the red post by sight: what is seen, where things stand, and what comes of a step."""

from __future__ import annotations

import gymnasium as gym
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

from gazelle.envs.camera_world import task as rules
from gazelle.envs.camera_world.task import CameraWorldTask
from gazelle.envs.options import TaskSettings

ID = "gazelle/TurtleBot3CameraWorld-v0"
AHEAD, LEFT, RIGHT = range(3)


def vector(count, **options):
    options = {"engine": "planar", **options}
    return gym.make_vec(ID, num_envs=count, vectorization_mode="vector_entry_point", **options)


@pytest.fixture(scope="module")
def begun():
    """Yield a task of many worlds at the start of its episodes, and its observation."""
    task = CameraWorldTask(200, TaskSettings(engine="planar", seed=0))
    seen, info = task.begin(np.arange(200))
    yield task, seen, info["scenario"]
    task.close()


@pytest.mark.long
@pytest.mark.parametrize("engine", ["planar", "mujoco"])
def test_gymnasiums_checker_finds_nothing(engine):
    env = gym.make(ID, engine=engine, render_mode="rgb_array")
    check_env(env.unwrapped)
    assert env.observation_space == gym.spaces.Box(0, 255, (84, 84, 3), np.uint8)
    env.close()


def test_things_stand_apart_and_anywhere(begun):
    _, _, scene = begun
    spots = np.column_stack([scene[:, :2], scene[:, 3:]]).reshape(-1, 4, 2)
    assert np.abs(spots).max() <= rules.ROOM
    away = np.linalg.norm(spots[:, :, None] - spots[:, None], axis=-1)
    assert away[:, 0, 1].min() >= rules.APART[0]
    apart = away[:, [0, 0, 1, 1, 2], [2, 3, 2, 3, 3]]
    assert (apart >= rules.APART[1]).mean() > 0.995  # of sixteen tries one nearly always fits
    assert spots.min() < -1.3
    assert spots.max() > 1.3
    assert np.ptp(scene[:, 2]) > 6.0


def test_the_red_post_is_seen_where_it_is(begun):
    """In pinhole geometry: columns of the picture are the tangents of bearings."""
    _, seen, scene = begun
    away = scene[:, 3:5] - scene[:, :2]
    bearing = np.arctan2(away[:, 1], away[:, 0]) - scene[:, 2]
    bearing = (bearing + np.pi) % (2 * np.pi) - np.pi
    red = (seen[..., 0] > 90) & (seen[..., 1] < 60) & (seen[..., 2] < 60)
    found = red.any(axis=(1, 2))
    assert not found[np.abs(bearing) > 0.85].any()  # half the view and half the post
    centre = (red * np.arange(84)).sum(axis=(1, 2)) / np.maximum(red.sum(axis=(1, 2)), 1)
    # Posts in front of it hide some; of the rest the middle is where the bearing says.
    wanted = 41.5 - 42 / np.tan(1.085595 / 2) * np.tan(bearing)
    inside = found & (np.abs(bearing) < 0.4)
    assert inside.sum() > 20
    assert np.median(np.abs(centre - wanted)[inside]) < 3.0


def test_equal_seeds_see_the_same_whatever_the_number_of_worlds():
    pictures = []
    for count in (1, 3):
        env = vector(count, threads=count)
        seen, _ = env.reset(seed=5)
        pictures.append([seen[0]])
        for action in (LEFT, AHEAD, RIGHT):
            pictures[-1].append(env.step(np.full(count, action))[0][0])
        env.close()
    np.testing.assert_array_equal(*pictures)


def placed(task, robot, red, others=((1.4, 1.4), (1.4, -1.4)), yaw=0.0):
    """Place everything in world 0."""
    task.begin(np.arange(task.nworld))
    for post, spot in zip(task._posts, (red, *others), strict=True):
        post.set_pose(np.array([*spot, 0.0]), worlds=np.array([0]))
    task._robot.set_pose(np.array([*robot, 0.0]), yaw=yaw, worlds=np.array([0]))
    task.memory["scene"][0] = [*robot, yaw, *red, *others[0], *others[1]]
    for name, values in zip(("distance", "bearing"), task._goal(), strict=True):
        task.memory[name][:] = values


@pytest.mark.parametrize("engine", ["planar", "mujoco"])
def test_ends_and_rewards(engine):
    task = CameraWorldTask(1, TaskSettings(engine=engine, seed=0))
    placed(task, (0.0, 0.0), (0.55, 0.0))
    for _ in range(3):
        before = task.memory["distance"][0]
        step = task.advance([AHEAD])
        if step.terminated[0]:
            break
    nearer = before - task.memory["distance"][0]
    assert step.info["is_success"][0]
    assert step.reward[0] == pytest.approx(2.0 * nearer - 0.02 + 5.0, abs=0.02)
    placed(task, (0.0, 0.0), (-1.0, 0.0), others=((0.4, 0.0), (1.4, 1.4)))
    while not (step := task.advance([AHEAD])).terminated[0]:
        pass
    assert step.info["is_collision"][0]
    assert not step.info["is_success"][0]
    placed(task, (1.4, 0.0), (-1.0, 0.0), others=((-1.4, -1.4), (-1.4, 1.4)))
    while not (step := task.advance([AHEAD])).terminated[0]:
        pass
    assert step.info["is_collision"][0]
    placed(task, (0.0, 0.0), (0.0, 1.3))
    for _ in range(3):
        task.advance([AHEAD])
        step = task.advance([LEFT])
    assert 0.0 < step.reward[0] < 0.2
    assert not step.terminated[0]
    task.close()


def test_an_episode_runs_out_of_time():
    env = vector(4)
    env.reset(seed=0)
    for _ in range(119):
        *_, truncated, _ = env.step(np.full(4, LEFT))
        assert not truncated.any()
    *_, terminated, truncated, info = env.step(np.full(4, LEFT))
    assert truncated.all()
    assert info["final_info"]["is_timeout"].all()
    assert not terminated.any()
    env.close()
