"""Values that an algorithm does not support: refused, and by the table that says who does."""

from __future__ import annotations

import dataclasses

import corridor
import pytest
import slider_task

from gazelle.errors import TaskError, TaskWarning
from gazelle.training import (
    LibrarySettings,
    OffPolicySettings,
    PPOSettings,
    Recipe,
    recipe_for,
    train,
    with_values,
)
from gazelle.training.learners import build_learner
from gazelle.training.recipes import recipe_from_dict, recipe_to_dict
from gazelle.training.supported_values import PARTIAL_SUPPORT, supported_only, supports
from gazelle.training.vecenv import VectorEnvAdapter

PUSH = "gazelle.envs.fetch.demonstrators:push"
SHOWS = """import numpy as np

def nothing(rows):
    return np.zeros((len(rows), 2))
"""
read: set[str] = set()


def watching(kind):
    """Return settings of a kind that record which of their values are read."""
    names = {each.name for each in dataclasses.fields(kind)}

    class Watching(kind):
        def __getattribute__(self, name):
            if name in names:
                read.add(name)
            return super().__getattribute__(name)

    return names, Watching


@pytest.fixture
def shows(tmp_path):
    file = tmp_path / "shows_nothing.py"
    file.write_text(SHOWS)
    return f"{file}:nothing"


def values_of(algo, demonstrator):
    if algo == "ppo":
        return {"n_steps": 8, "batch_size": 16, "n_epochs": 1}
    values = {"buffer_size": 400, "batch_size": 8, "learning_starts": 16}
    if algo in PARTIAL_SUPPORT["demonstrator"]:
        values |= {"demonstrator": demonstrator, "imitation": 1.0, "bound_values": True}
    return values


@pytest.mark.parametrize("algo", ["ppo", "dqn", "sac", "td3", "ddpg"])
def test_what_is_said_to_be_heeded_is_what_an_algorithm_reads(algo, shows):
    names, watching_settings = watching(PPOSettings if algo == "ppo" else OffPolicySettings)
    made = (
        corridor.Corridor(4, mode="SameStep", limit=9)
        if algo == "dqn"
        else slider_task.SliderVectorEnv(4)
    )
    env = VectorEnvAdapter(made)
    given = Recipe(algo=algo, net_arch=(8,), settings=watching_settings(**values_of(algo, shows)))
    read.clear()  # of what the check itself read
    build_learner(given, env, seed=0).learn(40, log_interval=None)
    env.close()
    assert read == {name for name in names if supports(algo, name)}


@pytest.mark.parametrize(
    ("algo", "values", "complaint"),
    [
        ("sac", {"demonstrator": PUSH}, r"sac does not support 'demonstrator'.*td3, ddpg"),
        ("dqn", {"policy_delay": 2}, r"dqn does not support 'policy_delay'.*sac, td3, ddpg"),
        ("dqn", {"action_noise": 0.3}, r"dqn does not support 'action_noise'.*td3, ddpg"),
        ("td3", {"exploration_final": 0.1}, r"td3 does not support 'exploration_final'.*dqn"),
        ("ddpg", {"imitation": 2.0}, "imitation needs a demonstrator; name a demonstrator"),
    ],
)
def test_settings_that_change_nothing_are_refused(algo, values, complaint):
    with pytest.raises(TaskError, match=complaint):
        Recipe(algo=algo, settings=OffPolicySettings(**values))


def test_a_recipe_refuses_hindsight_where_nothing_is_remembered():
    with pytest.raises(TaskError, match=r"ppo does not support 'hindsight'.*dqn, sac, td3"):
        Recipe(hindsight=0.5)
    with pytest.raises(TaskError, match="a2c does not support 'hindsight_redraw'"):
        Recipe(algo="a2c", hindsight_redraw=0.5, settings=LibrarySettings())
    assert Recipe(algo="qrdqn", hindsight=0.5, settings=LibrarySettings()).hindsight == 0.5


@pytest.mark.parametrize(
    ("algo", "name", "complaint"),
    [
        ("sac", "imitation", r"sac does not support 'imitation'.*td3, ddpg support"),
        ("ppo", "policy_delay", r"ppo does not support 'policy_delay'.*sac, td3, ddpg support"),
        ("ppo", "tau", r"ppo does not support 'tau'.*dqn, sac, td3, ddpg support"),
        ("sac", "n_epochs", r"sac does not support 'n_epochs'.*ppo support"),
        ("dqn", "bfloat16", r"dqn does not support 'bfloat16'.*ppo, sac, td3, ddpg support"),
        ("ppo", "hindsight", r"ppo does not support 'hindsight'.*dqn, sac"),
        ("td3", "policy_dellay", r"has no 'policy_dellay'; did you mean 'policy_delay'"),
    ],
)
def test_a_value_by_name_is_refused_even_if_it_is_the_default(algo, name, complaint):
    with pytest.raises(TaskError, match=complaint):
        with_values(recipe_for("Unknown", algo), {name: 0})


@pytest.mark.parametrize(
    ("options", "complaint"),
    [
        ({"imitation": 5.0}, r"tqc does not support 'imitation'.*td3, ddpg support"),
        ({"batchsize": 5}, r"tqc does not take 'batchsize'; did you mean 'batch_size'"),
        ({"replay_buffer_class": None}, "tqc is given its 'replay_buffer_class'; leave it out"),
    ],
)
def test_arguments_that_a_librarys_class_does_not_take_are_refused(tmp_path, options, complaint):
    pytest.importorskip("sb3_contrib")
    recipe = Recipe(algo="tqc", num_envs=4, settings=LibrarySettings(options=options))
    with pytest.raises(TaskError, match=complaint):
        train("test/Slider-v0", recipe=recipe, imports=["slider_task"], out=tmp_path)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("algo", ["sac", "tqc", "ppo"])
def test_a_recipe_for_another_algorithm_says_that_its_demonstrator_is_left_out(algo):
    with pytest.warns(TaskWarning, match=f"{algo} cannot be shown what to do.*td3 and ddpg can"):
        recipe = recipe_for("FetchPush", algo)
    assert getattr(recipe.settings, "demonstrator", None) is None
    assert recipe_for("FetchPush", "td3").settings.demonstrator == PUSH


def test_what_is_heeded_is_kept():
    own = recipe_for("FetchPickAndPlace").settings
    left = supported_only("sac", own)
    assert left.batch_size == own.batch_size != OffPolicySettings().batch_size
    assert left.demonstrator is None
    assert left.policy_delay == own.policy_delay
    assert supported_only("ddpg", own) == own


def test_a_saved_recipe_with_such_a_value_is_refused():
    values = recipe_to_dict(Recipe(algo="sac", settings=OffPolicySettings(tau=0.02)))
    assert recipe_from_dict(values).settings == OffPolicySettings(tau=0.02)
    values["settings"]["action_noise"] = 0.3
    with pytest.raises(TaskError, match="sac does not support 'action_noise'"):
        recipe_from_dict(values)
    with pytest.raises(TaskError, match="ppo does not support 'hindsight'"):
        recipe_from_dict(recipe_to_dict(Recipe()) | {"hindsight": 0.3})


def test_the_command_line_says_it(cli, tmp_path):
    code, _, err = cli(
        "train", "FetchReach", "--algo", "sac", "--set", f"demonstrator={PUSH}", "--out", tmp_path
    )
    assert code != 0
    assert "sac does not support 'demonstrator'" in err
    assert not list(tmp_path.iterdir())
