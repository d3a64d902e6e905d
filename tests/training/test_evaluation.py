from __future__ import annotations

import numpy as np
import pytest
from corridor import MODES, PERIOD

from gazelle.errors import TaskError
from gazelle.training import Actor, evaluate


def actor(gain=0.0, bias=(0.0, 0.0, 0.0)):
    """Moves towards the goal with a gain, or always the same way with a bias."""
    weight = np.array([[gain, 0, -gain], [-gain, 0, gain], [0, 0, 0]], dtype=np.float32)
    return Actor((weight,), (np.array(bias, dtype=np.float32),), "tanh", "categorical")


TASK = "test/Corridor-v0"
RIGHT = actor(bias=(0.0, 0.0, 1.0))


@pytest.mark.parametrize("mode", MODES)
def test_all_modes_find_the_same_rates(mode):
    found = evaluate(actor(gain=1.0), task=TASK, episodes=60, mode=mode.value)
    assert found.success.count == 60
    assert found.collision.count == found.timeout.count == 0


@pytest.mark.parametrize("copies", [1, 7, 50])
def test_short_episodes_are_not_favoured(copies):
    """Rightwards, a goal ahead is met and a goal behind is a collision: half and half.

    Counting whatever ends first would prefer copies whose episodes are short.
    """
    found = evaluate(RIGHT, task=TASK, episodes=400, num_envs=copies)
    assert found.success.total == found.collision.total == 400
    assert found.success.count + found.collision.count + found.timeout.count == 400
    assert found.success.value == pytest.approx(0.5, abs=0.08)
    assert found.mean_length == pytest.approx(9, abs=3)


def test_same_seed_same_result():
    first, second = (evaluate(RIGHT, task=TASK, episodes=50, seed=3).to_dict() for _ in range(2))
    for result in (first, second):
        del result["wall_seconds"], result["rtf"]
    assert first == second


def test_time_is_told():
    found = evaluate(actor(bias=(0.0, 1.0, 0.0)), task=TASK, episodes=10, limit=20)
    assert found.mean_length > 15
    assert found.sim_seconds == pytest.approx(20 * 10 * PERIOD)
    assert found.rtf == pytest.approx(found.sim_seconds / found.wall_seconds)


def test_a_task_that_tells_no_outcome_still_counts_time_outs():
    found = evaluate(actor(bias=(0.0, 1.0, 0.0)), task=TASK, episodes=10, tell=False)
    assert found.success is None
    assert found.collision is None
    assert found.timeout.count >= 8
    assert found.to_dict()["success"] is None


def test_a_policy_file_needs_a_task(tmp_path):
    RIGHT.save(tmp_path / "policy.npz")
    with pytest.raises(TaskError, match="does not tell its task"):
        evaluate(tmp_path / "policy.npz")
    assert evaluate(tmp_path / "policy.npz", task=TASK, episodes=5).episodes == 5


def test_a_policy_of_another_shape_is_refused():
    weight = np.zeros((26, 3), dtype=np.float32)
    wide = Actor((weight,), (np.zeros(3, dtype=np.float32),), "tanh", "categorical")
    with pytest.raises(TaskError, match="takes 26 observations, the task gives 3"):
        evaluate(wide, task=TASK)


@pytest.mark.parametrize("given", [{"episodes": 0}, {"num_envs": 0}])
def test_nothing_to_do_is_refused(given):
    with pytest.raises(TaskError, match="at least 1"):
        evaluate(RIGHT, task=TASK, **given)


def test_evaluation_works_without_torch():
    import subprocess
    import sys

    code = "import sys, gazelle.training; gazelle.training.evaluate; print('torch' in sys.modules)"
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert found.stdout.strip() == "False"
