"""Joints that are put at their positions, all at once; and what becomes of those that others put elsewhere."""

from __future__ import annotations

import numpy as np
import pytest

import gazelle
from gazelle import formats
from gazelle.control.values import JointTargets
from gazelle.description import World
from tests.control.arms import JOINTS, arm_text

FREE = World("w", gravity=(0.0, 0.0, 0.0))
GAINS = {"p": 300.0, "i": 5.0, "d": 30.0, "i_clamp": 10.0}


def arms(gains=None):
    sim = gazelle.Simulation(FREE, nworld=3)
    robot = sim.spawn(formats.load_model_string(arm_text("Position")))
    if gains:
        robot.settings["pid_gains"].send(dict.fromkeys(JOINTS, gains))
    of = "position_controllers/JointGroupPositionController"
    robot.controllers.load("c", {"type": of, "joints": JOINTS})
    robot.controllers.start("c")
    return sim, robot


def where(robot):
    return np.concatenate([robot.joints[name].positions() for name in JOINTS], axis=1)


def send(robot, *targets, worlds=None):
    robot.controllers["c"].inputs["command"].send(JointTargets(targets), worlds)


def test_all_at_once_are_put_where_each_by_itself_is_to_the_bit():
    """Also where a command is no number, limits of one world change, and another model comes."""
    ends = []
    for at_once in (True, False):
        sim, robot = arms()
        sim.controls_in_step = at_once
        sim.step(3)
        send(robot, 0.7, -0.4)
        sim.step(50)
        send(robot, np.nan, 1.2, worlds=np.array([1]))
        send(robot, 2.9, -2.9, worlds=np.array([2]))
        sim.step(50)
        sim.parameters.joint_upper.set(f"{robot.name}::shoulder", 0.5, np.array([2]))
        sim.step(50)
        assert 0.49 < where(robot)[2, 0] < 0.51  # its command would have it at 0.6
        other = formats.load_model_string(arm_text("Position"))
        sim.spawn(other, name="another", pose=gazelle.Pose(x=5.0))
        sim.step(50)
        ends.append((sim.engine.snapshot(), robot.controllers.hardware.state()))
    assert np.array_equal(ends[0][0], ends[1][0])
    for name, value in ends[1][1].items():
        assert np.array_equal(ends[0][1][name], value, equal_nan=value.dtype.kind == "f"), name


def test_joints_that_are_placed_go_back_to_their_command_at_once():
    """As in Gazebo, whose hardware goes on from its last command, wherever the joint is by now."""
    sim, robot = arms()
    send(robot, 0.5, -0.3)
    sim.run(1.0)
    robot.set_configuration(JOINTS, [-1.0, 1.0])
    sim.step()
    assert where(robot) == pytest.approx(np.tile([0.5, -0.3], (3, 1)), abs=1e-3)


def test_joints_with_gains_are_driven_back_to_their_command():
    sim, robot = arms(GAINS)
    send(robot, 0.5, -0.3)
    sim.run(2.0)
    robot.set_configuration(JOINTS, [-1.0, 1.0])
    sim.step()
    assert np.abs(where(robot) - [-1.0, 1.0]).max() < 0.1
    sim.run(4.0)
    assert where(robot) == pytest.approx(np.tile([0.5, -0.3], (3, 1)), abs=0.02)


def test_a_controller_that_starts_anew_holds_where_joints_were_put():
    sim, robot = arms()
    send(robot, 0.5, -0.3)
    sim.run(1.0)
    robot.set_configuration(JOINTS, [-1.0, 1.0])
    robot.controllers.stop("c")
    robot.controllers.start("c")
    sim.run(0.1)
    assert where(robot) == pytest.approx(np.tile([-1.0, 1.0], (3, 1)), abs=1e-3)
