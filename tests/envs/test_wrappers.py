"""Tasks around tasks: what is shown and done, in single and vector environments and all ways of autoreset."""

from __future__ import annotations

import copy
import pickle

import gymnasium as gym
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from gymnasium.wrappers import FrameStackObservation

import gazelle.envs
from gazelle.envs import TaskVectorEnv
from gazelle.envs.course import CourseTask
from gazelle.envs.wrappers import (
    ActionDelayTask,
    ActionSmoothingTask,
    FrameStackTask,
    ObservationDelayTask,
    TimeAwareTask,
    wrapped,
)

CART = "gazelle/CartPoleStayUp-v0"
WALL = "gazelle/TurtleBot2Wall-v0"
STAGE = "gazelle/TurtleBot3Stage1Continuous-v0"
KINDS = [
    (CART, FrameStackTask, {"count": 3}),
    (CART, TimeAwareTask, {}),
    (CART, ObservationDelayTask, {"steps": 2}),
    (CART, ActionDelayTask, {"steps": 2, "idle": 1}),
    (STAGE, ActionSmoothingTask, {"weight": 0.3}),
    (WALL, CourseTask, {"x": 5, "y": 6, "steps": (1, 4)}),
]


def vector(task, count, **options):
    if task in {STAGE, WALL}:
        options |= {"engine": "planar"}
    return gym.make_vec(task, num_envs=count, vectorization_mode="vector_entry_point", **options)


def actions_for(env, steps, seed=0):
    env.action_space.seed(seed)
    return [env.action_space.sample() for _ in range(steps)]


@pytest.mark.parametrize(("task", "kind", "options"), KINDS)
def test_single_environments_pass_gymnasiums_checker(task, kind, options):
    env = wrapped(gym.make(task), kind, **options)
    check_env(env, skip_render_check=True)
    env.close()


@pytest.mark.parametrize(("task", "kind", "options"), KINDS)
def test_the_single_environment_is_world_0_and_pickles_and_states_go_on(task, kind, options):
    many, one = (wrapped(vector(task, count), kind, **options) for count in (3, 1))
    np.testing.assert_array_equal(many.reset(seed=4)[0][:1], one.reset(seed=4)[0])
    actions = actions_for(many, 30)
    for row in actions[:15]:
        np.testing.assert_array_equal(many.step(row)[0][:1], one.step(row[:1])[0])
    others = [copy.deepcopy(many), pickle.loads(pickle.dumps(many))]  # its own
    later = wrapped(vector(task, 3), kind, **options)
    later.reset(seed=9)
    later.set_state(many.get_state())
    for row in actions[15:]:
        seen = many.step(row)[0]
        for other in (*others, later):
            np.testing.assert_array_equal(other.step(row)[0], seen)
    for env in (many, one, later, *others):
        env.close()


@pytest.mark.parametrize(("task", "kind", "options"), KINDS)
def test_episodes_are_the_same_in_all_ways_of_autoreset(task, kind, options):
    """Short ones, so that several end: what is seen at each episode's steps is the same."""
    told = {}
    for mode in ("SameStep", "NextStep"):
        env = wrapped(vector(task, 2, max_episode_steps=5, autoreset_mode=mode), kind, **options)
        seen = [env.reset(seed=1)[0][0]]
        over = False
        for _ in range(17 if mode == "NextStep" else 14):
            action = np.zeros(env.action_space.shape, env.action_space.dtype)
            obs, _, terminated, truncated, info = env.step(action)
            if mode == "SameStep" and (terminated | truncated)[0]:
                seen.append(info["final_obs"][0])
            seen.append(obs[0])
            over |= bool(truncated[0])
        told[mode] = np.array(seen)
        assert over
        env.close()
    size = min(map(len, told.values()))
    # Up to the rounding of the time at which an episode begins.
    np.testing.assert_allclose(told["SameStep"][:size], told["NextStep"][:size], atol=1e-5)


