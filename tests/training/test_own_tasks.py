"""Tasks of examples/, written as users write them, and trained with PPO's default."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

from gazelle.training import evaluate, make_task, train

EXAMPLES = Path(__file__).parents[2] / "examples"
TASKS = {
    "dock": "my/Dock-v0",
    "follow_line": "my/FollowLine-v0",
    "pursue": "my/Pursue-v0",
    "push": "my/Push-v0",
    "reach_around": "my/ReachAround-v0",
}


def task_of(file):
    return f"{EXAMPLES / file}.py:{TASKS[file]}"


@pytest.fixture
def benchmark(monkeypatch):
    """Yield the module that measures success rates, and forget those beside it."""
    folder = EXAMPLES.parent / "benchmarks"
    monkeypatch.syspath_prepend(str(folder))
    known = set(sys.modules)
    import recipes

    yield recipes
    for name in set(sys.modules) - known:
        if str(folder) in str(getattr(sys.modules[name], "__file__", "")):
            del sys.modules[name]


@pytest.mark.long
@pytest.mark.parametrize("file", TASKS)
def test_episodes_are_those_of_their_seed_and_in_the_space(file):
    played = []
    for _ in range(2):
        env = make_task(task_of(file), 3)
        env.action_space.seed(1)
        rows = [env.reset(seed=4)[0]]
        rows += [env.step(env.action_space.sample())[0] for _ in range(12)]
        assert all(env.observation_space.contains(row) for row in rows)
        env.close()
        played.append(rows)
    np.testing.assert_array_equal(*played)


@pytest.mark.parametrize(
    ("options", "engine", "evaluate"),
    [
        ("", "planar", "--import examples/dock.py --episodes 1000"),
        (" --engine mujoco", "mujoco", "--engine mujoco --import examples/dock.py --episodes 300"),
    ],
)
def test_a_benchmark_measures_the_task_of_a_file(benchmark, monkeypatch, options, engine, evaluate):
    monkeypatch.chdir(EXAMPLES.parent)
    claim = benchmark.new(f"gazelle train examples/dock.py:my/Dock-v0{options}")
    assert (claim.task, claim.algo, claim.engine) == ("Dock", "ppo", engine)
    assert claim.evaluate == f"gazelle eval RUN {evaluate}"


@pytest.mark.slow
@pytest.mark.parametrize("file", TASKS)
def test_a_users_task_learns_with_the_default(tmp_path, file):
    result = train(task_of(file), out=tmp_path, seed=1)
    found = evaluate(result.run.folder, episodes=300, imports=[str(EXAMPLES / f"{file}.py")])
    assert found.success.interval[0] > 0.9
