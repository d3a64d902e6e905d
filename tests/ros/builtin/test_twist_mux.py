"""The nodes of twist_mux: priorities, timeouts and locks of velocity commands."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from ros.graph import until

from gazelle_ros import load_message
from gazelle_ros.base.errors import RosError
from gazelle_ros.builtin.mux_inputs import MuxInput
from gazelle_ros.builtin.twist_mux import Priorities, TwistMux, arrow_of
from gazelle_ros.clock import SECOND
from gazelle_ros.msgs import geometry_msgs, std_msgs

TWIST, FLAG = geometry_msgs.msg.Twist, std_msgs.msg.Bool
TOPICS = [
    {"name": "navigation", "topic": "nav_vel", "timeout": 0.5, "priority": 10},
    {"name": "joystick", "topic": "joy_vel", "timeout": 0.5, "priority": 100},
]
LOCKS = [
    {"name": "pause", "topic": "pause_navigation", "timeout": 0.0, "priority": 100},
    {"name": "stop", "topic": "e_stop", "timeout": 0.0, "priority": 255},
]


def source(priority, timeout=0.5, **values):
    return MuxInput(f"of {priority}", "topic", timeout, priority, **values)


def twist(x):
    made = TWIST()
    made.linear.x = x
    return made


# Choice ----------------------------------------------------------------------------------


def test_the_highest_priority_that_is_fresh_is_chosen():
    low, high = source(10, stamp=SECOND), source(100, stamp=SECOND)
    choice = Priorities([low, high], [])
    assert choice.chosen(SECOND) is high
    assert choice.chosen(SECOND + SECOND // 2) is high  # as old as the timeout, not older
    low.stamp = 2 * SECOND
    assert choice.chosen(2 * SECOND) is low
    assert choice.chosen(3 * SECOND) is None


def test_a_source_without_timeout_never_expires_even_unheard():
    """As the original: it holds back what is below it from the beginning."""
    silent, low = source(20, timeout=0.0), source(10, stamp=SECOND)
    assert Priorities([low, silent], []).chosen(SECOND) is silent


def test_priority_zero_never_passes_and_the_first_of_equals_does():
    assert Priorities([source(0, timeout=0.0)], []).chosen(SECOND) is None
    first, second = source(5, timeout=0.0), source(5, timeout=0.0)
    assert Priorities([first, second], []).chosen(SECOND) is first


@pytest.mark.parametrize(
    ("lock", "locked"),
    [
        ({"timeout": 0.0}, False),
        ({"timeout": 0.0, "locked": True}, True),
        ({"timeout": 0.5}, True),  # silent from the beginning
        ({"timeout": 0.5, "stamp": 10 * SECOND}, False),
        ({"timeout": 0.5, "stamp": 9 * SECOND}, True),
    ],
)
def test_a_lock_masks_what_is_below_it_by_its_message_or_its_silence(lock, locked):
    now = 10 * SECOND
    below, equal = source(99, stamp=now), source(100, stamp=now)
    choice = Priorities([below], [source(100, **lock)])
    assert choice.of_locks(now) == (100 if locked else 0)
    assert choice.chosen(now) is (None if locked else below)
    assert Priorities([equal], choice.locks).chosen(now) is equal


SOURCES = st.lists(
    st.builds(
        source,
        st.integers(0, 255),
        timeout=st.sampled_from([0.0, 0.5, 1.0]),
        stamp=st.integers(0, 3 * SECOND),
        locked=st.booleans(),
    ),
    max_size=5,
)


@given(SOURCES, SOURCES, st.integers(3 * SECOND, 5 * SECOND))
def test_nothing_that_is_free_is_above_what_is_chosen(velocities, locks, now):
    choice = Priorities(velocities, locks)
    chosen = choice.chosen(now)
    holding = [lock for lock in locks if lock.locked or (lock.timeout and lock.expired(now))]
    free = [
        each
        for each in velocities
        if each.priority > 0
        and (each.timeout == 0 or now - each.stamp <= each.timeout * SECOND)
        and all(each.priority >= lock.priority for lock in holding)
    ]
    assert (chosen is None) == (not free)
    assert all(each.priority <= chosen.priority for each in free)


# The node --------------------------------------------------------------------------------


@pytest.fixture
def mux(make_node):
    """Return a function that makes the node; parameters are changed by keywords."""

    def make(**parameters):
        node = make_node("twist_mux")
        for name, value in ({"topics": TOPICS, "locks": LOCKS} | parameters).items():
            node.set_param(f"~{name}", value)
        return TwistMux(node)

    return make


def test_commands_pass_by_priority_and_locks_stop_them(mux, make_node, listen):
    lasting = [each | {"timeout": 600.0} for each in TOPICS]
    navigation, joystick = (made := mux(topics=lasting)).priorities.velocities
    stop = made.priorities.locks[1]
    got = listen("/cmd_vel_out", TWIST)
    node = make_node("sender")
    senders = {
        each.topic: node.advertise(f"/{each.topic}", TWIST) for each in (navigation, joystick)
    }
    e_stop = node.advertise("/e_stop", FLAG)
    until(lambda: all(each.num_connections for each in (*senders.values(), e_stop)))

    def send(source, speed):
        """Send a command, and wait until the node has it."""
        before = source.stamp
        senders[source.topic].publish(twist(speed))
        until(lambda: source.stamp > before)

    def lock(locked):
        e_stop.publish(FLAG(data=locked))
        until(lambda: stop.locked == locked)

    until(lambda: made._commands.num_connections)
    send(navigation, 1.0)
    send(joystick, 2.0)
    send(navigation, 3.0)  # the joystick is above it
    lock(True)
    send(joystick, 4.0)
    lock(False)
    send(joystick, 5.0)
    until(lambda: len(got) >= 3)
    assert [each.linear.x for each in got] == [1.0, 2.0, 5.0]


def test_a_started_node_reports_as_the_original_does(start, listen, make_node):
    node = make_node("setter")
    node.set_param("/twist_mux/topics", TOPICS)
    node.set_param("/twist_mux/locks", LOCKS[:1])
    start("twist_mux", "twist_mux")
    got = listen("/diagnostics", load_message("diagnostic_msgs/DiagnosticArray"))
    until(lambda: got)
    (status,) = got[0].status
    assert (status.name, status.level, status.message) == ("twist_mux: Twist mux status", 0, "ok")
    assert {each.key: each.value for each in status.values} == {
        "velocity navigation": " masked (listening to nav_vel @ 0.500000s with priority #10)",
        "velocity joystick": " masked (listening to joy_vel @ 0.500000s with priority #100)",
        "lock pause": " free (listening to pause_navigation @ 0.000000s with priority #100)",
        "current priority": "0",
    }


@pytest.mark.parametrize(
    ("topics", "words"),
    [
        ("nav_vel", "must be a list"),
        ([7], r"topics\[0\] has name"),
        ([{"name": "a", "topic": "b", "timeout": 1.0}], r"topics\[0\] has no 'priority'"),
        ([TOPICS[0], TOPICS[1] | {"timeout": "soon"}], r"the timeout of /twist_mux/topics\[1\]"),
        ([TOPICS[0] | {"timeout": float("nan")}], "must be a number"),
        ([TOPICS[0] | {"priority": True}], "the priority of"),
        ([TOPICS[0] | {"topic": ""}], "the topic of"),
    ],
)
def test_a_wrong_parameter_is_named(mux, topics, words):
    with pytest.raises(RosError, match=words):
        mux(topics=topics)


def test_doubtful_parameters_are_warned_of(mux, caplog):
    made = mux(topics=[TOPICS[0] | {"priority": 300, "time_out": 1.0}], locks=[])
    assert made.priorities.velocities[0].priority == 255
    assert "unknown 'time_out'; did you mean 'timeout'" in caplog.text
    assert "priority 300 is taken for 255" in caplog.text
    mux(topics=[])
    assert "no command is forwarded" in caplog.text


def test_a_twist_is_drawn_as_an_arrow(start, make_node, listen):
    start("twist_mux", "twist_marker")
    got = listen("/marker", load_message("visualization_msgs/Marker"))
    sender = make_node("sender").advertise("/twist", TWIST)
    until(lambda: sender.num_connections)
    sender.publish(twist(0.5))
    until(lambda: got)
    assert (got[0].type, got[0].points[1].x, got[0].header.frame_id) == (0, 0.5, "base_footprint")
    turning = TWIST()
    turning.linear.y, turning.angular.z = 0.1, -0.3
    assert arrow_of(turning).points[1].y == -0.3
