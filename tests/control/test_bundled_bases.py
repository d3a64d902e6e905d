"""The bundled bases drive as their controllers say, on wheels that touch the ground."""

from __future__ import annotations

import math

import numpy as np
import pytest
import yaml

import gazelle
from gazelle import assets
from gazelle.control.values import BaseTwist
from gazelle.formats import load_model


def base(name, nworld=1, **arguments):
    """Return a base in an empty world, with the controllers of its package running."""
    sim = gazelle.Simulation("empty", nworld=nworld)
    robot = sim.spawn(load_model(assets.robot(name), xacro_args=arguments))
    file = assets.root() / f"{name}_control" / "config" / f"{name}_control.yaml"
    for controller, parameters in yaml.safe_load(file.read_text(encoding="utf-8")).items():
        robot.controllers.load(controller, parameters)
        robot.controllers.start(controller)
    sim.run(0.3)
    return sim, robot


def courier(nworld=1):
    return base("courier", nworld, ros_control="true")


def drive(sim, robot, seconds, forward, turning):
    """Send the command repeatedly, as a teleoperation does."""
    for _ in range(round(seconds / 0.2)):
        twist = BaseTwist((forward, 0.0, 0.0), (0.0, 0.0, turning))
        robot.controllers["drive_controller"].inputs["cmd_vel"].send(twist)
        sim.run(0.2)


def odometry(robot):
    """Return the last odometry: x and y [m], heading, speed [m/s] and turning [rad/s]."""
    said = robot.controllers["drive_controller"].outputs["odom"].last
    qz, qw = said.quaternion[0, 2:]
    heading = 2.0 * math.atan2(qz, qw)
    return (*said.position[0, :2], heading), said.linear[0, 0], said.angular[0, 2]


def compare(sim, robot, start):
    """Check that odometry and truth agree as in ros_controllers: 0.01 m, 0.03 rad."""
    (x, y, heading), *_ = odometry(robot)
    true_x, true_y, true_heading = sim.engine.models[robot.name].planar_pose()[0] - start
    assert (x, y) == pytest.approx((true_x, true_y), abs=0.01)
    assert math.remainder(heading - true_heading, math.tau) == pytest.approx(0.0, abs=0.03)


@pytest.mark.long
@pytest.mark.parametrize(("forward", "turning"), [(0.5, 0.0), (0.4, 0.8), (0.0, 1.0), (-0.3, -0.5)])
def test_courier_goes_as_it_is_told_and_knows_where_it_is(forward, turning):
    sim, robot = courier()
    start = sim.engine.models[robot.name].planar_pose()[0]
    drive(sim, robot, 3.0, forward, turning)
    _, ahead, around = odometry(robot)
    assert ahead == pytest.approx(forward, abs=0.02)
    assert around == pytest.approx(turning, abs=0.02)
    drive(sim, robot, 1.0, 0.0, 0.0)
    compare(sim, robot, start)


@pytest.mark.long
@pytest.mark.parametrize(("forward", "angle"), [(1.0, 0.0), (0.6, 0.3), (0.5, -0.5), (-0.4, 0.4)])
def test_the_ackermann_base_rounds_a_circle_of_its_steering_angle(forward, angle):
    sim, robot = base("ackermann_base")
    start = sim.engine.models[robot.name].planar_pose()[0]
    drive(sim, robot, 2.0, forward, angle)
    assert robot.joints["front_steer_joint"].position == pytest.approx(angle, abs=1e-3)
    before = sim.engine.models[robot.name].planar_pose()[0]
    drive(sim, robot, 1.0, forward, angle)
    moved = sim.engine.models[robot.name].planar_pose()[0] - before
    # Half a metre from axle to axle; the middle of the rear axle keeps its distance to the centre.
    turned = forward * math.tan(angle) / 0.5
    assert math.remainder(moved[2] - turned, math.tau) == pytest.approx(0.0, abs=0.03)
    arc = abs(forward) if angle == 0 else abs(2 * forward / turned * math.sin(turned / 2))
    assert np.hypot(*moved[:2]) == pytest.approx(arc, rel=0.02)
    drive(sim, robot, 1.0, 0.0, 0.0)
    compare(sim, robot, start)


@pytest.mark.long
@pytest.mark.parametrize("make", [courier, lambda nworld: base("ackermann_base", nworld)])
def test_a_base_that_is_told_nothing_more_stands_still(make):
    sim, robot = make(nworld=2)
    drive(sim, robot, 1.0, 0.4, 0.2)
    sim.run(1.5)
    before = sim.engine.models[robot.name].planar_pose()
    sim.run(1.0)
    assert sim.engine.models[robot.name].planar_pose() == pytest.approx(before, abs=2e-3)
