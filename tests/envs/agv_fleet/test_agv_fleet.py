"""The fleet obeys Gymnasium's and PettingZoo's rules, and its own."""

import gymnasium as gym
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

import gazelle.envs  # noqa: F401  registers the environments
from gazelle.envs.agv_fleet import hall, parallel_env
from gazelle.errors import TaskError

ID = "gazelle/AGVFleet-v0"


def make(num_envs, **options):
    return gym.make_vec(
        ID, num_envs=num_envs, vectorization_mode="vector_entry_point", threads=1, **options
    )


def test_pettingzoo_accepts_the_fleet():
    pytest.importorskip("pettingzoo")
    from pettingzoo.test import parallel_api_test, parallel_seed_test

    parallel_api_test(parallel_env(agents=5, max_episode_steps=60), num_cycles=150)
    parallel_seed_test(lambda: parallel_env(agents=4, max_episode_steps=40), num_cycles=50)


def test_gymnasium_accepts_one_agv():
    env = gym.make(ID, render_mode="rgb_array")
    check_env(env.unwrapped)
    env.close()


def test_agvs_start_apart_and_never_overlap():
    env = make(64, agents=16)
    env.reset(seed=1)
    generator = np.random.default_rng(0)
    for _ in range(40):
        poses = env.unwrapped.task.poses.reshape(4, 16, 3)
        away = poses[:, :, None, :2] - poses[:, None, :, :2]
        distance = np.hypot(away[..., 0], away[..., 1]) + np.eye(16) * 9.0
        assert distance.min() >= hall.AGV_WIDTH - 1e-9
        env.step(generator.uniform(-1.0, 1.0, (64, 2)))
    env.reset()
    poses = env.unwrapped.task.poses.reshape(4, 16, 3)
    away = np.hypot(*np.moveaxis(poses[:, :, None, :2] - poses[:, None, :, :2], 3, 0))
    assert (away + np.eye(16) * 9.0).min() > hall.APART


@pytest.mark.parametrize("places", ["training", "held-out"])
def test_a_hall_holds_72_agvs_and_says_how_many_it_cannot(places):
    env = make(72, agents=72, places=places)
    env.reset(seed=2)
    for _ in range(20):  # those that bump begin anew among the others
        poses = env.unwrapped.task.poses[:, :2]
        away = np.hypot(*(poses[:, None] - poses[None]).transpose(2, 0, 1)) + np.eye(72) * 9.0
        assert away.min() >= hall.AGV_WIDTH - 1e-9
        env.step(np.tile([1.0, 0.3], (72, 1)))
    env.close()
    with pytest.raises(TaskError, match="too small for 100 AGVs") as caught:
        make(100, agents=100, places=places)
    assert "at most 9" in str(caught.value.hint)


def test_info_tells_the_distance_to_the_goal_that_was_gone_for():
    env = make(24, agents=24)
    _, info = env.reset(seed=4)
    generator = np.random.default_rng(0)
    goal, arrived = info["goal"], 0
    for _ in range(300):
        before = env.unwrapped.task.poses[:, :2]
        np.testing.assert_allclose(info["distance"], np.hypot(*(info["goal"] - before).T))
        goal, begun = info["goal"], info["distance"]
        _, _, terminated, truncated, info = env.step(
            np.column_stack((np.ones(24), generator.uniform(-1.0, 1.0, 24)))
        )
        goes_on = ~(terminated | truncated)
        there = goes_on & info["is_success"]
        arrived += int(there.sum())
        assert (info["distance"][there] < 0.5).all()
        place = env.unwrapped.task.poses[:, :2]
        away = np.hypot(*(goal - place).T)
        np.testing.assert_allclose(info["distance"][goes_on], away[goes_on])
        assert (np.abs(info["distance"] - begun)[goes_on] < 0.21).all()
        info["distance"] = np.hypot(*(info["goal"] - place).T)
    assert arrived > 0


def test_an_agv_that_bumps_ends_and_begins_anew_while_others_go_on():
    env = make(8)
    env.reset(seed=3)
    ended = np.zeros(8, bool)
    for _ in range(200):
        observation, reward, terminated, _, info = env.step(np.tile([1.0, 0.0], (8, 1)))
        if terminated.any():
            assert (reward[terminated] == -10.0).all()
            assert info["final_info"]["is_collision"][terminated].all()
            assert (observation[terminated, 26] == 0.0).all()  # it stands
            assert (info["goals_reached"][terminated] == 0).all()
        ended |= terminated
    assert ended.all()


def test_who_steers_for_the_goal_is_paid_for_it():
    env = make(1)
    observation, _ = env.reset(seed=8)  # nothing is in the way
    total, reached = 0.0, False
    while not reached:
        heading = float(observation[0, 25])
        speed = 1.0 if abs(heading) < 0.3 else -1.0
        action = np.array([[speed, np.clip(3.0 * heading, -1.0, 1.0)]])
        observation, reward, terminated, _, info = env.step(action)
        assert not terminated[0]
        total, reached = total + float(reward[0]), bool(info["is_success"][0])
    assert total > 10.0


def test_a_hall_knows_nothing_of_the_others():
    large, small = make(24), make(8)
    first, second = large.reset(seed=2)[0], small.reset(seed=2)[0]
    np.testing.assert_array_equal(first[:8], second)
    generator = np.random.default_rng(1)
    for _ in range(200):
        actions = generator.uniform(-1.0, 1.0, (24, 2))
        left, right = large.step(actions), small.step(actions[:8])
        for whole, part in zip(left[:4], right[:4], strict=True):
            np.testing.assert_array_equal(whole[:8], part)


def test_a_saved_state_goes_on_as_it_would_have():
    env = make(8)
    env.reset(seed=7)
    generator = np.random.default_rng(2)
    for _ in range(20):
        env.step(generator.uniform(-1.0, 1.0, (8, 2)))
    state = env.get_state()
    actions = generator.uniform(-1.0, 1.0, (20, 8, 2))
    wanted = [env.step(action)[0] for action in actions]
    env.set_state(state)
    np.testing.assert_array_equal([env.step(action)[0] for action in actions], wanted)


def test_an_agv_that_is_done_stays_in_the_way():
    pytest.importorskip("pettingzoo")
    env = parallel_env(agents=6, seed=1, threads=1)
    env.reset()
    for _ in range(400):
        env.step({agent: np.array([1.0, 0.0]) for agent in env.agents})
        if len(env.agents) < 6:
            break
    gone = [env.possible_agents.index(name) for name in set(env.possible_agents) - set(env.agents)]
    before = env.task.poses[gone].copy()
    env.step({agent: np.array([1.0, 0.5]) for agent in env.agents})
    np.testing.assert_array_equal(env.task.poses[gone], before)


@pytest.mark.parametrize(
    ("count", "options"),
    [
        (12, {}),
        (8, {"engine": "mujoco"}),
        (8, {"agents": 0}),
        (8, {"agents": 1000}),
        (8, {"time_step": 0.1}),
        (8, {"lidar": 3}),
    ],
)
def test_nonsense_is_refused(count, options):
    with pytest.raises(TaskError):
        make(count, **options)
