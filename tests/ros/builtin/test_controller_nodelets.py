"""Nodelets that command a base: a follower, a safety controller, a controller of poses, a light of bumps."""

from __future__ import annotations

import logging
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from ros.graph import until

from gazelle_ros.base.errors import Error
from gazelle_ros.builtin.follower import Follower, FollowerSettings
from gazelle_ros.builtin.kobuki.bump_blink import BumpBlink
from gazelle_ros.builtin.pose_controller import PoseController, PoseControllerSettings
from gazelle_ros.builtin.ranger_safety import RangerSafety
from gazelle_ros.clock import SECOND, SimulatedClock
from gazelle_ros.compat.cv_bridge import CvBridge
from gazelle_ros.msgs import (
    geometry_msgs,
    kobuki_msgs,
    sensor_msgs,
    std_msgs,
    turtlebot_msgs,
    visualization_msgs,
)

TWIST, RANGE, LED = geometry_msgs.msg.Twist, sensor_msgs.msg.Range, kobuki_msgs.msg.Led
BUMPER = kobuki_msgs.msg.BumperEvent
ROWS, COLUMNS = 240, 320


@pytest.fixture
def here(make_node):
    """Return a function that makes a node's work, its clock, and a node beside it."""

    def make(kind, **parameters):
        clock = SimulatedClock()
        clock.set(SECOND)
        node = make_node("here", clock=clock)
        for name, value in parameters.items():
            node.set_param(f"~{name}", value)
        return kind(node), clock, make_node("beside")

    return make


def sender(node, topic, kind):
    """Return a function that publishes to a topic that has a subscriber."""
    publisher = node.advertise(topic, kind)
    until(lambda: publisher.num_connections)
    return publisher.publish


# The follower ----------------------------------------------------------------------------


def wall(depth, left=0, right=COLUMNS):
    """Return depths of something between two columns, and nothing elsewhere."""
    found = np.full((ROWS, COLUMNS), np.nan)
    found[:, left:right] = depth
    return found


def test_the_robot_keeps_its_distance_and_turns_to_what_it_follows():
    settings = FollowerSettings(min_y=-1.0, max_y=1.0, min_x=-1.0, max_x=1.0, max_z=3.0)
    x, _, z = settings.target(wall(0.5))
    assert (round(x, 3), z) == (-0.001, 0.5)  # columns are counted from the left of the middle
    speed, turn = settings.command((0.0, 0.2, 0.5))
    assert (speed, turn) == (pytest.approx(-0.5), 0.0)
    target = settings.target(wall(1.0, left=200))
    speed, turn = settings.command(target)
    assert speed == pytest.approx(5.0 * 0.4)
    assert turn == -target[0] < -0.1
    angles = (np.arange(200, COLUMNS) - COLUMNS / 2) * (60.0 / 57.0 / COLUMNS)
    assert target[0] == pytest.approx(np.sin(angles).mean())


