"""Tasks of examples/, written as users write them, and trained with PPO's default."""

from __future__ import annotations

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


@pytest.mark.slow
@pytest.mark.parametrize(
    ("file", "steps"),
    [("dock", None), ("follow_line", 100_000), ("pursue", None)],
)
def test_a_users_task_learns_with_the_default(tmp_path, file, steps):
    """Without features of distances and angles 35 % dock."""
    result = train(task_of(file), out=tmp_path, steps=steps, seed=1)
    found = evaluate(result.run.folder, episodes=300, imports=[EXAMPLES / f"{file}.py"])
    assert found.success.interval[0] > 0.9
