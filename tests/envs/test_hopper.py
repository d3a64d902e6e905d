"""The leg that shall stay up: its figures, and the rules of openai_ros' task."""

from __future__ import annotations

import runpy
from pathlib import Path

import gymnasium as gym
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

from gazelle import assets, formats
from gazelle.envs.hopper.task import HopperTask
from gazelle.envs.options import TaskSettings
from gazelle.rotations import rotate

ID = "gazelle/HopperStayUp-v0"


def begun(nworld=1):
    task = HopperTask(nworld, TaskSettings())
    task.seed(0)
    task.begin(np.arange(nworld))
    return task


def test_gymnasiums_checker_finds_nothing():
    env = gym.make(ID)
    check_env(env.unwrapped, skip_render_check=True)
    env.close()


def test_the_leg_weighs_and_measures_as_published():
    model = formats.load_model(assets.robot("monoped"))
    assert sum(link.inertial.mass for link in model.links) == pytest.approx(0.55)
    limits = {joint.name: (joint.axes[0].lower, joint.axes[0].upper) for joint in model.joints}
    assert limits == {"haa_joint": (-1.6, 1.6), "hfe_joint": (-1.6, 1.6), "kfe_joint": (-1.6, 0.0)}
    task = begun()
    assert task.robot.placement().position[0, 2] == pytest.approx(1.0)


def test_an_action_moves_one_joint_by_a_step():
    task = begun(6)
    before = np.column_stack([joint.positions()[:, 0] for joint in task._joints])
    task.advance(np.arange(6))
    after = np.column_stack([joint.positions()[:, 0] for joint in task._joints])
    wanted = np.zeros((6, 3))
    wanted[[0, 2, 4], [0, 1, 2]], wanted[[1, 3, 5], [0, 1, 2]] = 0.05, -0.05
    wanted[4, 2] = 0.0  # the knee does not bend that way
    np.testing.assert_allclose(after - before, wanted, atol=0.01)


def test_the_reward_is_what_the_published_code_makes_of_what_is_seen():
    task = begun(5)
    rng = np.random.default_rng(0)
    for _ in range(25):
        step = task.advance(rng.integers(0, 6, 5))
        for row, reward in zip(step.observation.astype(float).round(1), step.reward, strict=True):
            wanted = 100 - np.abs(row[5:8]).sum() - abs(row[4] - 7.08)
            wanted -= np.abs(row[1:4]).sum() + np.linalg.norm(row[8:11] - [0, 0, 1])
            assert reward == pytest.approx(wanted)
        assert (step.observation[:, [0, 4]] == 0.0).all()


def test_it_falls_when_nobody_balances_it_and_that_is_the_end():
    env = gym.make_vec(
        ID, num_envs=8, vectorization_mode="vector_entry_point", autoreset_mode="Disabled"
    )
    env.reset(seed=1)
    ended, heights = np.zeros(8, bool), np.full(8, np.inf)
    for number in range(60):
        seen, _, terminated, _, info = env.step(np.full(8, number % 2))
        heights[terminated] = seen[terminated, 10]
        assert not info["is_success"].any()
        if terminated.any():
            env.reset(options={"reset_mask": terminated})
        ended |= terminated
    assert ended.all()
    assert (heights < 0.5).all()
    env.close()


def test_a_sideways_lean_grows_whatever_the_joints_do():
    """As an inverted pendulum from the robot's file, by which tools/hopper_bound.py bounds the task."""
    bound = runpy.run_path(str(Path(__file__).parents[2] / "tools" / "hopper_bound.py"))
    model = formats.load_model(assets.robot("monoped"))
    lean, omega = sum(bound["bounds"](model).values()), bound["leg"](model, 0.0).omega
    assert 0.002 < lean < 0.006
    task = begun(64)
    task.set_lean(np.tile((lean, 0.0), (64, 1)), np.arange(64))
    plane, _ = task.robot.frame("upperleg")
    rng = np.random.default_rng(0)
    for step in range(1, 19):
        task.advance(rng.integers(0, 6, 64))
        leaned = rotate(plane.placement().quaternion, np.tile((0.0, 1.0, 0.0), (64, 1)))[:, 2]
        grown = np.cosh(omega * step * 0.05)
        np.testing.assert_allclose(leaned / lean, grown, rtol=0.12)
