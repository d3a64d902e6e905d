"""Vector environments in each of Gymnasium's modes of beginning the next episode."""

import gymnasium as gym
import numpy as np
import pytest
from gymnasium.vector import AutoresetMode, SyncVectorEnv
from gymnasium.wrappers import vector as wrappers

from gazelle.envs import task_ids
from gazelle.envs.errors import ResetNeededError
from gazelle.errors import TaskError

STAGE = "gazelle/TurtleBot3Stage{}-v0"
FLEET = "gazelle/AGVFleet-v0"
NEXT, SAME, DISABLED = AutoresetMode.NEXT_STEP, AutoresetMode.SAME_STEP, AutoresetMode.DISABLED


def make(task, num_envs, mode, **options):
    return gym.make_vec(
        task,
        num_envs=num_envs,
        vectorization_mode="vector_entry_point",
        autoreset_mode=mode,
        **options,
    )


@pytest.mark.parametrize("task", [STAGE.format(1), STAGE.format(4), FLEET])
@pytest.mark.parametrize("mode", [NEXT, SAME, DISABLED])
def test_a_mode_goes_by_constant_or_name_and_is_in_the_metadata(task, mode):
    for given in (mode, mode.value):
        env = make(task, 2, given)
        assert env.metadata["autoreset_mode"] is mode
        env.close()


@pytest.mark.parametrize(
    ("mode", "text"),
    [("NextSteps", "did you mean 'NextStep'"), (3, "NextStep, SameStep, Disabled")],
)
def test_a_mode_that_there_is_not_is_an_error(mode, text):
    with pytest.raises(TaskError, match=text):
        make(STAGE.format(1), 2, mode)


@pytest.mark.parametrize("mode", [NEXT, SAME])
@pytest.mark.parametrize("engine", ["mujoco", "planar"])
@pytest.mark.parametrize("stage", [1, 2, 3, 4])
def test_world_0_is_gymnasiums_own_vector_of_one_environment(stage, engine, mode):
    """Ranges are noisy and goals drawn: what a mode drew too much would show."""
    task, options = STAGE.format(stage), {"engine": engine, "respawn": False}
    ours = make(task, 3, mode, max_episode_steps=5, **options)
    theirs = SyncVectorEnv(
        [lambda: gym.make(task, max_episode_steps=5, **options)], autoreset_mode=mode
    )
    # With an empty step before it an episode begins at another time, of which intervals are
    # taken with another rounding. Noise is 0.01 m, and goals are 1 m apart.
    off = 0.0 if mode is SAME else 2e-3
    generator = np.random.default_rng(stage)
    seen, theirs_seen = ours.reset(seed=4)[0], theirs.reset(seed=4)[0]
    for _ in range(23):
        np.testing.assert_allclose(seen[0], theirs_seen[0], rtol=0, atol=off)
        actions = generator.integers(0, 5, 3)
        seen, reward, *ends, info = ours.step(actions)
        theirs_seen, theirs_reward, *theirs_ends, theirs_info = theirs.step(actions[:1])
        assert reward[0] == pytest.approx(theirs_reward[0], rel=0, abs=30 * off)
        assert [end[0] for end in ends] == [end[0] for end in theirs_ends]
        assert info["goal"][0].tolist() == theirs_info["goal"][0].tolist()
        both = "final_obs" in theirs_info
        assert both == ("final_obs" in info and info["_final_obs"][0])
        if both:
            np.testing.assert_allclose(info["final_obs"][0], theirs_info["final_obs"][0], atol=off)
    ours.close()
    theirs.close()


@pytest.mark.parametrize(
    ("task", "engine"),
    [(STAGE.format(2), "mujoco"), (STAGE.format(4), "planar"), (FLEET, "planar")],
)
def test_the_next_step_begins_the_next_episode_and_does_not_look_at_the_action(task, engine):
    env = make(task, 6, NEXT, engine=engine, max_episode_steps=4)
    env.action_space.seed(0)
    env.reset(seed=1)
    over = np.zeros(6, bool)
    for step in range(15):
        actions = env.action_space.sample()
        actions[over] = 99 if actions.dtype.kind == "i" else np.nan
        seen, reward, terminated, truncated, info = env.step(actions)
        assert seen in env.observation_space
        assert "final_obs" not in info
        assert not (terminated | truncated)[over].any()
        assert (reward[over] == 0.0).all()
        assert (info["goals_reached"][over] == 0).all()
        over = terminated | truncated
        assert over.any() or step % 5 != 3
    env.close()


