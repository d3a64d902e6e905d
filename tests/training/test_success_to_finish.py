"""A training that succeeds often enough goes over to its end."""

from __future__ import annotations

import csv
import dataclasses

import numpy as np
import pytest
import torch

from gazelle.cli.main import main
from gazelle.errors import TaskError
from gazelle.training import Recipe, Run, recipe_for, resume, train
from gazelle.training.progress import NoProgress
from tests.training.interrupting import StopAt, weights

TASK = "test/Corridor-v0"


class Told(NoProgress):
    """Keeps what is shown."""

    def __init__(self):
        self.starts, self.said = [], []

    def start(self, done, total):
        self.starts.append((done, total))

    def say(self, text):
        self.said.append(text)


@pytest.fixture
def short(tiny):
    """Return a recipe that is content with what chance reaches within 200 episodes."""
    settings = dataclasses.replace(tiny.settings, overlap=False)
    return dataclasses.replace(tiny, steps=40_000, success_to_finish=0.02, settings=settings)


def test_it_ends_after_as_many_steps_again(tmp_path, short):
    told = Told()
    result = train(TASK, recipe=short, seed=3, out=tmp_path, progress=told)
    (_, most), (done, total) = told.starts
    assert most == 40_000
    assert total == short.steps_after_success(done)
    assert told.said == [f"2% succeed after {done:,} steps: ends at {total:,}"]
    assert total <= result.steps < total + short.num_envs * short.rollout_steps
    recipe = Run.open(result.run.folder).config.recipe
    assert recipe == result.run.config.recipe == short.with_steps(total)
    with (result.run.folder / "progress.csv").open() as file:
        rates = [float(row["train/learning_rate"] or "nan") for row in csv.DictReader(file)]
    assert rates[-1] < 0.1 * short.learning_rate
    assert resume(result.run.folder).new_steps == 0


@pytest.mark.parametrize("overlap", [False, True])
@pytest.mark.parametrize("share", [0.2, 0.8])
def test_a_broken_off_one_equals_the_whole(tmp_path, short, overlap, share):
    settings = dataclasses.replace(short.settings, overlap=overlap)
    recipe = dataclasses.replace(short, settings=settings)
    whole = train(TASK, recipe=recipe, seed=5, out=tmp_path / "whole")
    stop = StopAt(int(share * whole.steps))
    first = train(TASK, recipe=recipe, seed=5, out=tmp_path / "broken", progress=stop)
    assert first.interrupted
    np.random.seed(99)  # noqa: NPY002  # resuming must not depend on it
    second = resume(first.run.folder)
    assert second.steps == whole.steps
    for name, expected in weights(whole).items():
        assert torch.equal(weights(second)[name], expected), name


def test_steps_that_a_user_gives_are_all_done(tmp_path, short):
    result = train(TASK, recipe=short, seed=3, out=tmp_path, steps=20_000)
    assert result.steps >= 20_000
    more = resume(result.run.folder, steps=24_000)
    assert more.steps >= 24_000


def test_nothing_is_shortened_below_the_share(tmp_path, short):
    recipe = dataclasses.replace(short, steps=4_000, success_to_finish=1.0)
    assert train(TASK, recipe=recipe, out=tmp_path).steps >= 4_000


@pytest.mark.parametrize(
    ("done", "wanted"), [(0, 300), (100, 300), (200, 400), (499, 998), (900, 1000)]
)
def test_its_end_is_within_its_steps(done, wanted):
    assert Recipe(steps=1_000).steps_after_success(done) == wanted


@pytest.mark.parametrize("share", [0.0, -0.5, 1.5, float("nan")])
def test_a_share_is_a_share(share):
    with pytest.raises(TaskError, match="success_to_finish"):
        Recipe(success_to_finish=share)


def test_tasks_without_a_recipe_have_it(capsys, tmp_path):
    assert recipe_for("my/Own-v0").success_to_finish == 0.95
    words = ["train", TASK, "--import", "tests.training.registering_corridors"]
    assert main([*words, "--steps", "640", "--out", str(tmp_path)]) == 0
    assert "ppo: 2,048 steps, 64 environments" in capsys.readouterr().err
