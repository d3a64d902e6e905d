"""Grippers of Stage's robots: paddles, lift, beams, and what they carry."""

import math

import numpy as np
import pytest

from gazelle import SimulationError

GRIPPER = "gripper ( size [.2 .3 .2] pose [.3 0 -.4 0] {} )"
ROBOT = 'position ( name "r" size [.4 .4 .4] ' + GRIPPER + " )\n"
PUCK = 'model ( name "puck" size [.08 .08 .1] gripper_return 1 pose [{} {} 0 0] )\n'
BETWEEN = 0.34  # the paddles begin at 0.268 and end at 0.4


def test_the_paddles_close_and_open_in_twenty_updates(start):
    sim = start(ROBOT.format(""))
    gripper = sim.gripper("r")
    gripper.do("close")
    sim.step(10)
    assert gripper.state().paddles == pytest.approx(0.5)
    sim.step(15)
    assert gripper.state().paddles == 1.0
    gripper.do("open")
    sim.step(25)
    assert gripper.state().paddles == 0.0


def test_the_lift_goes_up_and_down(start):
    sim = start(ROBOT.format('paddle_state [ "open" "up" ]'))
    gripper = sim.gripper("r")
    assert gripper.state().lift == 1.0
    gripper.do("down")
    sim.step(5)
    assert gripper.state().lift == pytest.approx(0.75)
    sim.step(20)
    assert gripper.state().lift == 0.0


def test_beams_tell_of_what_is_between_the_paddles(start):
    assert start(ROBOT.format("") + PUCK.format(0.352, 0)).gripper("r").beams() == (False, True)
    assert start(ROBOT.format("") + PUCK.format(0.31, 0)).gripper("r").beams() == (True, False)
    assert start(ROBOT.format("") + PUCK.format(0.5, 0)).gripper("r").beams() == (False, False)
    heavy = PUCK.format(BETWEEN, 0).replace("gripper_return 1", "")
    assert start(ROBOT.format("") + heavy).gripper("r").beams() == (False, False)


def test_a_thing_is_taken_carried_and_let_go(start):
    sim = start(ROBOT.format("") + PUCK.format(BETWEEN, 0.01))
    gripper = sim.gripper("r")
    gripper.do("close")
    sim.step(25)
    state = gripper.state()
    assert state.carried == "puck"
    assert state.paddles == pytest.approx(1.0 - 0.08 / (0.3 - 0.05))
    assert state.beams == (True, True)
    sim.commands[0, 0, 0] = 0.5
    sim.step(20)
    assert not sim.stalled[0, 0]  # what it carries is not in its way
    assert sim.poses[0, 0, 0] == pytest.approx(1.0)
    assert sim.thing_poses[0, 0, 0] == pytest.approx(1.3)
    sim.commands[:] = 0.0
    gripper.do("open")
    sim.step(25)
    assert gripper.state().carried is None
    x, y, _ = sim.thing_poses[0, 0]
    assert 1.268 < x - 0.04 < x + 0.04 < 1.45
    assert y == pytest.approx(0.0, abs=1e-9)
    sim.commands[0, 0, 0] = -0.5
    sim.step()
    assert not sim.stalled[0, 0]  # nor what it let go


def test_paddles_go_by_what_is_outside_of_them_or_above(start):
    aside = start(ROBOT.format("") + PUCK.format(BETWEEN, 0.5))
    aside.gripper("r").do("close")
    aside.step(25)
    assert aside.gripper("r").state().paddles == 1.0
    high = start(ROBOT.format('paddle_state [ "open" "up" ]') + PUCK.format(BETWEEN, 0))
    high.gripper("r").do("close")
    high.step(25)
    assert high.gripper("r").state().carried is None


def test_autosnatch_closes_when_a_beam_is_broken(start):
    sim = start(ROBOT.format("autosnatch 1") + PUCK.format(0.7, 0))
    sim.step(3)
    assert sim.gripper("r").state().paddles == 0.0
    sim.commands[0, 0, 0] = 0.5
    sim.step(6)
    sim.commands[:] = 0.0
    sim.step(25)
    assert sim.gripper("r").state().carried == "puck"


def test_others_bump_into_things_and_see_them_until_they_are_carried(start):
    other = (
        'position ( name "o" size [.2 .2 .2] pose [.34 1 0 -90] '
        "ranger ( pose [0 0 -.2 0] sensor ( range [0 9] fov 2 samples 1 ) ) )\n"
    )
    sim = start(ROBOT.format("") + PUCK.format(BETWEEN, 0) + other)
    # Through the gap between the paddles' ends nothing is seen but the paddle itself.
    free = PUCK.format(0.34, -2)
    seen = start(other + free + "position ( pose [5 0 0 0] gripper ( ) )").scan_of("o")
    assert seen[0] == pytest.approx(2.96)
    gripper = sim.gripper("r")
    gripper.do("close")
    sim.step(25)
    assert sim.fleet.heights[0, 2] < -1e3


def test_worlds_grip_for_themselves_and_a_reset_puts_things_back(start):
    sim = start(ROBOT.format("") + PUCK.format(BETWEEN, 0), nworld=2)
    gripper = sim.gripper("r")
    gripper.do("close", np.array([1]))
    sim.step(25)
    assert [gripper.state(world).carried for world in range(2)] == [None, "puck"]
    sim.commands[1, 0, 2] = math.pi / 4
    sim.step(10)
    sim.reset()
    assert gripper.state(1).carried is None
    assert sim.thing_poses[1, 0] == pytest.approx([BETWEEN, 0, 0])
    assert gripper.beams(1) == (True, True)


def test_arrays_are_of_robots_only(start):
    sim = start(PUCK.format(2, 0) + ROBOT.format("") + PUCK.format(3, 0))
    assert sim.poses.shape == sim.commands.shape == sim.velocities.shape == (1, 1, 3)
    assert sim.stalled.shape == (1, 1)
    assert sim.odometry.shape == (1, 1, 3)
    assert sim.thing_poses.shape == (1, 2, 3)
    plain = start('position ( name "r" )' + PUCK.format(2, 0))
    assert plain.things == ()  # nobody grips: it stands still


def test_wrong_names_are_told(start):
    sim = start(ROBOT.format(""))
    with pytest.raises(SimulationError, match="1 grippers, no number 1"):
        sim.gripper("r", 1)
    with pytest.raises(SimulationError, match="no command 'shut'"):
        sim.gripper("r").do("shut")
