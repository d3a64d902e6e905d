"""The vector environment: worlds do not know of each other, and episodes follow on."""

import gymnasium as gym
import numpy as np
import pytest
from gymnasium.vector import AutoresetMode

from gazelle.envs import task_ids
from gazelle.errors import TaskError

STAGE1 = "gazelle/TurtleBot3Stage1-v0"


def make(num_envs, task=STAGE1, **options):
    return gym.make_vec(task, num_envs=num_envs, vectorization_mode="vector_entry_point", **options)


@pytest.mark.parametrize("task", task_ids())
def test_spaces_hold_what_is_returned(task):
    env = make(3, task)
    assert env.metadata["autoreset_mode"] is AutoresetMode.SAME_STEP
    env.action_space.seed(0)
    seen, _ = env.reset(seed=0)
    assert seen in env.observation_space
    for _ in range(3):
        seen, reward, terminated, truncated, _ = env.step(env.action_space.sample())
        assert seen in env.observation_space
        assert reward.shape == terminated.shape == truncated.shape == (3,)
    env.close()


@pytest.mark.parametrize("task", [task for task in task_ids() if "TurtleBot3Stage" in task])
def test_world_0_is_the_single_environment_bit_for_bit(task):
    many, one = make(5, task, max_episode_steps=6), gym.make(task, max_episode_steps=6)
    many.action_space.seed(4)
    seen, _ = many.reset(seed=9)
    alone, _ = one.reset(seed=9)
    for _ in range(14):
        assert np.array_equal(seen[0], alone)
        actions = many.action_space.sample()
        seen, reward, terminated, truncated, info = many.step(actions)
        alone, *result, single_info = one.step(actions[0])
        assert [reward[0], terminated[0], truncated[0]] == result
        if terminated[0] or truncated[0]:
            assert np.array_equal(info["final_obs"][0], alone)
            assert info["final_info"]["distance"][0] == single_info["distance"]
            alone, single_info = one.reset()
        assert info["distance"][0] == single_info["distance"]
        assert info["goal"][0].tolist() == single_info["goal"].tolist()
    many.close()
    one.close()


@pytest.mark.long
@pytest.mark.parametrize("stage", [1, 3, 4])
def test_no_world_depends_on_the_number_of_worlds(stage):
    task = f"gazelle/TurtleBot3Stage{stage}-v0"
    few = make(2, task, respawn=False, max_episode_steps=8)
    many = make(64, task, respawn=False, max_episode_steps=8)
    actions = np.random.default_rng(0).integers(0, 5, (20, 64))
    first, second = few.reset(seed=5), many.reset(seed=5)
    assert np.array_equal(first[1]["goal"], second[1]["goal"][:2])
    for row in actions:
        seen, reward, *_, info = few.step(row[:2])
        seen_64, reward_64, *_, info_64 = many.step(row)
        assert np.array_equal(seen, seen_64[:2])
        assert np.array_equal(reward, reward_64[:2])
        assert np.array_equal(info["goal"], info_64["goal"][:2])
    few.close()
    many.close()


def test_fresh_goals_differ_between_worlds_and_episodes():
    env = make(16, respawn=False, max_episode_steps=1)
    _, info = env.reset(seed=0)
    goals = [info["goal"], *(env.step(np.full(16, 2))[4]["goal"] for _ in range(3))]
    assert len(np.unique(np.concatenate(goals), axis=0)) > 40
    env.close()


