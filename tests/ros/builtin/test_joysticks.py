"""Joysticks: the device, joy_node, and the nodes that drive by it."""

from __future__ import annotations

import os
import struct

import pytest
from hypothesis import given
from hypothesis import strategies as st
from ros.graph import Background, until

from gazelle_ros import load_service
from gazelle_ros.actions import SimpleActionClient, SimpleActionServer
from gazelle_ros.base.errors import Error
from gazelle_ros.builtin.joysticks import device, joy_node
from gazelle_ros.builtin.joysticks.device import JoystickEvent, LinuxJoystick
from gazelle_ros.builtin.joysticks.joy_node import JoyNode
from gazelle_ros.builtin.joysticks.joy_teleop import JoyTeleop
from gazelle_ros.builtin.joysticks.relay import JoystickRelay, TurboControl, TurboSettings
from gazelle_ros.builtin.joysticks.state import JoystickState
from gazelle_ros.builtin.joysticks.teleop_twist import TeleopTwistJoy
from gazelle_ros.msgs import (
    actionlib_tutorials,
    diagnostic_msgs,
    geometry_msgs,
    sensor_msgs,
    std_msgs,
    twist_mux_msgs,
)

JOY, TWIST = sensor_msgs.msg.Joy, geometry_msgs.msg.Twist
BUTTON, AXIS, INITIAL = 0x01, 0x02, 0x80


def joy(axes=(), buttons=()):
    return JOY(axes=list(axes), buttons=list(buttons))


# The device ------------------------------------------------------------------------------


@pytest.fixture
def stick(tmp_path):
    """Return a device, and a function that sends events of it."""
    path = tmp_path / "js0"
    os.mkfifo(path)
    writer = os.open(path, os.O_RDWR)

    def send(*events):
        # At once, so that none is read before the others are there.
        packed = [struct.pack("IhBB", 0, value, kind, number) for kind, number, value in events]
        os.write(writer, b"".join(packed))

    yield str(path), send
    os.close(writer)


def test_events_are_read_as_the_kernel_writes_them(stick):
    path, send = stick
    with LinuxJoystick(path) as joystick:
        assert (joystick.name, joystick.wait(0.0)) == ("Unknown", [])
        send((BUTTON | INITIAL, 3, 1), (AXIS, 1, -32767), (0x40, 0, 0))
        assert joystick.wait(60.0) == [
            JoystickEvent(3, 1, is_axis=False, is_initial=True),
            JoystickEvent(1, -32767, is_axis=True, is_initial=False),
        ]


@given(st.floats(0.0, 0.9), st.integers(-32767, 32767))
def test_an_axis_is_linear_beyond_its_dead_zone(deadzone, value):
    state = JoystickState(deadzone)
    state.take(JoystickEvent(2, value, is_axis=True, is_initial=False))
    part = abs(value) / 32767.0
    expected = 0.0 if part <= deadzone else (part - deadzone) / (1.0 - deadzone)
    assert state.axes == pytest.approx([0.0, 0.0, expected if value < 0 else -expected], abs=1e-9)


def test_first_values_of_axes_are_taken_only_if_wanted():
    first = JoystickEvent(0, 32767, is_axis=True, is_initial=True)
    for wanted, expected in ((False, [0.0]), (True, [-1.0])):
        state = JoystickState(default_trig_val=wanted)
        assert not state.take(first)
        assert state.axes == expected


def test_sticky_buttons_are_toggled_by_presses():
    state = JoystickState(sticky_buttons=True)
    found = []
    for value in (1, 0, 1, 0):
        assert state.take(JoystickEvent(1, value, is_axis=False, is_initial=False))
        found.append(list(state.buttons))
    assert found == [[0, 1], [0, 1], [0, 0], [0, 0]]


# joy_node --------------------------------------------------------------------------------


@pytest.fixture
def run():
    running = []

    def begin(work):
        running.append(Background(work.run))
        return work

    yield begin
    for each in running:
        each.end()


@pytest.fixture
def driver(make_node, run):
    """Return a function that runs joy_node."""

    def make(**parameters):
        node = make_node("joy_node")
        for name, value in parameters.items():
            node.set_param(f"~{name}", value)
        return run(JoyNode(node))

    return make


