"""Choice of the recipe for a task without one of its own."""

from __future__ import annotations

import csv

import gymnasium as gym
import numpy as np
import pytest
import slider_task

from gazelle.cli.main import main
from gazelle.errors import TaskError
from gazelle.training import RECIPES, Run, evaluate, listed_recipe, recipe_for, task_recipe, train
from gazelle.training.recipes import GOALS, PICTURES


class Anybodys(gym.Env):
    """A goal environment with nothing of ours."""

    def __init__(self, actions=2, size=1):
        part = gym.spaces.Box(-1.0, 1.0, (size,), np.float32)
        names = "observation", "achieved_goal", "desired_goal"
        self.observation_space = gym.spaces.Dict(dict.fromkeys(names, part))
        self.action_space = (
            gym.spaces.Box(-1.0, 1.0, (actions,)) if actions else gym.spaces.Discrete(3)
        )

    def reset(self, *, seed=None, options=None):
        super().reset(seed=seed)
        return self.observation_space.sample(), {}

    def step(self, action):
        return self.observation_space.sample(), -1.0, False, False, {}

    def compute_reward(self, achieved, desired, info):
        return -np.abs(achieved - desired)[..., 0]


class WithoutReward(Anybodys):
    """Its parts have the names, but what another goal had been worth cannot be asked."""

    compute_reward = None


class Never(gym.Env):
    """Not to be made in order to be listed."""

    def __init__(self):
        raise AssertionError


class Seeing(Anybodys):
    """It observes a picture."""

    def __init__(self):
        super().__init__()
        self.observation_space = gym.spaces.Box(0, 255, (20, 20, 3), np.uint8)


def by_function(actions=2):
    return Anybodys(actions)


gym.register("test/Anybodys-v0", Anybodys)
gym.register("test/Discrete-v0", Anybodys, kwargs={"actions": 0})
gym.register("test/ByFunction-v0", by_function)
gym.register("test/WithoutReward-v0", WithoutReward)
gym.register("test/Never-v0", Never)
gym.register("test/Seeing-v0", Seeing)


@pytest.mark.parametrize(
    "task", ["test/Slider-v0", "test/SingleSlider-v0", "test/Anybodys-v0", "test/ByFunction-v0"]
)
def test_goals_are_learnt_with_hindsight(task):
    assert task_recipe(task) == GOALS
    assert GOALS.hindsight > 0.5


@pytest.mark.parametrize("task", ["test/Discrete-v0", "test/WithoutReward-v0"])
def test_others_are_not(task):
    assert task_recipe(task) == recipe_for("Unknown")


@pytest.mark.parametrize("algo", [None, "ppo"])
def test_pictures_are_learnt_from_in_fewer_steps(algo):
    assert task_recipe("test/Seeing-v0", algo) == PICTURES
    assert PICTURES.steps < recipe_for("Unknown").steps
    assert task_recipe("test/Anybodys-v0", "ppo") == recipe_for("Unknown")


def test_options_of_the_environment_count():
    assert task_recipe("test/Anybodys-v0", options={"actions": 0}) == recipe_for("Unknown")
    with pytest.raises(TaskError, match="does not take"):
        task_recipe("test/Anybodys-v0", options={"wheels": 3})


@pytest.mark.parametrize("task", ["FetchPush", "gazelle/TurtleBot3Stage4Continuous-v0", "CartPole"])
def test_a_recipe_of_its_own_and_an_algorithm_that_is_asked_for_come_first(task):
    assert task_recipe(task) == recipe_for(task)
    assert task_recipe("test/Slider-v0", "sac") == recipe_for("Unknown", "sac")
    assert listed_recipe(task) == recipe_for(task)


def test_the_list_tells_by_the_class():
    assert listed_recipe("test/Anybodys-v0") == GOALS
    assert listed_recipe("test/Never-v0") == recipe_for("Unknown")
    for name in ("FetchReach", "TurtleBot3Stage1"):
        assert listed_recipe(f"gazelle/{name}-v0") == RECIPES[name]


def test_an_unknown_task_is_named():
    with pytest.raises(TaskError, match=r"no task 'test/Slyder-v0'.*test/Slider-v0"):
        task_recipe("test/Slyder-v0")


@pytest.mark.long
def test_train_uses_it_from_python_and_the_command_line(tmp_path):
    result = train("test/Slider-v0", steps=64, num_envs=2, out=tmp_path)
    assert result.run.config.recipe.algo == GOALS.algo
    assert result.run.config.recipe.hindsight_redraw == GOALS.hindsight_redraw
    command = ["train", "test/SingleSlider-v0", "--steps", "32", "--num-envs", "2"]
    command += ["--import", slider_task.__file__, "--set", "batch_size=64", "--out", str(tmp_path)]
    assert main(command) == 0
    runs = [Run.open(each) for each in tmp_path.iterdir() if "Single" in each.name]
    assert [run.config.recipe.settings.batch_size for run in runs] == [64]
    assert runs[0].config.recipe.algo == GOALS.algo


@pytest.mark.slow
@pytest.mark.parametrize("seed", [0, 1])
def test_the_default_learns_a_users_goals(tmp_path, seed):
    result = train("test/Slider-v0", steps=16_000, out=tmp_path, seed=seed)
    assert evaluate(result.run.folder, episodes=100).success.value > 0.95
    with (result.run.folder / "progress.csv").open() as file:
        assert len(list(csv.DictReader(file))) > 3
