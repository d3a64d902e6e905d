"""Rollouts by actors of a Ray cluster on this machine."""

from __future__ import annotations

import importlib.util
import os
import signal
import tempfile
from pathlib import Path

import numpy as np
import pytest
from test_workers import curves, trained

from gazelle.errors import TaskError
from gazelle.training import OffPolicySettings, Recipe, load_actor, train
from gazelle.training.evaluation import evaluate
from gazelle.training.progress import NoProgress
from gazelle.training.workers.clusters import RayLink, connect

pytestmark = pytest.mark.long  # a cluster is started for them


@pytest.fixture(scope="module", autouse=True)
def _cluster():
    if importlib.util.find_spec("ray") is None:
        pytest.skip("Ray is not here (pip install 'gazelle[distributed]')")
    import ray

    os.environ["RAY_USAGE_STATS_ENABLED"] = "0"
    # Of a short name, for sockets are in it.
    with tempfile.TemporaryDirectory(prefix="r", ignore_cleanup_errors=True) as folder:
        ray.init(
            address="local", num_cpus=2, include_dashboard=False, _node_ip_address="127.0.0.1", _temp_dir=folder
        )  # fmt: skip
        yield
        ray.shutdown()


@pytest.fixture
def started(monkeypatch):
    """Return the links to actors as they are started."""
    links = []
    begin = RayLink.__init__

    def remembered(link, *arguments):
        begin(link, *arguments)
        links.append(link)

    monkeypatch.setattr(RayLink, "__init__", remembered)
    return links


class KillAnActor(NoProgress):
    """Kills the process of the first actor after some steps."""

    def __init__(self, links, steps):
        self.links = links
        self.steps = steps

    def update(self, done, summary):
        import ray

        if done >= self.steps:
            self.steps = float("inf")
            pid = ray.get(self.links[0].actor.__ray_call__.remote(lambda host: os.getpid()))
            os.kill(pid, signal.SIGKILL)


def test_a_cluster_gives_the_same_curve_as_processes_and_survives_a_death(tmp_path, tiny, started):
    here = trained(tmp_path, tiny, 1)
    there = trained(tmp_path, tiny, None, ray="auto")
    assert curves(there) == curves(here)
    started.clear()
    killed = trained(tmp_path, tiny, 2, ray="auto", progress=KillAnActor(started, 256))
    assert curves(killed) == curves(here)
    assert len(started) == 3


@pytest.mark.slow
def test_actors_play_what_a_demonstrator_shows_as_processes_do(tmp_path):
    shown = OffPolicySettings(
        buffer_size=4000,
        batch_size=64,
        learning_starts=320,
        demonstrator="gazelle.envs.fetch.demonstrators:push",
        imitation=5.0,
    )
    recipe = Recipe(algo="ddpg", steps=480, num_envs=8, net_arch=(16,), settings=shown)
    here = train("FetchPush", recipe=recipe, workers=1, out=tmp_path / "here")
    there = train("FetchPush", recipe=recipe, workers=2, ray="auto", out=tmp_path / "there")
    assert curves(there) == curves(here)
    policies = [load_actor(each.run.policy_file()).weights for each in (here, there)]
    for left, right in zip(*policies, strict=True):
        np.testing.assert_array_equal(left, right)


def test_an_error_of_the_task_is_told_as_it_is(tmp_path, tiny):
    with pytest.raises(TaskError, match="does not take all of these options"):
        trained(tmp_path, tiny, 2, ray="auto", nonsense=3)


def test_processors_of_the_cluster_are_counted():
    assert connect("auto") == 2


@pytest.mark.slow
def test_a_search_is_done_by_a_cluster_and_its_runs_come_back(tmp_path):
    pytest.importorskip("optuna")
    from test_sweep import TASK_FILE, write

    from gazelle.training.sweep import sweep
    from gazelle.training.sweep_plan import SweepPlan

    plan = SweepPlan.read(write(tmp_path, trials=2, steps=1024))
    found = sweep(
        "test/Corridor-v0", plan, out=tmp_path, imports=(TASK_FILE,), workers=2, ray="auto"
    )
    assert [trial.score is not None for trial in found.trials] == [True, True]
    for trial in found.trials:
        assert Path(trial.run).parent == tmp_path / "Corridor-sweep" / "runs"
        assert evaluate(trial.run, episodes=plan.episodes).success.value == trial.score


def test_a_cluster_evaluates_as_processes_do(tmp_path, tiny):
    run = trained(tmp_path, tiny, 1).run.folder
    here = evaluate(run, episodes=30, workers=1)
    there = evaluate(run, episodes=30, ray="auto")
    assert there.records == here.records
