"""States, rewards and ends are those of the published node, number by number."""

from __future__ import annotations

import math

import gymnasium as gym
import node
import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

import gazelle.envs  # noqa: F401  registers the environments
from gazelle.envs.options import NavigationSettings
from gazelle.envs.turtlebot3.actions import discrete_command
from gazelle.envs.turtlebot3.observations import sight
from gazelle.envs.turtlebot3.rewards import judge
from gazelle.envs.turtlebot3.rules import STAGES
from gazelle.envs.turtlebot3.task import TurtleBot3Task

lengths = st.floats(0.0, 3.5, width=32)
near_ties = st.sampled_from([0.13, 0.12999999, 0.13000001, 0.495, 0.4949999, 0.4950001, 0.5, 0.505])
specials = st.sampled_from([math.inf, -math.inf, math.nan, 0.0])
scans = st.lists(st.one_of(lengths, lengths, near_ties, specials), min_size=2, max_size=24)
places = st.tuples(st.floats(-2.3, 2.3), st.floats(-2.3, 2.3))


def judged(stage, ranges, position, yaw, goal, action, start_distance):
    """Return state, reward, collision and arrival of one robot, by the functions of the tasks."""
    rules = STAGES[stage]
    view = sight(
        rules,
        ranges=np.array([ranges], np.float64),
        range_min=node.TOO_NEAR,
        pose=np.array([[*position, yaw]]),
        goal=np.array([goal]),
    )
    _, angular = discrete_command([action], 1)
    reward, crashed, arrived = judge(rules, view, angular, np.array([start_distance]))
    return view.state[0], reward[0], crashed[0], arrived[0]


@pytest.mark.long
@settings(max_examples=400)
@given(
    st.sampled_from([1, 2, 3, 4]), scans, places, st.floats(-math.pi, math.pi), places,
    st.integers(0, 4), st.integers(1, 660),
)  # fmt: skip
@example(4, [0.495, 1.0], (0.0, 0.0), 0.0, (1.0, 0.0), 2, 100)
@example(4, [0.4999999, 1.0], (0.0, 0.0), 0.0, (1.0, 0.0), 2, 100)
@example(4, [math.nan, 0.1], (0.0, 0.0), 0.0, (1.0, 0.0), 0, 100)
@example(4, [0.1, math.inf], (0.0, 0.0), 0.0, (0.1, 0.0), 4, 100)
def test_a_step_is_the_nodes(stage, ranges, position, yaw, goal, action, cents):
    message = np.array(ranges, np.float32)
    start = round(cents / 100, 2)
    numbers, crash, there = node.state(stage, message, position, yaw, goal)
    wanted = node.reward(stage, numbers, action, start, collided=crash, arrived=there)
    state, reward, crashed, arrived = judged(stage, ranges, position, yaw, goal, action, start)
    assert state.tolist() == np.array(numbers, np.float32).tolist()
    assert (bool(crashed), bool(arrived)) == (crash, there)
    assert reward == pytest.approx(wanted, rel=1e-15)  # NumPy's powers are off in their last bit


@pytest.mark.parametrize("engine", ["mujoco", "planar"])
@pytest.mark.parametrize("stage", [1, 2, 3, 4])
def test_what_an_environment_pays_is_what_the_node_pays_for_its_observation(stage, engine):
    nworld, rays = 32, 24
    settings = NavigationSettings(engine=engine, seed=3, threads=1, lidar_samples=rays)
    task = TurtleBot3Task(stage, nworld, continuous=False, settings=settings)
    first, _ = task.begin(np.arange(nworld))
    start = first[:, rays + 1].astype(float).round(2)
    generator = np.random.default_rng(stage)
    grazed = 0
    for _ in range(90):
        actions = generator.choice([1, 2, 2, 2, 3], nworld)
        made = task.advance(actions)
        for world in range(nworld):
            numbers = made.observation[world].astype(float).tolist()
            numbers[rays:] = [round(number, 2) for number in numbers[rays:]]
            shortest = min(numbers[:rays])
            grazed += 0.495 <= shortest < 0.5
            crash, there = 0 < shortest < 0.13, numbers[rays + 1] < 0.2
            wanted = node.reward(
                stage, numbers, int(actions[world]), start[world], collided=crash, arrived=there
            )
            assert made.reward[world] == pytest.approx(wanted, rel=1e-13)
            assert made.terminated[world] == crash
        done = np.flatnonzero(made.terminated)
        for world in np.flatnonzero(made.info["is_success"]):
            place = task.scene.robot.position[world]
            start[world] = node.distance(place, made.info["goal"][world])
        if len(done):
            start[done] = task.begin(done)[0][:, rays + 1].astype(float).round(2)
    assert grazed
    task.close()


@pytest.mark.parametrize("engine", ["mujoco", "planar"])
def test_the_time_is_out_in_the_step_after_the_500th(engine):
    env = gym.make("gazelle/TurtleBot3Stage1-v0", engine=engine, goals=[(1.5, 1.5)])
    env.reset(seed=0)
    ends = [env.step(0)[2:4] for _ in range(501)]  # in circles
    assert not any(map(any, ends[:-1]))
    assert ends[-1] == (False, True)
    env.close()
