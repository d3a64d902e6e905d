"""Simulated time: standing still, beginning, jumping."""

import importlib
import io
import threading
import time

import pytest
from ros.graph import until

from gazelle_ros.messages import load_message
from gazelle_ros.time import Time


@pytest.fixture
def simulated(rospy, make_node):
    """Return rospy by simulated time, and a function that sets it."""
    driver = make_node("driver")
    driver.set_param("/use_sim_time", True)
    clock = load_message("rosgraph_msgs/Clock")
    publisher = driver.advertise("/clock", clock, queue_size=100)
    rospy.init_node("probe", disable_signals=True)

    def tell(seconds):
        until(lambda: publisher.num_connections)
        publisher.publish(clock(Time.from_sec(seconds)))
        until(lambda: rospy.get_time() == pytest.approx(seconds))

    return rospy, tell


def asleep(rospy):
    """Return how many threads wait for a simulated time."""
    return len(rospy.core.process.clock._sleepers)


def start(call):
    outcome = []

    def run():
        try:
            outcome.append(call())
        except BaseException as error:  # noqa: BLE001  # the test looks at it
            outcome.append(error)

    thread = threading.Thread(target=run, daemon=True)
    thread.start()
    return thread, outcome


def test_before_the_first_tick_time_is_zero_and_sleeps_wait(simulated):
    rospy, tell = simulated
    assert rospy.Time.now().is_zero()
    sleeper, outcome = start(lambda: rospy.sleep(0.5))
    none, _ = start(lambda: rospy.sleep(0))
    time.sleep(0.2)
    assert sleeper.is_alive()
    assert none.is_alive()
    tell(100.0)
    none.join(60.0)
    assert not none.is_alive()
    until(lambda: asleep(rospy) == 1)
    time.sleep(0.6)
    assert sleeper.is_alive(), "the sleep counts from the first time seen"
    tell(100.6)
    sleeper.join(60.0)
    assert outcome == [None]


@pytest.mark.long
def test_a_clock_that_never_comes_is_named_after_two_seconds(simulated, monkeypatch):
    rospy, _ = simulated
    printed = io.StringIO()
    monkeypatch.setattr("sys.stderr", printed)
    sleeper, _ = start(lambda: rospy.sleep(1))
    until(lambda: "nothing came on /clock" in printed.getvalue())
    assert sleeper.is_alive()


def test_a_jump_back_ends_sleeps(simulated):
    rospy, tell = simulated
    tell(100.0)
    thread, outcome = start(lambda: rospy.sleep(5))
    until(lambda: asleep(rospy) == 1)
    tell(50.0)
    thread.join(60.0)
    assert isinstance(outcome[0], rospy.ROSTimeMovedBackwardsException)
    assert outcome[0].time == pytest.approx(-50.0)
    assert str(outcome[0]) == "ROS time moved backwards"


def test_a_rate_goes_on_after_a_jump_back(simulated):
    rospy, tell = simulated
    tell(100.0)
    rate, patient = rospy.Rate(1), rospy.Rate(1, reset=True)
    first, raised = start(rate.sleep)
    second, outcome = start(patient.sleep)
    until(lambda: asleep(rospy) == 2)
    tell(20.0)
    first.join(60.0)
    second.join(60.0)
    assert isinstance(raised[0], rospy.ROSTimeMovedBackwardsException)
    assert outcome == [None]
    again, outcome = start(rate.sleep)
    until(lambda: asleep(rospy) == 1)
    tell(21.5)
    again.join(60.0)
    assert outcome == [None]


@pytest.mark.filterwarnings("ignore::pytest.PytestUnhandledThreadExceptionWarning")
def test_a_timer_ends_at_a_jump_back_unless_told_otherwise(simulated):
    rospy, tell = simulated
    tell(100.0)
    plain = rospy.Timer(rospy.Duration(1), lambda event: None)
    patient = rospy.Timer(rospy.Duration(1), lambda event: None, reset=True)
    until(lambda: asleep(rospy) == 2)
    tell(10.0)
    plain.join(60.0)
    assert not plain.is_alive()
    assert patient.is_alive()
    patient.shutdown()


def test_timeouts_are_wall_time(simulated):
    rospy, tell = simulated
    tell(5.0)
    string = importlib.import_module("std_msgs.msg").String
    begin = time.monotonic()
    with pytest.raises(rospy.ROSException):
        rospy.wait_for_message("/none", string, 0.3)
    assert time.monotonic() - begin > 0.2


def test_a_rate_follows_a_fast_clock(simulated):
    rospy, tell = simulated
    tell(1.0)
    rate = rospy.Rate(10)
    thread, outcome = start(lambda: [rate.sleep() for _ in range(5)])
    # A thread that is scheduled late begins late: there are ticks as long as it needs them.
    tick, deadline = 0, time.monotonic() + 60.0
    while thread.is_alive():
        assert time.monotonic() < deadline
        tick += 1
        tell(1.0 + tick * 0.02)
    assert len(outcome[0]) == 5
    assert tick >= 0.8 * 5 * 0.1 / 0.02
    assert rate.remaining().to_sec() <= 0.1
