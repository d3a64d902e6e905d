"""Readings of a robot's sensors become the observations that the policy was trained on."""

from __future__ import annotations

import dataclasses
import math

import gymnasium as gym
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import gazelle.envs
from gazelle.envs import PolicyContract, ScanRule
from gazelle.errors import TaskError
from gazelle.training.deploy import OdometryReading, ScanReading
from gazelle.training.deploy.sensing import Observer, sampled

TASKS = ("TurtleBot3Stage1", "TurtleBot3Stage4", "TurtleBot3Stage3Continuous", "AGVFleet")


def poses(env):
    task = env.unwrapped.task
    return task.poses if hasattr(task, "poses") else task.scene.robot.planar_pose()


def odometry(env, row, obs, contract):
    speeds = {p.kind: float(obs[p.start]) for p in contract.observation if p.size == 1}
    return OdometryReading(*row, speeds.get("forward_speed", 0.0), speeds.get("yaw_rate", 0.0))


@pytest.mark.parametrize("task", TASKS)
def test_observations_are_those_of_the_task(task):
    """Ranges, pose and goal of the task's own robot, given as a robot's sensors give them."""
    env = gym.make_vec(
        f"gazelle/{task}-v0", 8, vectorization_mode="vector_entry_point", engine="planar"
    )
    contract = env.unwrapped.contract
    observer = Observer(contract)
    rule, part = contract.scan, contract.observation[0]
    step = (rule.last_angle - rule.first_angle) / (part.size - 1)
    obs, _ = env.reset(seed=3)
    for _ in range(30):
        obs, _, _, _, info = env.step(env.action_space.sample())
        for world, row in enumerate(poses(env)):
            if info["is_success"][world]:
                continue  # the observation is of the goal that was reached
            ranges = obs[world, : part.size].astype(np.float64)
            ranges[ranges >= rule.no_return] = np.inf
            scan = ScanReading(ranges, rule.first_angle, step)
            goal = tuple(info["goal"][world])
            found = observer.observe(scan, odometry(env, row, obs[world], contract), goal)
            np.testing.assert_allclose(found[0], obs[world], rtol=0, atol=1e-6)
    env.close()


RULE = ScanRule(first_angle=0.0, last_angle=2 * math.pi, no_return=3.5, too_near=0.12, farthest=3.5)


def full_scan(values, first=0.0):
    values = np.asarray(values, dtype=float)
    return ScanReading(values, first, 2 * math.pi / len(values), 0.12, 3.5)


@pytest.mark.parametrize(
    ("reported", "expected"),
    [(np.inf, 3.5), (-np.inf, 0.12), (3.6, 3.5), (2.0, 2.0), (np.nan, 1.5), (0.0, 1.5)],
)
def test_what_is_no_number_becomes_one(reported, expected):
    """A ray that failed is taken from its neighbour."""
    values = np.full(360, 1.5)
    values[0] = reported
    assert sampled(full_scan(values), RULE, 24)[0] == np.float32(expected)


def test_where_all_rays_of_a_place_failed_nothing_is_in_range():
    values = np.zeros(360)
    values[100:200] = 1.0
    ranges = sampled(full_scan(values), RULE, 24)
    assert ranges[0] == 3.5
    assert ranges[10] == 1.0


@given(
    st.integers(30, 2000), st.integers(2, 30), st.floats(-3.0, 3.0), st.floats(-math.pi, math.pi)
)
def test_each_ray_is_the_nearest_in_angle(rays, samples, first, turned):
    """The range of every ray is its angle on the robot, so that one can tell which was taken."""
    scan = full_scan(np.ones(rays), first)
    angles = scan.angles(turned)
    scan = dataclasses.replace(scan, ranges=2.0 + angles / 10.0)
    found = (sampled(scan, RULE, samples, turned=turned) - 2.0) * 10.0
    wanted = np.linspace(0.0, 2.0 * math.pi, samples)
    off = np.abs(np.angle(np.exp(1j * (found - wanted))))
    assert off.max() <= math.pi / rays + 1e-4


def test_lidars_of_both_numberings_give_the_same():
    """From 0 to 2 pi as the TurtleBot3's, from -pi to pi as many others."""
    ranges = np.random.default_rng(0).uniform(0.2, 3.0, 360)
    one = sampled(full_scan(ranges), RULE, 24)
    other = sampled(full_scan(np.roll(ranges, 180), -math.pi), RULE, 24)
    np.testing.assert_array_equal(one, other)


def test_a_policy_that_sees_something_else_is_refused():
    task = gym.make("CartPole-v1")
    from gazelle.envs.contract import generic_contract

    contract = generic_contract(task.observation_space, task.action_space, None)
    with pytest.raises(TaskError, match="sees 'observation'"):
        Observer(contract)


def test_single_environments_tell_the_contract_too():
    env = gym.make("gazelle/TurtleBot3Stage2-v0", engine="planar", lidar_samples=36)
    contract = env.unwrapped.contract
    assert isinstance(contract, gazelle.envs.PolicyContract)
    assert contract.observation[0].size == 36
    assert PolicyContract.from_dict(contract.to_dict()) == contract
    env.close()
