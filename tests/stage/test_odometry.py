"""Odometry of Stage's robots."""

import math

import numpy as np
import pytest


def test_odometry_is_the_true_pose_with_gps(start):
    sim = start("position ( pose [1 2 0 90] )")
    sim.commands[:] = (1.0, 0.0, 0.3)
    sim.step(5)
    assert (sim.odometry == sim.poses).all()


def test_odometry_starts_where_its_origin_is(start):
    sim = start(
        'define r position ( localization "odom" odom_error [0 0 0 0] )'
        "r ( pose [1 2 0 90] ) r ( pose [5 2 0 90] localization_origin [5 0 0 90] )"
    )
    assert sim.odometry[0] == pytest.approx(np.array([[0, 0, 0], [2, 0, 0]]), abs=1e-12)


def test_odometry_without_error_follows_the_arc(start):
    sim = start('position ( localization "odom" odom_error [0 0 0 0] drive "omni" )')
    sim.commands[:] = (0.8, -0.3, 0.7)
    sim.step(60)
    assert sim.odometry[0] == pytest.approx(sim.poses[0], abs=1e-9)


def test_odometry_errs_by_a_constant_share_of_its_own(start):
    text = 'define r position ( localization "odom" drive "omni" size [.1 .1 .1] )' + "".join(
        f"r ( pose [0 {5 * i} 0 0] )" for i in range(50)
    )
    sim, again = start(text, seed=4), start(text, seed=4)
    for each in (sim, again):
        each.commands[:, :, 0] = 0.5
        each.step(20)
    assert (sim.odometry == again.odometry).all()
    share = sim.odometry[0, :, 0] - 1.0
    assert np.abs(share).max() <= 0.015
    assert np.ptp(share) > 0.02
    sim.commands[:] = (0.0, 0.0, 0.5)
    sim.step(20)
    share = sim.odometry[0, :, 2] - 1.0
    assert np.abs(share).max() <= 0.025
    assert np.ptp(share) > 0.03


def test_odometry_errs_by_the_share_that_the_file_says(start):
    sim = start('position ( localization "odom" odom_error [0.2 0 0 10] )')
    sim.commands[:] = (0.5, 0.0, 0.0)
    sim.step(20)
    assert sim.odometry[0, 0] == pytest.approx([1.2, 0.0, 0.0])
    sim.commands[:] = (0.0, 0.0, 0.5)
    sim.step(20)  # Stage reads the share of turns in degrees, too
    assert sim.odometry[0, 0, 2] == pytest.approx(1.0 + math.radians(10.0))


def test_odometry_may_be_integrated_as_by_stage(start):
    sim = start('position ( localization "odom" odom_error [0 0 0 0] )', euler=True)
    sim.commands[:] = (0.5, 0.0, 0.4)
    sim.step(2)
    x = 0.05 * (math.cos(0.04) + math.cos(0.08))
    y = 0.05 * (math.sin(0.04) + math.sin(0.08))
    assert sim.odometry[0, 0] == pytest.approx([x, y, 0.08])


def test_wheels_slip_while_a_robot_is_stalled(start):
    sim = start(
        'position ( localization "odom" odom_error [0 0 0 0] )'
        "model ( size [1 1 1] pose [0.8 0 0 0] )"
    )
    sim.commands[:, :, 0] = 1.0
    sim.step(10)
    assert sim.poses[0, 0, 0] < 0.2
    assert sim.odometry[0, 0, 0] == pytest.approx(1.0)
