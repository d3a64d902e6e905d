"""Algorithms of the libraries by name, values by name, callbacks by name, evaluations in between."""

from __future__ import annotations

import csv
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from test_session import StopAt, curves, weights

from gazelle.errors import FormatError, TaskError
from gazelle.training import (
    LibrarySettings,
    Recipe,
    Run,
    evaluate,
    load_actor,
    recipe_for,
    resume,
    train,
    with_values,
)
from gazelle.training.checkpoint import read_checkpoint
from gazelle.training.learners import build_learner
from gazelle.training.tasks import make_task
from gazelle.training.vecenv import VectorEnvAdapter

HERE = Path(__file__).parent
TASK_FILE = str(HERE / "corridor_task.py")

LIBRARY = [
    ("a2c", False, {"n_steps": 8}),
    ("a2c", True, {"n_steps": 8}),
    ("tqc", True, {"learning_starts": 100, "buffer_size": 2000, "batch_size": 32}),
    ("qrdqn", False, {"learning_starts": 100, "buffer_size": 2000, "batch_size": 32}),
    ("trpo", False, {"n_steps": 16, "batch_size": 32}),
    ("recurrent_ppo", False, {"n_steps": 16, "batch_size": 32, "n_epochs": 2}),
]


def library(algo, options, **values):
    return Recipe(
        algo=algo,
        steps=400,
        num_envs=4,
        net_arch=(16,),
        settings=LibrarySettings(options=options),
        **values,
    )


@pytest.mark.long
@pytest.mark.parametrize(("algo", "continuous", "options"), LIBRARY)
def test_library_algorithms_train_and_resume_with_the_same_curve(
    tmp_path, algo, continuous, options
):
    if algo != "a2c":
        pytest.importorskip("sb3_contrib")
    given = {"recipe": library(algo, options), "seed": 5, "continuous": continuous}
    whole = train("test/Corridor-v0", out=tmp_path / "whole", **given)
    first = train("test/Corridor-v0", out=tmp_path / "broken", progress=StopAt(200), **given)
    assert first.interrupted
    second = resume(first.run.folder)
    for name, expected in weights(whole).items():
        assert weights(second)[name].equal(expected), name
    assert curves(second) == curves(whole)


@pytest.mark.long
@pytest.mark.parametrize(
    ("algo", "continuous", "options"), [case for case in LIBRARY if case[0] != "recurrent_ppo"]
)
def test_their_policies_are_evaluated_as_the_library_predicts(tmp_path, algo, continuous, options):
    if algo != "a2c":
        pytest.importorskip("sb3_contrib")
    result = train(
        "test/Corridor-v0", recipe=library(algo, options), out=tmp_path, continuous=continuous
    )
    assert evaluate(result.run.folder, episodes=10).episodes == 10
    config = result.run.config
    env = VectorEnvAdapter(make_task(config.task, 4, **config.options))
    learner = build_learner(config.recipe, env, 0)
    read_checkpoint(result.run.newest_checkpoint(), learner)
    obs = np.random.default_rng(0).uniform(-1.2, 1.2, (1000, 3)).astype(np.float32)
    expected, _ = learner.predict(obs, deterministic=True)
    found = load_actor(result.run.policy_file()).act(obs)
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-6)


def test_wrong_algorithms_settings_and_actions_are_clear_errors(tmp_path):
    with pytest.raises(TaskError, match=r"no algorithm 'tcq'.*did you mean 'tqc'"):
        Recipe(algo="tcq")
    pytest.importorskip("sb3_contrib")
    with pytest.raises(TaskError, match=r"tqc cannot learn Discrete actions.*qrdqn"):
        train("test/Corridor-v0", recipe=library("tqc", {}), out=tmp_path)
    with pytest.raises(TaskError, match="n_stepps"):
        train("test/Corridor-v0", recipe=library("a2c", {"n_stepps": 3}), out=tmp_path)


def test_values_are_changed_by_name():
    recipe = with_values(
        recipe_for("TurtleBot3Stage1"),
        {"net_arch": [32, 8], "batch_size": 512, "goal_reward.collision": 2.0, "gamma": 0.9},
    )
    assert recipe.net_arch == (32, 8)
    assert recipe.settings.batch_size == 512
    assert recipe.goal_reward.collision == 2.0
    assert recipe.gamma == 0.9
    assert recipe.settings.n_epochs == recipe_for("TurtleBot3Stage1").settings.n_epochs
    assert with_values(recipe_for("X", "a2c"), {"n_steps": 5}).settings.options["n_steps"] == 5
    with pytest.raises(TaskError, match=r"has no 'batchsize'.*did you mean 'batch_size'"):
        with_values(recipe, {"batchsize": 3})
    with pytest.raises(TaskError, match="gamma must be"):
        with_values(recipe, {"gamma": 3})


