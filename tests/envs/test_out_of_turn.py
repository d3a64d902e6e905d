"""Calls after close() or before reset() raise an error of Gazelle's and of Gymnasium's."""

import gymnasium as gym
import numpy as np
import pytest

import gazelle
from gazelle.envs import ClosedEnvError, ResetNeededError

TASKS = [
    ("gazelle/TurtleBot3Stage1-v0", {}),
    ("gazelle/TurtleBot3Stage4Continuous-v0", {"engine": "planar"}),
    ("gazelle/AGVFleet-v0", {}),
]
each_task = pytest.mark.parametrize(("task", "options"), TASKS)


def vector(task, options, **more):
    return gym.make_vec(task, 2, vectorization_mode="vector_entry_point", **options, **more)


def test_the_errors_are_gazelles_and_gymnasiums():
    for error, theirs in (
        (ClosedEnvError, gym.error.ClosedEnvironmentError),
        (ResetNeededError, gym.error.ResetNeeded),
    ):
        assert issubclass(error, gazelle.Error)
        assert issubclass(error, theirs)


@each_task
@pytest.mark.parametrize("made", ["single", "wrapped", "vector"])
def test_nothing_works_after_close(task, options, made):
    if made == "vector":
        env = vector(task, options, render_mode="rgb_array")
    else:
        env = gym.make(task, render_mode="rgb_array", **options)
        env = env.unwrapped if made == "single" else env
    env.reset(seed=0)
    state = env.unwrapped.get_state()
    env.close()
    env.close()
    for what in (
        lambda: env.step(env.action_space.sample()),
        env.reset,
        env.render,
        env.unwrapped.get_state,
        lambda: env.unwrapped.set_state(state),
    ):
        with pytest.raises(ClosedEnvError, match="after close"):
            what()


@each_task
@pytest.mark.parametrize("mode", ["SameStep", "NextStep", "Disabled"])
def test_no_vector_steps_before_a_reset(task, options, mode):
    env = vector(task, options, autoreset_mode=mode)
    with pytest.raises(ResetNeededError, match="before the first reset"):
        env.step(env.action_space.sample())
    env.reset(seed=0)
    env.step(env.action_space.sample())
    env.close()


@each_task
def test_no_single_environment_steps_before_a_reset(task, options):
    env = gym.make(task, **options)
    for each in (env, env.unwrapped):
        with pytest.raises(gym.error.ResetNeeded):
            each.step(each.action_space.sample())
    env.close()


def test_a_state_that_is_set_is_a_beginning():
    one, other = (vector(*TASKS[0]) for _ in range(2))
    one.reset(seed=0)
    other.unwrapped.set_state(one.unwrapped.get_state())
    actions = np.array([1, 3])
    assert np.array_equal(one.step(actions)[0], other.step(actions)[0])
    one.close()
    other.close()


def test_agents_of_a_fleet_act_in_turn():
    pytest.importorskip("pettingzoo")
    from gazelle.envs.agv_fleet import parallel_env

    env = parallel_env(agents=2, render_mode="rgb_array")
    with pytest.raises(ResetNeededError):
        env.step({})
    env.reset(seed=0)
    env.step({agent: env.action_space(agent).sample() for agent in env.agents})
    env.close()
    for what in (lambda: env.step({}), env.reset, env.render):
        with pytest.raises(ClosedEnvError):
            what()