def test_frames_are_gymnasiums_side_by_side():
    ours = wrapped(gym.make(CART), FrameStackTask, count=3)
    theirs = FrameStackObservation(gym.make(CART), 3)
    np.testing.assert_array_equal(ours.reset(seed=2)[0], theirs.reset(seed=2)[0].reshape(-1))
    for action in (0, 1, 1, 0, 1):
        mine, other = ours.step(action), theirs.step(action)
        np.testing.assert_array_equal(mine[0], other[0].reshape(-1))
        assert mine[1:4] == other[1:4]
    ours.close()
    theirs.close()


def test_time_goes_from_0_to_1_and_starts_over():
    env = wrapped(vector(STAGE, 2, max_episode_steps=4), TimeAwareTask)
    shares = [env.reset(seed=0)[0][:, -1]]
    for _ in range(4):
        seen, *_, info = env.step(np.zeros((2, 2)))
        shares.append(seen[:, -1])
    np.testing.assert_array_equal(np.array(shares)[:, 0], [0.0, 0.25, 0.5, 0.75, 0.0])
    assert info["final_obs"][0][-1] == 1.0
    env.close()


def test_what_is_seen_and_done_comes_late():
    plain, seeing, acting = vector(CART, 1), vector(CART, 1), vector(CART, 1)
    seeing = wrapped(seeing, ObservationDelayTask, steps=2)
    acting = wrapped(acting, ActionDelayTask, steps=2, idle=0)
    first = [env.reset(seed=3)[0] for env in (plain, seeing, acting)]
    np.testing.assert_array_equal(first[0], first[1])
    plan = [1, 0, 0, 1, 0, 1]
    shown = [first[0]] + [plain.step(np.array([action]))[0] for action in plan]
    late = [first[1]] + [seeing.step(np.array([action]))[0] for action in plan]
    np.testing.assert_array_equal(late[:3], [shown[0]] * 3)
    np.testing.assert_array_equal(late[3:], shown[1:5])
    plain.reset(seed=3)
    for asked, done in zip(plan, [0, 0, *plan], strict=False):
        wanted = plain.step(np.array([done]))[0]
        np.testing.assert_array_equal(acting.step(np.array([asked]))[0], wanted)
    for env in (plain, seeing, acting):
        env.close()


def test_smoothed_actions_are_a_moving_average():
    plain = vector(STAGE, 2)
    smooth = wrapped(vector(STAGE, 2), ActionSmoothingTask, weight=0.25)
    np.testing.assert_array_equal(plain.reset(seed=3)[0], smooth.reset(seed=3)[0])
    done = np.zeros((2, 2))
    for row in actions_for(plain, 10):
        done = 0.75 * done + 0.25 * row
        np.testing.assert_allclose(smooth.step(row)[0], plain.step(done)[0], atol=1e-5)
    plain.close()
    smooth.close()


def test_wrappers_go_around_each_other():
    task = vector(CART, 2, max_episode_steps=50).unwrapped.task
    env = TaskVectorEnv(ActionDelayTask(FrameStackTask(TimeAwareTask(task), 2), 1))
    seen, info = env.reset(seed=0)
    assert seen.shape == (2, 10)
    assert "scenario" in info
    assert env.step(np.array([0, 1]))[0].shape == (2, 10)
    env.close()


@pytest.mark.long
@pytest.mark.parametrize(
    ("task", "kind", "options", "message"),
    [
        (CART, FrameStackTask, {"count": 0}, "count must be an int"),
        (CART, ObservationDelayTask, {"steps": -1}, "steps must be an int"),
        (CART, ActionDelayTask, {"steps": 1, "idle": 7}, "not in"),
        (CART, ActionSmoothingTask, {"weight": 0.5}, "real numbers"),
        (STAGE, ActionSmoothingTask, {"weight": 0.0}, "above 0"),
    ],
)
def test_what_cannot_be_is_refused(task, kind, options, message):
    env = vector(task, 1)
    with pytest.raises(gazelle.TaskError, match=message):
        wrapped(env, kind, **options)
    env.close()


def test_other_environments_are_refused_and_time_needs_a_limit():
    with pytest.raises(gazelle.TaskError, match="not an environment of a BatchedTask"):
        wrapped(gym.make("CartPole-v1"), FrameStackTask, count=2)
    env = gym.make(CART)
    with pytest.raises(gazelle.TaskError, match="step limit"):
        TimeAwareTask(env.unwrapped.task)
    env.close()
