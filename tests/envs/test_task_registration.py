"""A task's class is registered as single and as vector environment."""

from __future__ import annotations

import warnings

import gymnasium as gym
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from slider_task import Slider

import gazelle
from gazelle.description import World
from gazelle.envs import SimulationTask, StepOutcome, TaskGoalEnv, register_task
from gazelle.envs.wrappers import FrameStackTask
from gazelle.errors import TaskError
from gazelle.training.tasks import entry_class, evaluation_options, fitting_copies, make_task

ID = "test/Count-v0"
MANY = {"vectorization_mode": "vector_entry_point"}


class Count(SimulationTask):
    """Steps are counted."""

    observation_space = gym.spaces.Box(0.0, 100.0, (1,), np.float32)
    action_space = gym.spaces.Discrete(2)

    def __init__(self, nworld, engine="planar", first=0.0):
        simulation = gazelle.Simulation(World(name="hall"), engine, nworld=nworld, time_step=0.1)
        super().__init__(simulation, control_period=0.1, max_episode_steps=5)
        self.first = first
        self.memory["steps"] = np.zeros(nworld)

    @staticmethod
    def evaluation_options(trained):
        return {"first": 7.0}

    @staticmethod
    def fitting_num_envs(least, options):
        return least + 1

    def start(self, worlds):
        self.memory["steps"][worlds] = self.first

    def observe(self, worlds):
        return self.memory["steps"][slice(None) if worlds is None else worlds][:, None]

    def act(self, actions):
        self.memory["steps"] += actions

    def outcome(self, observation):
        over = observation[:, 0] > 50.0
        return StepOutcome(np.ones(len(over)), over, {"is_success": over})


@pytest.fixture(autouse=True)
def registered():
    register_task(ID, Count)
    yield
    for name in [each for each in gym.registry if each.startswith("test/Count")]:
        del gym.registry[name]


def test_single_and_vector_environments_take_their_options():
    env = gym.make(ID, seed=3, first=2.0)
    assert env.reset()[0].tolist() == [2.0]
    assert env.np_random_seed == 3
    check_env(env.unwrapped, skip_render_check=True)
    env.close()
    many = gym.make_vec(ID, num_envs=4, autoreset_mode="NextStep", first=3.0, **MANY)
    assert many.reset(seed=0)[0].tolist() == [[3.0]] * 4
    assert many.unwrapped.autoreset_mode is gym.vector.AutoresetMode.NEXT_STEP
    assert many.step(np.array([0, 1, 0, 1]))[0].ravel().tolist() == [3.0, 4.0, 3.0, 4.0]
    many.close()


def test_options_that_a_task_lacks_are_errors():
    with pytest.raises(TypeError, match="unexpected keyword argument 'frist'"):
        gym.make(ID, frist=1.0)
    with pytest.raises(TaskError, match=f"{ID} does not take all of these options: frist"):
        make_task(ID, 2, frist=1.0)
    with pytest.raises(TaskError, match="num_envs"):
        gym.make_vec(ID, num_envs=0, **MANY)


def test_environments_of_a_task_with_goals_observe_dicts():
    register_task("test/CountGoals-v0", Slider)
    env = gym.make("test/CountGoals-v0")
    assert isinstance(env.unwrapped, TaskGoalEnv)
    observation, _ = env.reset(seed=0)
    assert sorted(observation) == ["achieved_goal", "desired_goal", "observation"]
    env.close()
    many = gym.make_vec("test/CountGoals-v0", num_envs=3, **MANY)
    assert many.reset(seed=0)[0]["desired_goal"].shape == (3, 2)
    many.close()


def test_a_function_registers_a_wrapped_task():
    register_task("test/CountLate-v0", lambda nworld: FrameStackTask(Count(nworld), 4))
    env = gym.make("test/CountLate-v0")
    assert env.observation_space.shape == (4,)
    env.close()


def test_training_finds_what_a_class_says():
    assert entry_class(ID, vector=False) is entry_class(ID, vector=True) is Count
    assert evaluation_options(ID, {}) == {"first": 7.0}
    assert fitting_copies(ID, 3, {}) == 4


def test_a_class_imported_again_replaces_the_first():
    class Again(Count):
        """A class of the same name."""

    Again.__qualname__ = Count.__qualname__
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        register_task(ID, Again)
    assert entry_class(ID, vector=True) is Again


def test_another_class_of_the_same_id_is_warned_about():
    with pytest.warns(UserWarning, match="Overriding environment"):
        register_task(ID, Slider)


@pytest.mark.parametrize(("task_id", "task"), [("no id at all", Count), ("test/Count-v1", 3)])
def test_what_cannot_be_registered_is_an_error(task_id, task):
    with pytest.raises(TaskError):
        register_task(task_id, task)


def test_an_environment_is_no_task():
    register_task("test/CountEnv-v0", lambda nworld: gym.make("CartPole-v1"))
    with pytest.raises(TaskError, match=r"makes a TimeLimit, not a task(?s:.*)gymnasium.register"):
        gym.make("test/CountEnv-v0")


def test_fixed_options_are_those_of_gymnasium():
    register_task("test/CountMore-v0", Count, kwargs={"first": 9.0})
    env = gym.make("test/CountMore-v0")
    assert env.reset(seed=0)[0].tolist() == [9.0]
    env.close()
