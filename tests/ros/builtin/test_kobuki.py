"""Nodelets beside a Kobuki base: safety controller, random walker, cloud of bumps."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from ros.graph import until

from gazelle_ros.base.errors import Error
from gazelle_ros.builtin.kobuki.bumper_cloud import BumperCloud, BumperCloudSettings
from gazelle_ros.builtin.kobuki.random_walker import RandomWalker
from gazelle_ros.builtin.kobuki.safety_controller import KobukiSafety
from gazelle_ros.builtin.nodelets.manager import NodeletManager
from gazelle_ros.clock import SECOND, SimulatedClock
from gazelle_ros.compat.sensor_msgs.point_cloud2 import read_points_list
from gazelle_ros.msgs import geometry_msgs, kobuki_msgs, sensor_msgs, std_msgs

TWIST, EMPTY = geometry_msgs.msg.Twist, std_msgs.msg.Empty
BUMPER, CLIFF = kobuki_msgs.msg.BumperEvent, kobuki_msgs.msg.CliffEvent
WHEEL, LED = kobuki_msgs.msg.WheelDropEvent, kobuki_msgs.msg.Led
STATE = kobuki_msgs.msg.SensorState
LEFT, CENTER, RIGHT = BUMPER.LEFT, BUMPER.CENTER, BUMPER.RIGHT


class Chance:
    """Turns by a quarter of the most, to the right."""

    def random(self):
        """Return the part of the greatest turn."""
        return 0.25

    def choice(self, options):
        """Return the smallest option."""
        return min(options)


@pytest.fixture
def drive(make_node):
    """Return a function that makes a controller, its clock, and a node beside it."""

    def make(kind, *arguments, **parameters):
        clock = SimulatedClock()
        clock.set(SECOND)
        node = make_node("here", clock=clock)
        for name, value in parameters.items():
            node.set_param(f"~{name}", value)
        return kind(node, *arguments), clock

    return make


def commands_of(made, listen, topic):
    """Return a function that makes one step and returns its command: None if there is none."""
    got = listen(f"/here/{topic}", TWIST)
    until(lambda: made._output.num_connections)

    def step():
        before = len(got)
        made.step()
        made._output.publish(TWIST(linear=geometry_msgs.msg.Vector3(y=1.0)))  # ends the step
        until(lambda: got and got[-1].linear.y == 1.0 and len(got) > before)
        found = [(each.linear.x, each.angular.z) for each in got[before:-1]]
        return found[0] if found else None

    return step


def send(node, topic, message):
    """Publish one message to a subscriber that is there."""
    publisher = node.advertise(topic, type(message))
    until(lambda: publisher.num_connections)
    publisher.publish(message)


def test_the_robot_retreats_from_what_it_touches(drive, listen):
    made, _ = drive(KobukiSafety)
    step = commands_of(made, listen, "cmd_vel")
    assert step() is None
    for sensors in (made.bumpers, made.cliffs):
        for sensor, command in ((LEFT, (-0.1, -0.4)), (CENTER, (-0.1, 0.0)), (RIGHT, (-0.1, 0.4))):
            made.take(sensors, sensor, active=True)
            assert step() == step() == command
            made.take(sensors, sensor, active=False)
            assert step() is None
    made.take(made.bumpers, LEFT, active=True)
    made.take(made.cliffs, CENTER, active=True)
    assert step() == (-0.1, 0.0)  # the centre comes first
    made.take(made.wheels, WHEEL.RIGHT, active=True)
    assert step() == (0.0, 0.0)  # and dropped wheels before all


def test_a_retreat_goes_on_for_a_time_after_the_bump(drive, listen):
    made, clock = drive(KobukiSafety, time_to_extend_bump_cliff_events=1.0)
    step = commands_of(made, listen, "cmd_vel")
    made.take(made.bumpers, RIGHT, active=True)
    assert step() == (-0.1, 0.4)
    made.take(made.bumpers, RIGHT, active=False)
    clock.set(clock.now() + SECOND - 1)
    assert step() == (-0.1, 0.4)
    clock.set(clock.now() + 1)
    assert step() is None


def test_the_safety_controller_listens_to_its_topics(drive, make_node, listen):
    made, _ = drive(KobukiSafety)
    step, node = commands_of(made, listen, "cmd_vel"), make_node("base")
    send(node, "/here/events/cliff", CLIFF(sensor=CLIFF.LEFT, state=CLIFF.CLIFF))
    send(node, "/here/events/bumper", BUMPER(bumper=CENTER, state=BUMPER.PRESSED))
    send(node, "/here/events/wheel_drop", WHEEL(wheel=WHEEL.LEFT, state=WHEEL.DROPPED))
    until(lambda: (made.cliffs, made.bumpers, made.wheels) == ({LEFT}, {CENTER}, {WHEEL.LEFT}))
    send(node, "/here/disable", EMPTY())
    until(lambda: not made.enabled)
    assert step() is None
    send(node, "/here/enable", EMPTY())
    until(lambda: made.enabled)
    assert step() == (0.0, 0.0)
    send(node, "/here/events/wheel_drop", WHEEL(wheel=WHEEL.LEFT, state=WHEEL.RAISED))
    until(lambda: not made.wheels)
    send(node, "/here/reset", EMPTY())
    until(lambda: not (made.cliffs or made.bumpers))
    assert step() is None


def test_the_walker_turns_at_an_obstacle_and_goes_on(drive, listen):
    made, clock = drive(RandomWalker, Chance(), linear_velocity=0.3, angular_velocity=0.5)
    step = commands_of(made, listen, "commands/velocity")
    assert step() == (0.3, 0.0)
    made.take(made.bumpers, LEFT, active=True)
    seconds = 0.25 * math.pi / 0.5
    assert step() == (0.0, -0.5)
    made.take(made.bumpers, LEFT, active=True)  # is no new bump
    clock.set(clock.now() + round(seconds * SECOND) - 1)
    assert step() == (0.0, -0.5)
    clock.set(clock.now() + 1)
    assert step() is None
    assert step() == (0.3, 0.0)
    made.take(made.wheels, WHEEL.LEFT, active=True)
    assert step() == (0.0, 0.0)


def test_the_walker_shows_events_on_its_leds(drive, listen):
    made, _ = drive(RandomWalker)
    shown = [listen(f"/here/commands/led{number}", LED) for number in (1, 2)]
    until(lambda: all(each.num_connections for each in made._leds))
    events = [
        (made.bumpers, LEFT, True),
        (made.bumpers, RIGHT, True),
        (made.bumpers, LEFT, False),
        (made.bumpers, RIGHT, False),
        (made.cliffs, CENTER, True),
        (made.cliffs, CENTER, False),
        (made.wheels, WHEEL.LEFT, True),
        (made.wheels, WHEEL.LEFT, False),
    ]
    for sensors, sensor, active in events:
        made.take(sensors, sensor, active=active)
    colours = [LED.ORANGE, LED.BLACK, LED.RED, LED.BLACK]
    until(lambda: all(len(each) == len(colours) for each in shown))
    assert [[each.value for each in led] for led in shown] == [colours, colours]


def test_bumps_do_not_count_while_the_walker_is_disabled(drive):
    made, _ = drive(RandomWalker)
    made._switch.on = False
    made.take(made.bumpers, LEFT, active=True)
    made.take(made.cliffs, LEFT, active=True)
    assert (made.bumpers, made.cliffs) == (set(), {LEFT})


@pytest.mark.parametrize("name", ["update_rate", "angular_velocity"])
def test_a_rate_of_the_walker_is_above_zero(drive, name):
    with pytest.raises(Error, match=f"{name} must be above 0 .*, not 0.0"):
        drive(RandomWalker, **{name: 0})


@given(st.integers(0, 7), st.integers(0, 7), st.floats(0.1, 1.0), st.floats(0.0, 1.5))
def test_points_are_where_the_sensors_are_or_far_away(bumper, cliff, radius, angle):
    settings = BumperCloudSettings(radius, 0.1, angle)
    points = settings.points(STATE(bumper=bumper, cliff=cliff))
    directions = (math.pi / 2 - angle, 0.0, angle - math.pi / 2)
    for (x, y, z), direction, bit in zip(points, directions, (4, 2, 1), strict=True):
        assert z == 0.1
        if (bumper | cliff) & bit:
            assert (math.hypot(x, y), math.atan2(y, x)) == pytest.approx((radius, direction))
        else:
            assert math.hypot(x, y) > 30.0
            assert math.copysign(1.0, y) == math.copysign(1.0, direction)


def test_clouds_come_while_something_is_touched_and_once_after(drive, make_node, listen):
    made, _ = drive(BumperCloud, pointcloud_radius=0.24)
    got = listen("/here/pointcloud", sensor_msgs.msg.PointCloud2)
    sender = make_node("base").advertise("/here/core_sensors", STATE)
    until(lambda: sender.num_connections and made._output.num_connections)
    for second, bumper in enumerate((0, STATE.BUMPER_CENTRE, 0, 0, STATE.BUMPER_LEFT)):
        state = STATE(bumper=bumper)
        state.header.stamp.secs = second
        sender.publish(state)
    until(lambda: len(got) == 3)
    assert [each.header.stamp.secs for each in got] == [1, 2, 4]
    assert {each.header.frame_id for each in got} == {"/base_link"}
    assert all(each.is_dense and (each.width, each.height) == (3, 1) for each in got)
    ahead = [read_points_list(each)[1] for each in got]
    assert [each.x for each in ahead] == pytest.approx([0.24, 34.2020, 34.2020], abs=1e-4)
    assert [(each.y, each.z) for each in ahead] == [(0.0, pytest.approx(0.04))] * 3


def test_turtlebot_loads_them_as_nodelets(make_node):
    node = make_node("manager")
    manager = NodeletManager(node)
    mux = "/cmd_vel_mux/input/safety_controller"
    kinds = {
        "kobuki_safety_controller/SafetyControllerNodelet": {"/a/cmd_vel": mux},
        "kobuki_random_walker/RandomWalkerControllerNodelet": {},
        "kobuki_bumper2pc/Bumper2PcNodelet": {},
    }
    try:
        for name, (kind, remappings) in zip("abc", kinds.items(), strict=True):
            manager.load(f"/{name}", kind, remappings)
        published = {topic for topic, _ in node.master.published_topics()}
        assert {mux, "/b/commands/velocity", "/c/pointcloud"} <= published
    finally:
        for name in manager.loaded:
            manager.unload(name)
