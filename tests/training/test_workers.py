"""Rollouts in other processes: the same curve with any number of workers, whatever befalls them."""

from __future__ import annotations

import csv
import os
import signal
import warnings
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from test_session import SMALL

from gazelle.errors import SimulationWarning, TaskError
from gazelle.training import Recipe, evaluate, resume, train
from gazelle.training.progress import NoProgress
from gazelle.training.workers import ShardHost, ShardSpec, WorkerGroup, WorkerLostError, divided
from gazelle.training.workers.processes import ProcessLink

TASKS = str(Path(__file__).with_name("registering_corridors.py"))


def curves(result):
    with (result.run.folder / "progress.csv").open() as file:
        rows = list(csv.DictReader(file))
    for row in rows:
        del row["time/seconds"], row["time/steps_per_second"]
    return rows


def trained(tmp_path, tiny, workers, **options):
    given = {"recipe": tiny, "seed": 5, "imports": [TASKS], "out": tmp_path} | options
    return train("test/Corridor-v0", workers=workers, **given)


@pytest.fixture
def started(monkeypatch):
    """Return the links to processes as they are started."""
    links = []
    begin = ProcessLink.__init__

    def remembered(link, *arguments, **options):
        begin(link, *arguments, **options)
        links.append(link)

    monkeypatch.setattr(ProcessLink, "__init__", remembered)
    return links


class KillAt(NoProgress):
    """Kills workers after some steps."""

    def __init__(self, links, *steps):
        self.links = links
        self.steps = list(steps)

    def update(self, done, summary):
        while self.steps and done >= self.steps[0]:
            self.steps.pop(0)
            os.kill(self.links[0].pid, signal.SIGKILL)
            self.links.pop(0)


@given(st.integers(1, 5000), st.sampled_from([1, 1, 3, 12]))
@settings(max_examples=200)
def test_shards_are_all_copies_and_nearly_equal(groups, unit):
    sizes = divided(groups * unit, unit)
    assert sum(sizes) == groups * unit
    assert max(sizes) - min(sizes) <= unit
    assert max(sizes) <= max(256, unit)
    assert len(sizes) >= min(8, groups) or max(sizes) == unit
    assert all(size % unit == 0 for size in sizes)


def test_copies_that_belong_together_are_not_divided():
    with pytest.raises(TaskError, match="multiple of 12, not 30"):
        divided(30, 12)


@pytest.mark.long
@pytest.mark.parametrize("mode", ["SameStep", "NextStep"])
def test_any_number_of_workers_gives_the_same_curve(tmp_path, tiny, mode):
    one = trained(tmp_path, tiny, 1, mode=mode)
    three = trained(tmp_path, tiny, 3, mode=mode)
    assert curves(one) == curves(three)
    assert len(curves(one)) > 3
    assert not one.interrupted


@pytest.mark.long
def test_a_killed_worker_is_replaced_and_nothing_is_lost(tmp_path, tiny, started):
    quiet = trained(tmp_path, tiny, 2)
    started.clear()
    killed = trained(tmp_path, tiny, 2, progress=KillAt(started, 128, 512))
    assert len(started) == 2  # two of four
    assert curves(killed) == curves(quiet)


@pytest.mark.long
def test_a_run_goes_on_with_another_number_of_workers(tmp_path, tiny):
    whole = trained(tmp_path, tiny, 2)
    part = trained(tmp_path, tiny, 2, steps=512)
    on = resume(part.run.folder, steps=1024, workers=4)
    assert on.steps == 1024
    assert curves(on)[-1]["episodes/total"] == curves(whole)[-1]["episodes/total"]
    assert evaluate(on.run.folder, episodes=8, imports=[TASKS]).episodes == 8


def test_a_run_begun_alone_goes_on_alone(tmp_path, tiny):
    run = train("test/Corridor-v0", recipe=tiny, out=tmp_path, steps=256).run
    with pytest.raises(TaskError, match="started without workers"):
        resume(run.folder, steps=512, workers=2)


@pytest.mark.long
def test_other_algorithms_step_their_workers(tmp_path):
    recipe = Recipe(algo="dqn", steps=600, num_envs=8, net_arch=(16,), settings=SMALL)
    one, two = (trained(tmp_path, recipe, workers) for workers in (1, 2))
    assert curves(one) == curves(two)


@pytest.mark.long
def test_a_worker_lost_in_a_step_cuts_its_episodes_off(tmp_path, started):
    recipe = Recipe(algo="dqn", steps=600, num_envs=8, net_arch=(16,), settings=SMALL)
    with warnings.catch_warnings():
        warnings.simplefilter("error", SimulationWarning)
        result = trained(tmp_path, recipe, 2, progress=KillAt(started, 200))
    assert result.steps == 600


def test_more_workers_than_parts_is_one_clear_error(tmp_path, tiny):
    with pytest.raises(TaskError, match="9 workers cannot share 8 parts") as caught:
        trained(tmp_path, tiny, 9)
    assert "--num-envs" in caught.value.hint


@pytest.mark.long
def test_an_error_of_the_task_is_told_as_it_is(tmp_path, tiny):
    with pytest.raises(TaskError, match="does not take all of these options"):
        trained(tmp_path, tiny, 2, nonsense=3)


class Mortal:
    """A worker in this process that is lost at some requests."""

    def __init__(self, blueprint, numbers, lost):
        self.host = ShardHost(blueprint, numbers)
        self.lost = lost

    def send(self, method, *arguments):
        self.request = method, arguments

    def receive(self):
        if next(self.lost):
            raise WorkerLostError
        method, arguments = self.request
        return getattr(self.host, method)(*arguments)

    def close(self):
        self.host.close()


def test_a_worker_that_always_dies_ends_the_run():
    blueprint = ShardSpec(task="test/Corridor-v0", sizes=(2, 2))
    team = WorkerGroup(lambda numbers: Mortal(blueprint, numbers, iter([True] * 50)), 2, 1)
    with pytest.raises(TaskError, match="ended 4 times in the same work"):
        team.call("reset", 1)


def test_a_task_that_cannot_save_its_state_starts_anew():
    blueprint = ShardSpec(task="test/Forgetful-v0", sizes=(2, 2))
    deaths = iter([False, True, *[False] * 50])
    team = WorkerGroup(lambda numbers: Mortal(blueprint, numbers, deaths), 2, 1)
    team.call("reset", 1)
    assert team.states is None
    with pytest.warns(SimulationWarning, match="episodes start again"):
        team.call("get_state")
    assert team.replaced == 1


@pytest.mark.long
def test_an_evaluation_does_not_depend_on_the_number_of_workers(tmp_path, tiny):
    run = trained(tmp_path, tiny, 1).run.folder
    one, two = (evaluate(run, episodes=30, workers=workers) for workers in (1, 2))
    assert one.records == two.records
    assert len(one.records) == one.episodes == 30
    assert one.distinct == two.distinct
    assert one.sim_seconds == two.sim_seconds
    assert evaluate(run, episodes=30, workers=2, seed=5).records != one.records