def test_worlds_that_begin_do_not_show_in_the_others():
    """World 1 ends at a time of its own in one of two runs; the others do the same in both."""
    made = []
    for first in (False, True):
        env = make(STAGE.format(1), 3, NEXT, max_episode_steps=8)
        env.reset(seed=3)
        if first:
            env.step(np.array([2, 2, 2]))
            env.reset(options={"reset_mask": np.array([False, True, False])})
        else:
            env.step(np.array([2, 2, 2]))
        made.append([env.step(np.array([1, 3, 2]))[:4] for _ in range(20)])
        env.close()
    for one, other in zip(*made, strict=True):
        for left, right in zip(one, other, strict=True):
            assert np.array_equal(left[[0, 2]], right[[0, 2]])


def test_a_mask_resets_what_would_have_begun_in_the_next_step():
    env = make(STAGE.format(1), 2, NEXT, max_episode_steps=2)
    env.reset(seed=0)
    env.step(np.array([2, 2]))
    assert env.step(np.array([2, 2]))[3].all()
    env.reset(options={"reset_mask": np.array([True, False])})
    *_, info = env.step(np.array([2, 2]))
    assert env.unwrapped.task.elapsed.tolist() == [1, 0]
    assert info["distance"][0] != info["distance"][1]
    env.close()


def test_without_autoreset_a_world_that_is_over_must_be_reset():
    env = make(STAGE.format(1), 3, DISABLED, max_episode_steps=2)
    env.reset(seed=0)
    env.step(np.array([2, 2, 2]))
    env.reset(options={"reset_mask": np.array([False, False, True])})
    *_, truncated, _ = env.step(np.array([2, 2, 2]))
    assert truncated.tolist() == [True, True, False]
    with pytest.raises(ResetNeededError, match="the episode of world 0 is over"):
        env.step(np.array([2, 2, 2]))
    env.reset(options={"reset_mask": truncated})
    env.step(np.array([2, 2, 2]))
    env.close()


def test_a_state_goes_on_where_an_episode_is_over():
    one, other = (make(STAGE.format(2), 3, NEXT, max_episode_steps=3) for _ in range(2))
    one.reset(seed=5)
    for _ in range(3):
        one.step(np.array([0, 2, 4]))
    other.reset(seed=0)
    other.unwrapped.set_state(one.unwrapped.get_state())
    for _ in range(6):
        for left, right in zip(
            *(e.step(np.array([1, 2, 3]))[:4] for e in (one, other)), strict=True
        ):
            assert np.array_equal(left, right)
    one.close()
    other.close()


@pytest.mark.parametrize("task", [STAGE.format(1), FLEET])
@pytest.mark.parametrize(
    "wrapper",
    [
        wrappers.NormalizeObservation,
        wrappers.NormalizeReward,
        wrappers.RecordEpisodeStatistics,
        wrappers.FlattenObservation,
        lambda env: wrappers.RescaleObservation(env, -1.0, 1.0),
        lambda env: wrappers.TransformObservation(env, lambda seen: seen * 2.0),
    ],
)
def test_wrappers_of_gymnasium_take_the_next_step_mode(task, wrapper):
    env = wrapper(make(task, 4, NEXT, max_episode_steps=3))
    env.action_space.seed(0)
    env.reset(seed=0)
    for _ in range(9):
        seen, *_ = env.step(env.action_space.sample())
        assert np.isfinite(seen).all()
    env.close()


@pytest.mark.parametrize("task", [STAGE.format(3), FLEET])
@pytest.mark.parametrize("mode", [NEXT, SAME])
def test_gymnasiums_own_vectors_take_single_environments_and_vector_kwargs(task, mode):
    env = gym.make_vec(
        task,
        num_envs=2,
        vectorization_mode="sync",
        vector_kwargs={"autoreset_mode": mode},
        max_episode_steps=2,
    )
    env.reset(seed=0)
    for _ in range(5):
        env.step(env.action_space.sample())
    env.close()


def test_single_environments_have_no_such_option():
    for task in task_ids()[:1]:
        with pytest.raises(TaskError, match="no option 'autoreset_mode'"):
            gym.make(task, autoreset_mode="NextStep")
