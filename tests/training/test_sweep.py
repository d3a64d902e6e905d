"""Searching hyperparameters: over processes, and on where it was killed."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from gazelle.errors import FormatError, TaskError

pytest.importorskip("optuna")
from gazelle.training.sweep import sweep
from gazelle.training.sweep_plan import SweepPlan

TASK_FILE = str(Path(__file__).parent / "corridor_task.py")
PLAN = """
parameters:
  learning_rate: {low: 0.0001, high: 0.01, log: true}
  net_arch: {choices: [[8], [16, 8]]}
  n_epochs: {low: 1, high: 3}
  batch_size: {choices: [64]}
trials: TRIALS
workers: WORKERS
steps: STEPS
episodes: 20
"""


def write(folder, trials, workers=1, steps=4096):
    text = PLAN.replace("TRIALS", str(trials)).replace("WORKERS", str(workers))
    file = folder / "search.yaml"
    file.write_text(text.replace("STEPS", str(steps)))
    return file


@pytest.mark.long
def test_a_search_tries_values_over_processes(cli, tmp_path):
    file = write(tmp_path, trials=3, workers=2)
    options = ("--import", TASK_FILE, "--out", tmp_path)
    code, out, err = cli("train", "test/Corridor-v0", "--sweep", file, *options)
    assert code == 0, err
    assert "3 new trials" in out
    assert out.count("learning_rate=") == 3
    runs = list((tmp_path / "Corridor-sweep" / "runs").iterdir())
    assert len(runs) == 3
    # Nothing is left to do.
    found = sweep("test/Corridor-v0", SweepPlan.read(file), out=tmp_path, imports=(TASK_FILE,))
    assert (found.new, len(found.trials)) == (0, 3)
    scores = [trial.score for trial in found.trials]
    assert scores == sorted(scores, reverse=True)
    assert set(found.trials[0].values) == {"learning_rate", "net_arch", "n_epochs", "batch_size"}
    assert found.trials[0].values["net_arch"] in ([8], [16, 8])


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="needs POSIX signals")
def test_a_killed_search_goes_on(tmp_path):
    file = write(tmp_path, trials=3, workers=2, steps=40_000)
    command = [
        sys.executable, "-m", "gazelle", "train", "test/Corridor-v0", "--sweep", str(file),
        "--import", TASK_FILE, "--out", str(tmp_path),
    ]  # fmt: skip
    runs = tmp_path / "Corridor-sweep" / "runs"
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    deadline = time.monotonic() + 120
    while not (runs.is_dir() and len(list(runs.iterdir())) == 2):
        assert time.monotonic() < deadline
        assert process.poll() is None
        time.sleep(0.05)
    os.kill(process.pid, signal.SIGKILL)
    process.communicate(timeout=120)  # until the workers ended too: they hold the pipes
    found = sweep("test/Corridor-v0", SweepPlan.read(file), out=tmp_path, imports=(TASK_FILE,))
    assert len(found.trials) == 3
    assert all(trial.score is not None for trial in found.trials)


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("trials: 3", "not a sweep"),
        ("parameters: {gamma: {low: 0.9}}", "needs low and high"),
        ("parameters: {}\ntrails: 3", "no 'trails'.*did you mean 'trials'"),
        ("parameters: {}\nmetric: reward", "no metric 'reward'"),
        ("parameters: {}\nworkers: 0", "1 or more"),
        ("a: [", "cannot read"),
    ],
)
def test_a_wrong_plan_is_one_clear_error(tmp_path, text, complaint):
    file = tmp_path / "search.yaml"
    file.write_text(text)
    with pytest.raises(FormatError, match=complaint):
        SweepPlan.read(file)


def test_a_parameter_that_is_none_is_refused_at_once(tmp_path):
    plan = SweepPlan(parameters={"learnign_rate": {"low": 1e-4, "high": 1e-2}})
    with pytest.raises(TaskError, match="did you mean 'learning_rate'"):
        sweep("test/Corridor-v0", plan, out=tmp_path)


@pytest.mark.long
def test_when_all_trials_fail_it_says_so(tmp_path):
    plan = SweepPlan(parameters={"gamma": {"low": 2.0, "high": 3.0}}, trials=1)
    with pytest.raises(TaskError, match="all trials failed"):
        sweep("test/Corridor-v0", plan, out=tmp_path, imports=(TASK_FILE,))
    assert "gamma must be between" in (tmp_path / "Corridor-sweep" / "errors.log").read_text()