def test_few_points_and_points_outside_the_box_stop_it():
    settings = FollowerSettings()
    assert settings.target(wall(0.81)) is None
    low = np.full((ROWS, COLUMNS), np.nan)
    low[ROWS // 2 :] = 0.5  # below the camera's axis, as min_y is 0.1
    assert settings.target(low) is None
    whole = FollowerSettings(min_y=-1.0, max_y=1.0, min_x=-1.0, max_x=1.0)
    few = np.full((ROWS, COLUMNS), np.nan)
    few.ravel()[:4000] = 0.5
    assert whole.target(few) is None
    few.ravel()[:4001] = 0.5
    assert whole.target(few) is not None
    assert whole.command(None) == (0.0, 0.0)


def test_the_follower_commands_shows_and_stops_by_a_service(here, listen):
    box = {"min_y": -1.0, "max_y": 1.0, "min_x": -0.5, "max_x": 0.5, "x_scale": 7.0}
    made, _, beside = here(Follower, **box)
    assert made._tuned.settings.x_scale == 3.0  # within the limits of the original's server
    commands, targets = listen("/here/cmd_vel", TWIST), []
    beside.subscribe("/here/marker", visualization_msgs.msg.Marker, targets.append)
    boxes = listen("/here/bbox", visualization_msgs.msg.Marker)
    image = CvBridge().cv2_to_imgmsg(wall(0.7).astype(np.float32), "32FC1")
    send = sender(beside, "/depth/image_rect", sensor_msgs.msg.Image)

    def shown():
        send(image)
        return commands and targets and boxes

    until(shown)
    assert commands[0].linear.x == pytest.approx(0.5, abs=1e-6)
    assert targets[0].pose.position.z == pytest.approx(0.7)
    assert (boxes[0].scale.x, boxes[0].scale.y, boxes[0].scale.z) == (1.0, 2.0, 0.8)
    kind = turtlebot_msgs.srv.SetFollowState
    request = kind._request_class
    service = beside.client("/here/change_state", kind)
    assert service.call(request(request.STOPPED)).result == kind._response_class.OK
    until(lambda: commands[-1].linear.x == 0.0)
    count, seen = len(commands), len(targets)

    def still_shown():
        send(image)
        return len(targets) > seen + 2

    until(still_shown)
    assert len(commands) == count
    service.call(request(request.FOLLOW))
    assert made.following


# yocs_safety_controller ------------------------------------------------------------------


def test_a_ranger_stops_the_robot_once_each_time(here, listen):
    made, _, beside = here(RangerSafety)
    commands = listen("/here/cmd_vel", TWIST)
    send = sender(beside, "/here/rangers", RANGE)
    assert made.step() is None
    send(RANGE(range=0.1))
    send(RANGE(range=-math.inf))
    until(lambda: made._seen)
    until(lambda: made._output.num_connections)
    made._publish()
    until(lambda: commands)
    assert (commands[0].linear.x, commands[0].angular.z) == (0.0, 0.0)
    assert made.step() is None
    sender(beside, "/here/disable", std_msgs.msg.Empty)(std_msgs.msg.Empty())
    until(lambda: not made.switch.on)
    send(RANGE(range=-math.inf))
    made._take(RANGE(range=-math.inf))
    assert made.step() is None


def test_it_drives_back_after_a_stop_if_it_is_told_to(here):
    made, clock, _ = here(
        RangerSafety, reverse=True, reversing_distance=0.1, reversing_velocity=0.05
    )
    made._take(RANGE(range=-math.inf))
    assert made.step() == (0.0, 0.0)
    found = []
    for _ in range(30):
        clock.set(clock.now() + SECOND // 10)
        found.append(made.step())
    assert found[:20] == [(-0.05, 0.0)] * 20  # 2 s
    assert found[20:] == [None] * 10


def test_its_speed_back_is_above_zero(here):
    with pytest.raises(Error, match="reversing_velocity must be above 0"):
        here(RangerSafety, reversing_velocity=0.0)


# yocs_diff_drive_pose_controller -----------------------------------------------------------


def drive(settings, x, y, yaw, seconds=60.0):
    """Return the pose in the frame of the goal after a time, from a start in it."""
    before, period = 0.0, 1.0 / settings.spin_rate
    for _ in range(round(seconds * settings.spin_rate)):
        distance = math.hypot(x, y)
        line = math.atan2(-y, -x)  # to the goal
        delta = math.remainder(yaw - line, 2.0 * math.pi)
        theta = math.remainder(0.0 - line, 2.0 * math.pi)
        if distance <= settings.dist_thres:
            speed, turn = 0.0, settings.turning(math.remainder(-yaw, 2.0 * math.pi))
            if abs(math.remainder(yaw, 2.0 * math.pi)) <= settings.orient_thres:
                break
        else:
            speed, turn = settings.command(distance, delta, theta, before)
        assert abs(speed) <= settings.v_max + 1e-9
        assert abs(turn) <= settings.w_max + 1e-9
        assert abs(speed - before) <= settings.v_max * period + 1e-9 or speed == 0.0
        before = speed
        x += speed * math.cos(yaw) * period
        y += speed * math.sin(yaw) * period
        yaw += turn * period
    return x, y, yaw


@pytest.mark.parametrize(
    "start", [(-2.0, 0.0, 0.0), (-2.0, 0.5, 0.0), (-1.5, -1.0, 1.0), (-2.0, 1.0, -1.5)]
)
def test_a_robot_reaches_a_pose(start):
    settings = PoseControllerSettings(
        v_max=0.15, w_min=0.05, w_max=0.6, k_2=10.0, beta=0.2, dist_thres=0.05, orient_thres=0.06
    )
    x, y, yaw = drive(settings, *start)
    assert math.hypot(x, y) < 0.07
    assert abs(math.remainder(yaw, 2.0 * math.pi)) < 0.1


@given(st.floats(0.02, 5.0), st.floats(-3.1, 3.1), st.floats(-3.1, 3.1), st.floats(0.0, 0.5))
def test_commands_are_within_their_limits(distance, delta, theta, before):
    settings = PoseControllerSettings()
    speed, turn = settings.command(distance, delta, theta, before)
    assert abs(speed - before) <= settings.v_max / settings.spin_rate + 1e-12
    assert settings.w_min <= abs(turn) <= settings.w_max


def test_straight_ahead_it_drives_at_the_greatest_speed():
    settings = PoseControllerSettings()
    speed, turn = settings.command(2.0, 0.0, 0.0, settings.v_max)
    assert (speed, abs(turn)) == (settings.v_max, settings.w_min)


def test_the_pose_controller_on_a_graph(here, listen, caplog):
    caplog.set_level(logging.WARNING)
    made, _, beside = here(PoseController, start_enabled=False, dist_thres=0.1, orient_thres=0.2)
    commands, reached = listen("/here/command_velocity", TWIST), []
    beside.subscribe("/here/pose_reached", std_msgs.msg.Bool, reached.append)
    until(lambda: made._output.num_connections and made._done.num_connections)
    made.step()
    enable = sender(beside, "/here/enable", std_msgs.msg.String)
    enable(std_msgs.msg.String(data="dock"))
    until(lambda: made.switch.on)
    made.step()
    assert "the goal is not known" in caplog.text
    made.tree.place("base_footprint", "dock", 0, (2.0, 0.3, 0.0), (0.0, 0.0, 0.0, 1.0), static=True)
    made.step()
    until(lambda: commands)
    assert (commands[0].linear.x, commands[0].angular.z > 0.0) == (pytest.approx(0.025), True)
    limit = sender(beside, "/here/control_max_vel", std_msgs.msg.Float32)
    limit(std_msgs.msg.Float32(data=0.2))
    until(lambda: made.settings.v_max == pytest.approx(0.2))
    made.tree.place(
        "base_footprint", "near", 0, (0.05, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0), static=True
    )
    enable(std_msgs.msg.String(data="near"))
    until(lambda: made._goal == "near")
    made.step()
    made.step()
    until(lambda: reached and len(commands) == 3)
    assert len(reached) == 1
    assert (commands[-1].linear.x, commands[-1].angular.z) == (0.0, 0.0)
    sender(beside, "/here/disable", std_msgs.msg.Empty)(std_msgs.msg.Empty())
    until(lambda: not made.switch.on)
    made.step()
    assert len(commands) == 3


def test_defaults_depend_on_others_as_in_the_original(make_node):
    node = make_node("here")
    node.set_param("~v_max", 0.4)
    node.set_param("~orient_thres", 0.1)
    node.set_param("~lambda", 3.0)
    found = PoseControllerSettings.read(node)
    assert found.w_max == pytest.approx(0.1 * math.pi)
    assert (found.orient_eps, found.lambda_) == (pytest.approx(0.02), 3.0)


# kobuki_controller_tutorial ----------------------------------------------------------------


def test_a_bumper_lights_the_first_light_once_it_is_enabled(here, listen):
    made, _, beside = here(BumpBlink)
    lights = listen("/here/commands/led1", LED)
    until(lambda: made._light.num_connections)
    send = sender(beside, "/here/events/bumper", BUMPER)
    made._take(BUMPER(state=BUMPER.PRESSED))
    sender(beside, "/here/enable", std_msgs.msg.Empty)(std_msgs.msg.Empty())
    until(lambda: made.switch.on)
    send(BUMPER(state=BUMPER.PRESSED))
    send(BUMPER(state=BUMPER.RELEASED))
    until(lambda: len(lights) == 2)
    assert [each.value for each in lights] == [LED.GREEN, LED.BLACK]
