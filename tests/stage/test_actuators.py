"""Actuators of Stage's robots, and what they move."""

import math

import numpy as np
import pytest

from gazelle import SimulationError

RANGER = "ranger ( pose [0 0 -1 0] sensor ( range [0 8] samples 1 ) )"
ROBOT = (
    'position ( name "r" size [.2 .2 .2] {} actuator ( size [.1 .1 1] pose [{}] {} '
    + RANGER
    + " ) )\n"
)
WALL = "model ( size [1 4 2] pose [3 0 0 0] )\n"
SLIDE = 'type "linear" axis [1 0 0] max_position 2 max_speed 0.5'
TURN = 'type "rotational" min_position -2 max_position 2 max_speed 1'


def robot(actuator, place="0 0 0 0", more=""):
    return ROBOT.format(more, place, actuator)


@pytest.mark.parametrize(
    ("actuator", "distance"),
    [
        ('type "linear" axis [2 0 0] start_position 0.5', 2.5 - 0.5),
        ('type "linear" axis [0 0 1] start_position 3', 8.0),
        ('type "rotational" start_position 3.14159265', 8.0),
        ('type "linear" axis [0 0 0] start_position 1', 2.5),
    ],
)
def test_it_begins_where_it_is_told_to(start, actuator, distance):
    sim = start(robot(actuator) + WALL)
    assert sim.scan_of("r")[0] == pytest.approx(distance)
    sim.step(5)
    assert sim.scan_of("r")[0] == pytest.approx(distance)


def test_at_a_speed_it_goes_to_the_end_of_its_range(start):
    sim = start(robot(SLIDE) + WALL)
    arm = sim.actuator("r")
    arm.set_speed(0.3)
    sim.step(10)
    assert arm.position[0] == pytest.approx(0.3)
    assert sim.scan_of("r")[0] == pytest.approx(2.2)
    arm.set_speed(9.0)  # no faster than it can
    sim.step(10)
    assert arm.position[0] == pytest.approx(0.8)
    sim.step(100)
    assert arm.position[0] == pytest.approx(2.0)


def test_to_a_position_it_slows_down_and_stays_within_its_range(start):
    sim = start(robot(TURN))
    arm = sim.actuator("r")
    arm.go_to(1.0)
    sim.step()
    assert arm.position[0] == pytest.approx(0.1)
    sim.step(200)
    assert arm.position[0] == pytest.approx(1.0, abs=1e-6)
    arm.go_to(-9.0)
    sim.step(400)
    assert arm.position[0] == pytest.approx(-2.0, abs=1e-6)


def test_what_is_on_it_moves_with_the_robot_in_each_world(start):
    sim = start(robot(TURN, "0.2 0.1 0 90") + WALL, nworld=2)
    sim.actuator("r").set_speed(-1.0, np.array([1]))
    sim.commands[0, 0] = (0.5, 0.0, 0.3)
    for _ in range(8):
        sim.step()
    for world in range(2):
        x, y, yaw = sim.poses[world, 0]
        body = sim.fleet.pose[world, 1]
        cos, sin = math.cos(yaw), math.sin(yaw)
        assert body[0] == pytest.approx(x + 0.2 * cos - 0.1 * sin)
        assert body[1] == pytest.approx(y + 0.2 * sin + 0.1 * cos)
        turned = sim.actuator("r").position[world]
        assert body[2] == pytest.approx(yaw + math.pi / 2 + turned)
    assert sim.actuator("r").position == pytest.approx([0.0, -0.8])
    sim.set_pose("r", (-3.0, 1.0, 0.0))
    assert sim.fleet.pose[0, 1, :2] == pytest.approx([-2.8, 1.1])
    sim.reset()
    assert sim.actuator("r").position == pytest.approx([0.0, 0.0])
    assert sim.fleet.pose[0, 1] == pytest.approx([0.2, 0.1, math.pi / 2])


def test_others_see_it_and_bump_into_it_but_not_its_robot(start):
    other = (
        'position ( name "o" size [.2 .2 .2] pose [2 0 0.5 180] '
        "ranger ( pose [0 0 -.2 0] sensor ( range [0 8] samples 1 ) ) )\n"
    )
    sim = start(robot(SLIDE) + other)
    assert sim.scan_of("o")[0] == pytest.approx(1.95)
    sim.actuator("r").set_speed(0.5)
    sim.step(20)
    assert sim.scan_of("o")[0] == pytest.approx(0.95)
    sim.actuator("r").set_speed(0.0)
    sim.commands[0, 1, 0] = 1.0
    sim.step(20)
    assert sim.stalled[0, 1]
    assert 1.15 - 1e-9 <= sim.poses[0, 1, 0] < 1.26
    sim.commands[0, 0, 0] = -0.5
    sim.step()
    assert not sim.stalled[0, 0]


def test_cameras_and_finders_move_with_it(start):
    lens = "resolution [40 30] range [0.2 8] fov [60 45]"
    text = (
        'position ( name "r" size [.2 .2 .2] actuator ( size [.1 .1 .3] ' + TURN + " "
        f"camera ( {lens} ) fiducial ( fov 60 ) bumper ( noblocks 1 ) ) )\n"
        'model ( name "m" size [.5 .5 2] pose [0 2 0 0] color "red" fiducial_return 3 )\n'
        'position ( name "s" size [.2 .2 2] pose [3 0 0 180] fiducial ( ) )\n'
    )
    sim = start(text)
    assert sim.fiducials("r") == []
    assert np.isinf(sim.picture("r").depth[15, 39])
    sim.actuator("r").go_to(math.pi / 2)
    sim.step(200)
    (seen,) = sim.fiducials("r")
    assert (seen.name, seen.bearing) == ("m", pytest.approx(0.0, abs=1e-3))
    picture = sim.picture("r")
    assert tuple(picture.color[15, 20, :3]) == (255, 0, 0)
    assert picture.depth[15, 20] == pytest.approx(1.75, abs=1e-3)


def test_wrong_numbers_are_told(start):
    sim = start(robot(SLIDE))
    with pytest.raises(SimulationError, match="1 actuators, no number 1"):
        sim.actuator("r", 1)
    with pytest.raises(SimulationError, match="'speed' must be a finite number"):
        sim.actuator("r").set_speed(math.nan)