def test_callbacks_and_values_by_option(cli, tmp_path):
    code, _, err = cli(
        "train", "test/Corridor-v0", "--import", TASK_FILE, "--out", tmp_path,
        "--steps", 512, "--num-envs", 8, "--set", "net_arch=[12]", "--set", "n_steps=16",
        "--callback", f"{TASK_FILE}:Counter",
    )  # fmt: skip
    assert code == 0, err
    import corridor_task

    assert corridor_task.Counter.steps >= 512 / 8
    (folder,) = tmp_path.iterdir()
    run = Run.open(folder)
    assert run.config.recipe.net_arch == (12,)
    assert run.config.callbacks == ("corridor_task:Counter",)
    before = corridor_task.Counter.steps
    assert cli("train", "--resume", folder, "--steps", 768)[0] == 0
    assert corridor_task.Counter.steps > before


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("Counter", "is not a callback"),
        (f"{TASK_FILE}:Conter", "did you mean 'Counter'"),
        (f"{TASK_FILE}:NoCallback", "derive it"),
    ],
)
def test_wrong_callbacks_are_clear_errors(tmp_path, tiny, text, complaint):
    with pytest.raises(TaskError, match=complaint):
        train("test/Corridor-v0", recipe=tiny, out=tmp_path, callbacks=[text])


def rows(run):
    with (run.folder / "evaluations.csv").open() as file:
        return list(csv.DictReader(file))


@pytest.mark.long
def test_evaluations_in_between_keep_the_best_and_change_nothing(tmp_path, tiny):
    plain = train("test/Corridor-v0", recipe=tiny, out=tmp_path, seed=3)
    result = train(
        "test/Corridor-v0", recipe=tiny, out=tmp_path, seed=3, eval_every=256, eval_episodes=10
    )
    for name, expected in weights(plain).items():
        assert weights(result)[name].equal(expected), name
    found = rows(result.run)
    assert [int(row["steps"]) for row in found] == [256, 512, 768, 1024]
    best = [row for row in found if row["best"] == "1"][-1]
    assert float(best["success_rate"]) == max(float(row["success_rate"]) for row in found)
    again = evaluate(result.run.folder, best=True, episodes=10, seed=20_000)
    assert again.success.value == float(best["success_rate"])
    assert again.mean_return == float(best["return"])
    with pytest.raises(FormatError, match=r"has no best policy.*--eval-every"):
        evaluate(plain.run.folder, best=True)


@pytest.mark.long
def test_evaluations_go_on_where_a_run_stopped(tmp_path, tiny):
    given = {"recipe": tiny, "seed": 3, "eval_every": 256, "eval_episodes": 10}
    whole = train("test/Corridor-v0", out=tmp_path / "a", **given)
    first = train("test/Corridor-v0", out=tmp_path / "b", progress=StopAt(600), **given)
    second = resume(first.run.folder)
    assert rows(second.run) == rows(whole.run)
    files = [run.policy_file(best=True) for run in (whole.run, second.run)]
    obs = np.random.default_rng(0).uniform(-1.2, 1.2, (50, 3)).astype(np.float32)
    np.testing.assert_array_equal(*[load_actor(file).act(obs) for file in files])


@pytest.mark.long
@pytest.mark.skipif(sys.platform == "win32", reason="needs POSIX signals")
def test_a_killed_run_goes_on_with_the_same_curve(tmp_path, tiny):
    """SIGKILL anywhere: what came after the last checkpoint is done again."""
    given = {"recipe": with_values(tiny, {"steps": 16_000}), "seed": 8, "checkpoint_every": 1000}
    whole = train("test/Corridor-v0", out=tmp_path / "whole", **given)
    script = (
        "import sys; sys.path.insert(0, sys.argv[1])\n"
        "import corridor_task\n"
        "from gazelle.training import Run, train\n"
        "from pathlib import Path\n"
        "config = Run.open(Path(sys.argv[2])).config\n"
        "train(config.task, recipe=config.recipe, seed=8, checkpoint_every=1000, out=sys.argv[3])\n"
    )
    out = tmp_path / "killed"
    process = subprocess.Popen(
        [sys.executable, "-c", script, str(HERE), str(whole.run.folder), str(out)]
    )
    deadline = time.monotonic() + 120
    while not list(out.glob("*/checkpoints/*[0-9]")):
        assert time.monotonic() < deadline
        time.sleep(0.005)
    os.kill(process.pid, signal.SIGKILL)
    process.wait(60)
    (folder,) = out.iterdir()
    second = resume(folder)
    for name, expected in weights(whole).items():
        assert weights(second)[name].equal(expected), name
    assert curves(second) == curves(whole)