def test_buttons_are_sent_at_once_and_axes_with_others(driver, stick, listen):
    path, send = stick
    made = driver(dev=path, deadzone=0.0, coalesce_interval=0.2)
    got = listen("/joy", JOY)
    until(lambda: made._joy.num_connections)
    send((AXIS | INITIAL, 1, 0), (BUTTON | INITIAL, 2, 0), (BUTTON, 2, 1))
    until(lambda: got)
    assert (list(got[0].axes), list(got[0].buttons), got[0].header.frame_id) == (
        [0.0, 0.0],
        [0, 0, 1],
        path,
    )
    send((AXIS, 0, 16384), (AXIS, 1, -32767))
    until(lambda: len(got) > 1)
    assert list(got[1].axes) == pytest.approx([-0.5, 1.0], abs=1e-4)
    assert list(got[1].buttons) == [0, 0, 1]


def test_the_state_is_sent_again_at_the_rate(driver, stick, listen):
    path, send = stick
    driver(dev=path, autorepeat_rate=50.0)
    got = listen("/joy", JOY)
    send((BUTTON, 0, 1))
    until(lambda: len(got) > 3)
    assert list(got[3].buttons) == [1]


def test_a_joystick_that_is_not_there_is_named_once_and_waited_for(
    driver, tmp_path, listen, caplog, monkeypatch
):
    monkeypatch.setattr(joy_node, "_RETRY_S", 0.01)
    monkeypatch.setattr(device, "FOLDER", tmp_path)
    monkeypatch.setattr(joy_node, "FOLDER", tmp_path)
    path = tmp_path / "js0"
    reports = listen("/diagnostics", diagnostic_msgs.msg.DiagnosticArray)
    driver(dev=str(path))
    until(lambda: any(each.status[0].level == 2 for each in reports))
    assert reports[0].status[0].name == "joy_node: Joystick Driver Status"
    until(lambda: "no joystick is plugged in" in caplog.text)
    os.mkfifo(path)
    writer = os.open(path, os.O_RDWR)
    try:
        until(lambda: any(each.status[0].message == "OK" for each in reports))
        assert caplog.text.count("retrying every second") == 1  # once more when it is unplugged
    finally:
        os.close(writer)


def test_a_joystick_is_found_by_its_name(make_node, monkeypatch, caplog):
    monkeypatch.setattr(joy_node, "joysticks", lambda: {"/dev/input/js3": "Pad"})
    node = make_node("joy_node")
    node.set_param("~dev_name", "Pad")
    assert JoyNode(node)._device == "/dev/input/js3"
    node.set_param("~dev_name", "Bad")
    assert JoyNode(node)._device == "/dev/input/js0"
    assert "there is no joystick 'Bad' but 'Pad'" in caplog.text


@pytest.mark.parametrize(
    ("given", "taken"), [(0.95, 0.9), (-0.1, 0.0), (16383.5, 0.5), (1.0, 1 / 32767)]
)
def test_a_dead_zone_out_of_range_is_corrected(make_node, caplog, given, taken):
    node = make_node("joy_node")
    node.set_param("~deadzone", given)
    assert JoyNode(node)._deadzone == pytest.approx(taken)
    assert f"a deadzone of {given:g} is taken for" in caplog.text


# teleop_twist_joy ------------------------------------------------------------------------


@pytest.fixture
def teleop(make_node):
    """Return a function that makes teleop_node from its parameters."""

    def make(**parameters):
        node = make_node("teleop")
        for name, value in parameters.items():
            node.set_param(f"~{name}", value)
        return TeleopTwistJoy(node)

    return make


def speeds(twist):
    vectors = (twist.linear, twist.angular)
    return [getattr(vector, axis) for vector in vectors for axis in "xyz"]


AXES = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6]


def test_defaults_of_teleop_twist_joy(teleop):
    made = teleop()
    assert speeds(made.command(joy(AXES, [1]))) == pytest.approx([0.1, 0, 0, 0, 0, 0.05])
    assert speeds(made.command(joy(AXES, [0]))) == [0.0] * 6  # one stop, and then nothing
    assert made.command(joy(AXES, [0])) is None
    assert speeds(made.command(joy([1.0], [1]))) == [0, 0, 0, 0, 0, 0.5]  # there is no axis 1


def test_turbo_has_scales_of_its_own(teleop):
    made = teleop(enable_turbo_button=1, scale_linear_turbo=3.0, scale_angular=2.0)
    assert speeds(made.command(joy(AXES, [0, 1]))) == pytest.approx([0.6, 0, 0, 0, 0, 0.2])
    assert speeds(made.command(joy(AXES, [1, 0]))) == pytest.approx([0.1, 0, 0, 0, 0, 0.2])


