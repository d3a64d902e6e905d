"""Goal environments of a user's own task: Gymnasium's rules, GoalEnv's rules, and the task's."""

import copy
import pickle
import warnings

import gymnasium as gym
import numpy as np
import pytest
import slider_task
from gymnasium.utils.env_checker import check_env
from slider_task import NEAR, Slider, SliderEnv, SliderVectorEnv

from gazelle.envs import DictRows
from gazelle.errors import TaskError

KEYS = {"observation", "achieved_goal", "desired_goal"}


@pytest.fixture(scope="module")
def many():
    env = SliderVectorEnv(6, seed=0)
    yield env
    env.close()


def test_it_passes_gymnasiums_checker():
    env = gym.make("test/Slider-v0")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        warnings.filterwarnings("ignore", message=".*alternative render modes.*")
        check_env(env.unwrapped, skip_render_check=True)
    env.close()


def test_the_reward_of_a_step_is_what_compute_reward_says_of_it(many):
    obs, _ = many.reset(seed=3)
    assert set(obs) == KEYS
    for step in range(25):
        obs, reward, _, truncated, info = many.step(many.action_space.sample())
        assert many.observation_space.contains(obs)
        last = obs
        if truncated.any():
            assert step == 19
            finals = info["final_obs"]
            last = {key: np.stack([each[key] for each in finals]) for key in KEYS}
            info = info["final_info"]
            assert not np.array_equal(last["desired_goal"], obs["desired_goal"])
            assert many.single_observation_space.contains(finals[0])
        told = many.compute_reward(last["achieved_goal"], last["desired_goal"], info)
        np.testing.assert_array_equal(told, reward)
        distance = np.linalg.norm(last["achieved_goal"] - last["desired_goal"], axis=-1)
        np.testing.assert_array_equal(info["is_success"], distance < NEAR)


@pytest.mark.parametrize("shape", [(), (5,), (3, 4), (0,)])
@pytest.mark.parametrize("dense", [False, True])
def test_compute_reward_takes_any_number_of_goals(shape, dense):
    env = SliderEnv(dense=dense)
    rng = np.random.default_rng(0)
    first, second = rng.uniform(-0.1, 0.1, (2, *shape, 2))
    rewards = np.asarray(env.compute_reward(first, second, {}))
    distance = np.linalg.norm(first - second, axis=-1)
    np.testing.assert_array_equal(
        rewards, -distance if dense else np.where(distance < NEAR, 0.0, -1.0)
    )
    env.close()


@pytest.mark.parametrize("mode", ["SameStep", "NextStep", "Disabled"])
def test_a_world_is_the_same_alone_and_among_others_in_every_mode(mode):
    envs = [SliderVectorEnv(count, autoreset_mode=mode, steps=5) for count in (1, 4)]
    seen = [env.reset(seed=4)[0] for env in envs]
    rng = np.random.default_rng(0)
    for _ in range(13):
        for key in KEYS:
            np.testing.assert_array_equal(seen[0][key][0], seen[1][key][0])
        actions = rng.uniform(-1, 1, (4, 2))
        for i, env in enumerate(envs):
            obs, _, _, truncated, _ = env.step(actions[: env.num_envs])
            if mode == "Disabled" and truncated.any():
                obs, _ = env.reset(options={"reset_mask": truncated})
            seen[i] = obs
    for env in envs:
        env.close()


@pytest.mark.parametrize("twin", [copy.deepcopy, lambda env: pickle.loads(pickle.dumps(env))])
def test_copies_go_on_alike_with_the_same_goals(many, twin):
    many.reset(seed=1)
    many.step(many.action_space.sample())
    other = twin(many)
    for _ in range(22):
        actions = many.action_space.sample()
        first, second = many.step(actions), other.step(actions)
        for key in KEYS:
            np.testing.assert_array_equal(first[0][key], second[0][key])
        np.testing.assert_array_equal(first[1], second[1])
    other.close()


def test_rows_are_gymnasiums_flattened_observations(many):
    obs, _ = many.reset(seed=2)
    rows = many.task.rows
    joined = rows.join(obs)
    for world in range(many.num_envs):
        one = {key: part[world] for key, part in obs.items()}
        flat = gym.spaces.flatten(many.single_observation_space, one)
        np.testing.assert_array_equal(joined[world], flat)
    for key, part in rows.split(joined).items():
        np.testing.assert_array_equal(part, obs[key])
    assert rows.row_space == gym.spaces.flatten_space(many.single_observation_space)


def test_a_dict_of_anything_else_has_no_rows():
    with pytest.raises(TaskError, match="part 'b' of the observation is a Discrete"):
        DictRows(gym.spaces.Dict({"a": gym.spaces.Box(0, 1, (2, 3)), "b": gym.spaces.Discrete(2)}))
    with pytest.raises(TaskError, match="without numbers"):
        DictRows(gym.spaces.Dict({}))


def broken(**methods):
    kind = type("Broken", (Slider,), methods)
    env = slider_task.TaskGoalVectorEnv(kind(2))
    try:
        env.reset()
        env.step(np.zeros((2, 2)))
    finally:
        env.close()


@pytest.mark.parametrize(
    ("methods", "words"),
    [
        (
            {"draw_goals": lambda _, worlds: np.zeros((len(worlds), 3))},
            r"draw_goals returned.*\(2, 3\)",
        ),
        ({"achieved": lambda *_: np.zeros(2)}, "achieved returned an array of shape"),
        ({"observe": lambda *_: np.zeros((2, 7))}, "observation has shape"),
        ({"compute_reward": lambda *_: -1.0}, "compute_reward returned an array of shape"),
        ({"goal_space": None}, "Broken has no Box as goal_space"),
        ({"goal_space": gym.spaces.Discrete(2)}, "Broken has no Box as goal_space"),
    ],
)
def test_what_does_not_fit_is_named(methods, words):
    with pytest.raises(TaskError, match=words):
        broken(**methods)


@pytest.mark.long
def test_stable_baselines3s_own_hindsight_takes_it():
    stable = pytest.importorskip("stable_baselines3")
    learner = stable.DDPG(
        "MultiInputPolicy",
        SliderEnv(),
        replay_buffer_class=stable.HerReplayBuffer,
        learning_starts=40,
        batch_size=16,
        buffer_size=200,
        policy_kwargs={"net_arch": [8]},
    )
    learner.learn(60)
    learner.env.close()
