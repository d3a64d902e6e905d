"""The nodelet cmd_vel_mux: control of a robot's velocity by priorities and silence."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from ros.graph import until

from gazelle_ros.base.errors import Error
from gazelle_ros.builtin.cmd_vel_mux import CmdVelMux, Control
from gazelle_ros.builtin.mux_inputs import MuxInput
from gazelle_ros.clock import SECOND, SimulatedClock
from gazelle_ros.msgs import dynamic_reconfigure, geometry_msgs, std_msgs

TWIST, TEXT = geometry_msgs.msg.Twist, std_msgs.msg.String
SOURCES = """
subscribers:
  - {name: low, topic: input/low, timeout: 0.5, priority: 0, short_desc: the lowest}
  - {name: high, topic: input/high, timeout: 0.1, priority: 1000}
publisher: output/cmd_vel
"""


@given(
    st.lists(st.tuples(st.integers(0, 3), st.integers(1, 2 * SECOND)), max_size=30),
    st.lists(st.tuples(st.integers(0, 3), st.integers(1, SECOND)), min_size=4, max_size=4),
)
def test_control_goes_to_the_first_comer_or_to_a_higher_priority(commands, sources):
    """The holder, by the definition: replayed from the commands so far."""
    inputs = [
        MuxInput(f"{n}", "", ns / SECOND, priority) for n, (priority, ns) in enumerate(sources)
    ]
    control, holder, last, now = Control(), None, 0, 0
    for number, gap in commands:
        now += gap
        silent = holder is not None and now - last >= inputs[holder].timeout * SECOND
        free = holder is None or silent
        passes = free or number == holder or sources[number][0] > sources[holder][0]
        assert control.expire(now) == silent
        if passes:
            holder, last = number, now
        assert control.request(inputs[number], now) == passes
        assert control.holder is inputs[holder]


@pytest.fixture
def mux(make_node):
    """Return a function that makes the node, whose clock a test sets, from YAML text."""

    def make(text, **parameters):
        clock = SimulatedClock()
        node = make_node("mux", clock=clock)
        for name, value in ({"yaml_cfg_data": text} | parameters).items():
            node.set_param(f"~{name}", value)
        return CmdVelMux(node), clock

    return make


@pytest.fixture
def robot(mux, make_node, listen):
    """Return the multiplexer, its clock, a function that sends, and what it published."""
    made, clock = mux(SOURCES)
    clock.set(SECOND)
    node = make_node("sender")
    senders = {each.name: node.advertise(f"/mux/{each.topic}", TWIST) for each in made.inputs}
    got, active = listen("/mux/output/cmd_vel", TWIST), listen("/mux/active", TEXT)
    until(lambda: all(each.num_connections for each in senders.values()))
    until(lambda: made._output.num_connections and active)

    def send(name, speed):
        (source,) = (each for each in made.inputs if each.name == name)
        command = TWIST()
        command.linear.x = speed
        clock.set(clock.now() + 1)
        senders[name].publish(command)
        until(lambda: source.stamp == clock.now())

    return made, clock, send, got, active


def test_commands_pass_from_the_source_in_control(robot):
    _, clock, send, got, active = robot
    send("low", 1.0)
    send("high", 2.0)
    send("low", 3.0)  # the other is in control for another 0.1 s
    clock.set(clock.now() + SECOND // 10)
    send("low", 4.0)
    until(lambda: len(got) == 3 and len(active) == 5)
    assert [each.linear.x for each in got] == [1.0, 2.0, 4.0]
    assert [each.data for each in active] == ["idle", "low", "high", "idle", "low"]


def test_control_is_released_without_another_command(robot):
    made, clock, send, _, active = robot
    send("low", 1.0)
    clock.set(clock.now() + SECOND // 2)
    with made._lock:
        made._expire(clock.now())
    until(lambda: len(active) == 3)
    assert active[-1].data == "idle"


def test_sources_are_replaced_by_reconfiguration(robot, make_node):
    made, *_ = robot
    node = make_node("tuner")
    kind = dynamic_reconfigure.srv.Reconfigure
    request = kind._request_class()
    text = "subscribers: [{name: other, topic: /else, timeout: 1, priority: 3}]"
    request.config.strs = [dynamic_reconfigure.msg.StrParameter("yaml_cfg_data", text)]
    node.client("/mux/set_parameters", kind).call(request)
    assert [(each.name, each.topic) for each in made.inputs] == [("other", "/else")]
    assert made._output.name == "/mux/output"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("subscribers: []", "has no list 'subscribers'"),
        ("subscribers: [{name: a, topic: b, timeout: 1}]", "has no 'priority'"),
        ("[1, 2", "expected"),
        (SOURCES + "\npublisher: 7", "must be a topic, not 7"),
        ("", "no sources are configured"),
    ],
)
def test_a_wrong_description_is_named(mux, text, words):
    with pytest.raises(Error, match=words):
        mux(text)


def test_a_file_is_read_and_a_missing_one_named(mux, tmp_path):
    file = tmp_path / "mux.yaml"
    file.write_text(SOURCES)
    made, _ = mux("", yaml_cfg_file=str(file))
    assert [each.priority for each in made.inputs] == [0, 1000]
    with pytest.raises(Error, match=r"none\.yaml' cannot be read"):
        mux("", yaml_cfg_file=str(tmp_path / "none.yaml"))


def test_an_unknown_parameter_is_warned_of(mux, caplog):
    mux(SOURCES, yaml_cfg_fiel="a")
    assert (
        "/mux/yaml_cfg_fiel is an unknown parameter; did you mean 'yaml_cfg_file'?" in caplog.text
    )