def test_six_axes_by_name(teleop):
    made = teleop(
        axis_linear={"x": 0, "y": 1, "z": 2}, scale_linear={"x": 1.0, "y": 2.0, "z": 3.0},
        axis_angular={"roll": 3, "pitch": 4, "yaw": 5}, scale_angular={"roll": 1, "yaw": -1.0},
    )  # fmt: skip
    assert speeds(made.command(joy(AXES, [1]))) == pytest.approx([0.1, 0.4, 0.9, 0.4, 0, -0.6])


def test_without_an_enable_button_nothing_drives(teleop):
    made = teleop(enable_button=-1)
    assert speeds(made.command(joy(AXES, [1, 1]))) == [0.0] * 6
    assert made.command(joy(AXES, [1, 1])) is None


def test_wrong_parameters_of_teleop_twist_joy(teleop, caplog):
    teleop(axis_linear={"x": 0, "why": 1}, enable_buton=3)
    assert "axis_linear/why is an unknown parameter" in caplog.text
    assert "did you mean 'enable_button'" in caplog.text
    with pytest.raises(Error, match="'axis_angular' must be of type int"):
        teleop(axis_angular="left")


def test_commands_go_from_joy_to_cmd_vel(teleop, make_node, listen):
    teleop()
    got = listen("/cmd_vel", TWIST)
    sender = make_node("sender").advertise("/joy", JOY)
    until(lambda: sender.num_connections)
    sender.publish(joy([0.0, 1.0], [1]))
    until(lambda: got)
    assert got[0].linear.x == 0.5


# joy_teleop ------------------------------------------------------------------------------

WALK = {
    "type": "topic", "message_type": "geometry_msgs/Twist", "topic_name": "cmd_vel",
    "deadman_buttons": [0],
    "axis_mappings": [{"axis": 1, "target": "linear.x", "scale": 0.5, "offset": -0.1},
                      {"button": 1, "target": "angular.z", "scale": 2.0}],
}  # fmt: skip
HELLO = {
    "type": "topic", "message_type": "std_msgs/String", "topic_name": "chatter",
    "deadman_buttons": [1], "message_value": [{"target": "data", "value": "Hello"}],
    "allow_multiple_commands": False,
}  # fmt: skip


@pytest.fixture
def commanded(make_node):
    """Return a function that makes joy_teleop, and sends it states of a joystick."""
    sender = make_node("stick").advertise("/joy", JOY)

    def make(commands):
        node = make_node("joy_teleop")
        node.set_param("/teleop", commands)
        made = JoyTeleop(node)
        until(lambda: sender.num_connections)
        return made, lambda axes, buttons: sender.publish(joy(axes, buttons))

    return make


def test_buttons_publish_messages(commanded, listen):
    made, send = commanded({"walk": WALK, "hello": HELLO})
    walks, hellos = listen("/cmd_vel", TWIST), listen("/chatter")
    until(lambda: all(each._publisher.num_connections for each in made.commands))
    send([0.0, 1.0], [1, 1])  # hello wants no other button
    send([0.0, -1.0], [0, 1])
    until(lambda: walks and hellos)
    assert (walks[0].linear.x, walks[0].angular.z) == pytest.approx((0.4, 2.0))
    send([], [1, 0])
    until(lambda: len(walks) == 2)
    assert walks[1].linear.x == 0.0
    assert [each.data for each in hellos] == ["Hello"]


def test_a_button_calls_a_service_once(commanded, make_node):
    kind = load_service("std_srvs/SetBool")
    asked = []
    node = make_node("server")
    node.serve("/lights", kind, lambda request: asked.append(request.data) or [True, ""])
    made, send = commanded(
        {"lights": {"type": "service", "service_name": "/lights", "service_request": {"data": True},
                    "buttons": [0]}}
    )  # fmt: skip
    for _ in range(2):
        send([], [1])
    until(lambda: asked and not made.commands[0]._thread.is_alive())
    send([], [0])
    send([], [1])
    until(lambda: len(asked) == 2)
    assert asked == [True, True]


def test_a_button_sends_a_goal(commanded, make_node):
    goals = []

    def execute(goal):
        goals.append(goal.order)
        server.set_succeeded()

    action = actionlib_tutorials.msg.FibonacciAction
    server = SimpleActionServer(make_node("server"), "/count", action, execute, auto_start=False)
    server.start()
    _, send = commanded(
        {"count": {"type": "action", "action_name": "/count", "action_goal": {"order": 7},
                   "buttons": [2]}}
    )  # fmt: skip
    send([], [0, 0, 1])
    until(lambda: goals)
    assert goals == [7]
    server.stop()


