from __future__ import annotations

import gymnasium as gym
import numpy as np
import pytest
from corridor import MODES, Corridor
from gymnasium.vector import AutoresetMode

from gazelle.errors import TaskError
from gazelle.training.stepper import Stepper


def play(stepper, steps, seed=0):
    rng = np.random.default_rng(seed)
    stepper.reset(seed=seed)
    return [stepper.step(rng.integers(0, 3, stepper.num_envs)) for _ in range(steps)]


@pytest.mark.parametrize("mode", MODES)
def test_every_mode_reports_whole_episodes(mode):
    stepper = Stepper(Corridor(6, mode=mode.value, limit=9))
    steps = play(stepper, 60)
    ended = [step.ended for step in steps if step.ended is not None]
    lengths = np.concatenate([episodes.lengths for episodes in ended])
    assert lengths.max() == 9
    assert lengths.min() >= 1
    counted = lengths.sum() + stepper.get_state()["lengths"].sum()
    assert counted == sum(int(step.valid.sum()) for step in steps)


@pytest.mark.parametrize("mode", MODES)
def test_final_observations_are_the_last_and_the_next_ones_start_anew(mode):
    stepper = Stepper(Corridor(6, mode=mode.value, limit=9))
    seen = 0
    before = stepper.reset(seed=1)
    for step in play(stepper, 60):
        if step.ended is not None:
            for slot, last, length in zip(
                step.ended.slots, step.final_obs, step.ended.lengths, strict=True
            ):
                assert last[2] == pytest.approx(length / 9)
                if mode is not AutoresetMode.NEXT_STEP:
                    assert step.obs[slot, 2] == 0.0
                seen += 1
        before = step.obs
    assert seen > 10
    assert before.shape == (6, 3)


def test_only_next_step_mode_has_idle_steps():
    for mode in MODES:
        steps = play(Stepper(Corridor(6, mode=mode.value, limit=9)), 40)
        idle = sum(int((~step.valid).sum()) for step in steps)
        assert (idle > 0) == (mode is AutoresetMode.NEXT_STEP)


def test_idle_steps_have_no_reward_and_end_nothing():
    for step in play(Stepper(Corridor(6, mode="NextStep", limit=9)), 60):
        assert not step.rewards[~step.valid].any()
        assert not (step.terminated | step.truncated)[~step.valid].any()


@pytest.mark.parametrize("mode", MODES)
def test_outcomes_are_told_apart(mode):
    steps = play(Stepper(Corridor(8, mode=mode.value, limit=9)), 80)
    for step in steps:
        if step.ended is None:
            continue
        outcomes = step.ended.outcomes
        total = sum(values.astype(int) for values in outcomes.values())
        assert (total == 1).all()
        assert (outcomes["is_timeout"] == step.truncated[step.ended.slots]).all()


def test_goals_reached_on_the_way_are_counted():
    """Every third step reaches a goal; the flags of a new episode's start must not count."""
    env = Corridor(4, limit=9)
    step = env.step

    def on_to_the_next(actions):
        *rest, info = step(actions)
        if "final_info" in info:
            info["final_info"]["is_success"] = np.zeros(4, dtype=bool)
        return (*rest, info | {"is_success": env.steps % 3 == 0})

    env.step = on_to_the_next
    ended = [step.ended for step in play(Stepper(env), 60) if step.ended is not None]
    lengths = np.concatenate([episodes.lengths for episodes in ended])
    goals = np.concatenate([episodes.goals for episodes in ended])
    np.testing.assert_array_equal(goals, (lengths - 1) // 3)
    assert goals.max() == 2


def test_stable_under_gymnasiums_own_same_step_layout():
    """SyncVectorEnv gives final observations as an array of objects with gaps."""
    env = gym.make_vec(
        "CartPole-v1",
        num_envs=3,
        vectorization_mode="sync",
        vector_kwargs={"autoreset_mode": AutoresetMode.SAME_STEP},
    )
    stepper = Stepper(env)
    stepper.reset(seed=0)
    ended = 0
    for _ in range(60):
        step = stepper.step(np.ones(3, dtype=np.int64))
        if step.ended is not None:
            ended += len(step.ended.slots)
            assert (np.abs(step.final_obs[:, 2]) > 0.2).all()
            assert (np.abs(step.obs[step.ended.slots]) < 0.051).all()
    assert ended >= 9
    env.close()


def test_missing_final_observations_are_an_error():
    env = Corridor(2, limit=2)
    step = env.step

    def without(actions):
        *rest, _ = step(actions)
        return (*rest, {})

    env.step = without
    stepper = Stepper(env)
    stepper.reset(seed=0)
    stepper.step(np.ones(2, dtype=np.int64))
    with pytest.raises(TaskError, match="final_obs"):
        stepper.step(np.ones(2, dtype=np.int64))


def test_observations_must_be_numbers():
    env = Corridor(2)
    env.single_observation_space = gym.spaces.Dict({"a": gym.spaces.Discrete(2)})
    with pytest.raises(TaskError, match="only a Dict of boxes"):
        Stepper(env)
