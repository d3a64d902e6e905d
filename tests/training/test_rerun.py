"""Episodes of an evaluation played again."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from corridor import MODES

from gazelle.errors import TaskError
from gazelle.training import Actor, evaluate
from gazelle.training.rerun import Rerun, worst_first

LOW = -np.ones(2, np.float32)
TASK = "test/Corridor-v0"
RIGHT = Actor(
    (np.zeros((3, 3), np.float32),), (np.array([0.0, 0.0, 1.0], np.float32),), "tanh", "categorical"
)


def played_again(found):
    """Return whether each episode was the same again, its pace, and its record."""
    with Rerun(found) as rerun:
        for record in worst_first(found):
            paced = []
            yield rerun.play(record, paced.append), paced, record


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("copies", [1, 4])
def test_every_episode_is_played_again_as_it_was_failures_first(mode, copies):
    found = evaluate(RIGHT, task=TASK, episodes=10, num_envs=copies, mode=mode.value)
    failed = []
    for same, paced, record in played_again(found):
        assert same
        assert paced == list(range(record.length, 0, -1))
        failed.append(record.failed)
    assert failed == sorted(failed, reverse=True)
    assert sum(failed) == len(found.failures) > 0
    assert len(failed) == 10
    assert not all(failed)


def test_copies_that_share_a_world_are_played_again_from_their_own_start():
    import gazelle.envs  # noqa: F401  # registers the tasks

    zeros = Actor(
        (np.zeros((28, 2), np.float32),),
        (np.ones(2, np.float32),),
        "tanh",
        "gaussian",
        low=LOW,
        high=-LOW,
    )
    options = {"agents": 2, "lidar_samples": 24, "max_episode_steps": 20}
    found = evaluate(zeros, task="AGVFleet", episodes=8, num_envs=4, **options)
    places = [record.place for record in found.records]
    assert {place.reset for place in places} == {0, 1}
    assert {place.turn for place in places} == {0}
    assert sorted(place.copy for place in places) == [0, 0, 1, 1, 2, 2, 3, 3]
    assert all(same for same, _, _ in played_again(found))


def test_episodes_of_workers_have_no_place():
    found = evaluate(RIGHT, task=TASK, episodes=4)
    with Rerun(found) as rerun, pytest.raises(TaskError, match="workers"):
        rerun.play(replace(found.records[0], place=None), print)
    with pytest.raises(TaskError, match="workers"):
        Rerun(replace(found, setup=None))
