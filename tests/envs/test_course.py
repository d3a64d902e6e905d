"""The course of a base whose yaw is not shown: from what was seen and done, and nothing else."""

from __future__ import annotations

import gymnasium as gym
import numpy as np
import pytest

import gazelle.envs
from gazelle.envs.course import CourseTask
from gazelle.envs.wrappers import wrapped

WALL = "gazelle/TurtleBot2Wall-v0"
STEPS = (1, 3)


def vector(count, task=WALL, **options):
    options = {"engine": "planar", "starts": "training", **options}
    return gym.make_vec(task, num_envs=count, vectorization_mode="vector_entry_point", **options)


def test_it_is_the_direction_of_what_was_seen_and_the_share_of_what_was_done():
    env = vector(4, course=STEPS)
    seen = [env.reset(seed=2)[0].astype(float)]
    assert (seen[0][:, 7:] == 0.0).all()
    done = []
    rng = np.random.default_rng(0)
    for _ in range(12):
        done.append(rng.integers(0, 3, 4))
        seen.append(env.step(done[-1])[0].astype(float))
        for number, count in enumerate(STEPS):
            before = seen[max(len(seen) - 1 - count, 0)]
            way = seen[-1][:, 5:7] - before[:, 5:7]
            np.testing.assert_allclose(
                seen[-1][:, 7 + number], np.arctan2(way[:, 1], way[:, 0]), atol=1e-6
            )
            shares = seen[-1][:, 9 + 3 * number : 12 + 3 * number]
            wanted = [
                (np.array(done[-count:]) == action).sum(axis=0) / count for action in range(3)
            ]
            np.testing.assert_allclose(shares, np.transpose(wanted), atol=1e-6)
    env.close()


def test_what_drives_straight_is_told_its_heading():
    env = vector(64, course=(4,))
    env.reset(seed=0)
    for _ in range(4):
        seen = env.step(np.zeros(64, int))[0]
    yaw = env.unwrapped.task.task.robot.planar_pose()[:, 2]
    away = np.abs(np.remainder(seen[:, 7] - yaw + np.pi, 2 * np.pi) - np.pi)
    running = seen[:, 8:11].sum(axis=1) > 0.99  # their episodes did not end meanwhile
    assert running.sum() > 30
    assert away[running].max() < 0.03
    env.close()


def test_without_the_option_the_published_numbers_are_all_that_is_seen():
    plain, more = vector(3), vector(3, course=STEPS)
    assert plain.single_observation_space.shape == (7,)
    assert more.single_observation_space.shape == (7 + len(STEPS) * 4,)
    np.testing.assert_array_equal(plain.reset(seed=1)[0], more.reset(seed=1)[0][:, :7])
    for _ in range(5):
        actions = np.ones(3, int)
        first, second = plain.step(actions), more.step(actions)
        np.testing.assert_array_equal(first[0], second[0][:, :7])
        np.testing.assert_array_equal(first[1], second[1])
    plain.close()
    more.close()


@pytest.mark.parametrize(
    ("task", "course"),
    [(WALL, (0,)), (WALL, "4"), (WALL, 4), ("gazelle/TurtleBot2Maze-v0", (4,))],
)
def test_courses_that_cannot_be_are_refused(task, course):
    with pytest.raises(gazelle.TaskError):
        vector(1, task, course=course)


def test_it_is_for_a_few_actions_and_places_that_are_seen():
    with pytest.raises(gazelle.TaskError, match="entry 7"):
        wrapped(vector(1), CourseTask, x=5, y=7, steps=STEPS)
    arm = gym.make("gazelle/UR5Reach-v0")
    with pytest.raises(gazelle.TaskError, match="few actions"):
        wrapped(arm, CourseTask, x=3, y=4, steps=STEPS)
    arm.close()