def test_what_is_not_there_is_named_when_its_button_is_pressed(commanded, caplog):
    _, send = commanded(
        {"a": {"type": "action", "action_name": "/none", "buttons": [0]},
         "b": {"type": "service", "service_name": "/none", "buttons": [0]}}
    )  # fmt: skip
    send([], [1])
    until(lambda: "'a' is not run: there is no action /none" in caplog.text)
    until(lambda: "'b' is not run" in caplog.text)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"type": "topik"}, "its type is 'topik'; did you mean 'topic'"),
        ({"message_type": "geometry_msgs/Twst"}, "did you mean"),
        ({"deadman_buttons": [1.5]}, "a list of numbers"),
        ({"axis_mappings": [{"axis": 0, "target": "linear.w"}]}, "no field 'linear.w'"),
        ({"axis_mappings": [{"axis": 0}]}, "has no 'target'"),
    ],
)
def test_a_wrong_command_is_left_out_and_named(commanded, caplog, change, words):
    made, _ = commanded({"walk": WALK | change, "hello": HELLO | {"buttns": 3}})
    assert [each.name for each in made.commands] == ["hello"]
    assert "the command 'walk' is left out" in caplog.text
    assert words in caplog.text
    assert "'hello' has an unknown 'buttns'" in caplog.text


def test_without_commands_it_does_not_start(make_node):
    with pytest.raises(Error, match="/teleop has no commands"):
        JoyTeleop(make_node("joy_teleop"))


# joystick_relay --------------------------------------------------------------------------

STEPS = TurboSettings(
    steps=4, linear_forward_min=0.5, linear_forward_max=1.0, linear_backward_min=0.25,
    linear_backward_max=0.5, angular_min=0.7, angular_max=1.2,
)  # fmt: skip


def twist(x=0.0, y=0.0, yaw=0.0):
    made = TWIST()
    made.linear.x, made.linear.y, made.angular.z = x, y, yaw
    return made


def test_speeds_are_in_equal_steps_from_least_to_greatest():
    control = TurboControl(STEPS)
    assert control.linear == 2
    control.change(-5, 0)
    found = []
    for _ in range(5):
        found += [control.scaled(twist(x)).linear.x for x in (1.0, -1.0)]
        control.change(1, 0)
    assert found == pytest.approx([0.5, -0.25, 2 / 3, -1 / 3, 5 / 6, -5 / 12, 1.0, -0.5, 1.0, -0.5])
    assert control.scaled(twist(yaw=1.0)).angular.z == pytest.approx(0.7 + 0.5 / 3)
    control.reset()
    assert control.linear == 2


def test_a_twist_that_is_no_part_of_one_stops():
    control = TurboControl(STEPS)
    up = twist(1.0)
    up.linear.z = 0.1
    for wrong in (twist(1.1), twist(yaw=-2.0), up):
        assert speeds(control.scaled(wrong)) == [0.0] * 6
    assert TurboSettings().speed("linear_backward", 1) == 1.0


def test_the_relay_passes_with_priority_and_stops_without(make_node, run, listen):
    node = make_node("joystick_relay")
    node.set_param("~priority", False)
    node.set_param("~turbo", {"steps": 1, "linear_forward_min": 2.0, "linear_forward_max": 2.0})
    relay = run(JoystickRelay(node))
    flags, got = listen("/joy_priority", std_msgs.msg.Bool), listen("/joy_vel_out", TWIST)
    client_node = make_node("stick")
    sender = client_node.advertise("/joy_vel_in", TWIST)
    until(lambda: flags and relay._commands.num_connections and sender.num_connections)
    action = twist_mux_msgs.msg.JoyPriorityAction
    client = SimpleActionClient(client_node, "/joy_priority_action", action)
    assert client.wait_for_server(60.0)
    client.send_goal_and_wait(twist_mux_msgs.msg.JoyPriorityGoal())
    until(lambda: len(flags) == 2 and got)
    sender.publish(twist(0.5))
    until(lambda: len(got) == 2)
    assert [each.data for each in flags] == [False, True]
    assert [each.linear.x for each in got] == [0.0, 1.0]


def test_a_speed_of_the_relay_is_above_zero(make_node):
    node = make_node("joystick_relay")
    node.set_param("~turbo/angular_max", 0.0)
    with pytest.raises(Error, match="/joystick_relay/turbo/angular_max must be above 0"):
        JoystickRelay(node)