def test_the_last_observation_and_outcome_are_in_the_info():
    env = make(4, respawn=False, max_episode_steps=30, goals=[(0.5, 0.0)])
    env.reset(seed=1)
    outcomes = {"is_success": 0, "is_timeout": 0, "is_collision": 0}
    actions = np.array([2, 0, 2, 4])
    for _ in range(30):
        seen, reward, terminated, truncated, info = env.step(actions)
        done = terminated | truncated
        assert ("final_obs" in info) == done.any()
        if not done.any():
            continue
        assert info["_final_obs"].tolist() == info["_final_info"].tolist() == done.tolist()
        final = info["final_info"]
        for world in np.flatnonzero(done):
            last = info["final_obs"][world]
            assert last.shape == seen[world].shape
            assert not np.array_equal(last, seen[world])
            assert info["distance"][world] == 0.5
            assert final["distance"][world] == pytest.approx(last[25])
            assert sum(final[name][world] for name in outcomes) == 1
        assert [info["final_obs"][world] for world in np.flatnonzero(~done)] == [None] * (
            ~done
        ).sum()
        for name in outcomes:
            assert final[f"_{name}"].tolist() == done.tolist()
            assert not (final[name] & ~done).any()
            outcomes[name] += int(final[name].sum())
        assert (terminated == final["is_success"]).all()
        assert (reward[final["is_success"]] == 200.0).all()
    assert outcomes["is_success"] >= 2
    assert outcomes["is_timeout"] == 2
    env.close()


def test_a_mask_resets_only_some():
    env = make(3)
    env.reset(seed=2)
    for _ in range(6):
        before, *_ = env.step(np.array([0, 1, 2]))
    mask = np.array([False, True, False])
    after, info = env.reset(options={"reset_mask": mask})
    assert np.array_equal(before[~mask], after[~mask])
    assert info["_distance"].tolist() == mask.tolist()
    position = env.unwrapped.task.scene.robot.position
    assert np.hypot(*position[1, :2]) < 1e-6
    assert np.hypot(*position[2, :2]) > 0.1
    env.close()


def test_a_state_continues_exactly():
    env, other = make(3, max_episode_steps=9), make(3, max_episode_steps=9)
    actions = np.random.default_rng(1).integers(0, 5, (24, 3))
    env.reset(seed=8)
    for row in actions[:12]:
        env.step(row)
    state = env.unwrapped.get_state()
    assert all(isinstance(value, np.ndarray | bytes) for value in state.values())
    other.reset(seed=0)
    other.unwrapped.set_state(state)
    for row in actions[12:]:
        seen, reward, *ends, info = env.step(row)
        seen_2, reward_2, *ends_2, info_2 = other.step(row)
        assert np.array_equal(seen, seen_2)
        assert np.array_equal(reward, reward_2)
        assert np.array_equal(ends, ends_2)
        assert np.array_equal(info["goal"], info_2["goal"])
    env.close()
    other.close()


def test_a_state_of_another_size_is_refused():
    env, other = make(2), make(3)
    env.reset(seed=0)
    with pytest.raises(TaskError, match="2 worlds"):
        other.unwrapped.set_state(env.unwrapped.get_state())
    with pytest.raises(TaskError, match="no 'elapsed'"):
        other.unwrapped.set_state({})
    env.close()
    other.close()


def test_what_is_returned_is_the_callers():
    env = make(2, max_episode_steps=2)
    kept = [env.reset(seed=0)[0]]
    copies = [kept[0].copy()]
    for _ in range(3):
        kept.append(env.step(np.array([0, 4]))[0])
        copies.append(kept[-1].copy())
    assert all(np.array_equal(a, b) for a, b in zip(kept, copies, strict=True))
    env.close()


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        ({"seed": [1, 2]}, "one int"),
        ({"seed": -3}, "negative"),
        ({"options": {"reset_masks": None}}, "did you mean 'reset_mask'"),
        ({"options": {"reset_mask": np.array([True])}}, "2 booleans"),
        ({"options": {"reset_mask": np.array([False, False])}}, "at least one"),
    ],
)
def test_a_wrong_reset_is_an_error(arguments, text):
    env = make(2)
    with pytest.raises(TaskError, match=text):
        env.reset(**arguments)
    env.close()


def test_closing_twice_is_fine_and_the_number_of_worlds_is_checked():
    env = make(1)
    env.close()
    env.close()
    with pytest.raises(TaskError, match="num_envs"):
        make(0)
