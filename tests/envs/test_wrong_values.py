"""Wrong values given to tasks are errors of Gazelle's, see ``task_sweep``."""

from __future__ import annotations

import gymnasium as gym
import numpy as np
import pytest
import task_sweep
import wrong_calls
from wrong_calls import Findings

from gazelle.envs import DictRows, GoalTable, PolicyContract, ScanRule
from gazelle.errors import Error, TaskError

CART = "gazelle/CartPoleStayUp-v0"
RAGGED = [[0.0], [1.0, 2.0]]


@pytest.fixture(scope="module")
def many():
    env = gym.make_vec(CART, 2, vectorization_mode="vector_entry_point")
    env.reset(seed=1)
    yield env
    env.close()


@pytest.fixture(scope="module")
def one():
    env = gym.make(CART)
    env.reset(seed=1)
    yield env
    env.close()


@pytest.mark.parametrize("actions", [RAGGED, [10**400], "a", {}, None, [None, None], 1j])
def test_actions_that_are_no_numbers(one, many, actions):
    for env in (one, many):
        with pytest.raises(TaskError, match="actions must be"):
            env.step(actions)


@pytest.mark.parametrize("seed", [-1, -(2**31), np.int64(-1), 1.5, "1"])
def test_seeds_that_cannot_be(one, many, seed):
    for env in (one, many):
        with pytest.raises(TaskError, match="seed must"):
            env.reset(seed=seed)


def test_seeds_of_numpy_are_ints(one):
    first, _ = one.reset(seed=np.int64(3))
    assert (one.reset(seed=3)[0] == first).all()


@pytest.mark.parametrize(
    "change",
    [
        {"elapsed": [np.nan, 0.0]},
        {"elapsed": [0, 0, 0]},
        {"over": [True] * 9},
        {"simulation": None},
        {"simulation": b"no such"},
        {"draws": [0] * 9},
    ],
)
def test_states_of_other_tasks(many, change):
    state = {**many.unwrapped.get_state(), **change}
    with pytest.raises(Error, match=r"state|snapshot"):
        many.unwrapped.set_state(state)


@pytest.mark.parametrize("worlds", [[-1], [2], [[0]], [np.nan], [2**70]])
def test_worlds_that_there_are_not(many, worlds):
    task = many.unwrapped.task
    for call in (
        task.begin,
        lambda chosen: task.advance_or_begin([0, 0], chosen),
        lambda chosen: task.draw(0.0, 1.0, chosen),
    ):
        with pytest.raises(TaskError, match=r"worlds'? must be"):
            call(worlds)


@pytest.mark.parametrize(
    ("name", "options"),
    [
        ("TurtleBot3Stage1", {"time_step": 1e-320}),
        ("TurtleBot3Stage1", {"time_step": float("nan")}),
        ("TurtleBot3Stage1", {"goals": [(float("nan"), 0.0)]}),
        ("TurtleBot3Stage1", {"goals": [(10**400, 0)]}),
        ("MovingCubeOneDiskWalk", {"failure_reward": 10**400}),
        ("MovingCubeOneDiskWalk", {"failure_reward": "high"}),
        ("TurtleBot2Maze", {"course": [10**30]}),
    ],
)
def test_options_that_cannot_be(name, options):
    with pytest.raises(TaskError, match=next(iter(options))):
        gym.make(f"gazelle/{name}-v0", **options)


def test_parts_of_tasks():
    rows = DictRows(gym.spaces.Dict({"a": gym.spaces.Box(-1.0, 1.0, (2,))}))
    table = GoalTable([(0.0, 1.0), (2.0, 1.0)])
    for call in (
        lambda: rows.join({}),
        lambda: rows.join({"a": 1.0}),
        lambda: rows.split(np.zeros((3, 3), np.float32)),
        lambda: table.places(np.array([9])),
        lambda: table.after(np.array([9]), np.zeros(1)),
        lambda: PolicyContract(time_limit=float("nan")),
        lambda: ScanRule(first_angle=float("nan"), last_angle=0.0, no_return=1.0, too_near=0.0),
    ):
        with pytest.raises(TaskError):
            call()


@pytest.mark.slow
@pytest.mark.parametrize("task", task_sweep.distinct_tasks())
def test_a_task_refuses_wrong_values(task):
    findings = Findings()
    with wrong_calls.limits():
        task_sweep.sweep_options(task, findings)
        task_sweep.sweep_calls(task, findings)
    assert not findings.foreign
    assert not findings.late
    assert findings.count > 300
