"""Sleeping and rates on simulated time."""

from __future__ import annotations

import logging
import struct
import threading
import time

import pytest
from ros.graph import until

from gazelle_ros import Rate, SimulatedClock, Time, WallClock, load_message
from gazelle_ros.clock import SECOND
from gazelle_ros.clock_topic import follow_clock
from gazelle_ros.errors import TimeMovedBackwardsError


class Sleeper(threading.Thread):
    """Sleeps in the background and keeps what came of it."""

    def __init__(self, function):
        super().__init__(daemon=True)
        self.function, self.outcome = function, None
        self.start()

    def run(self):
        try:
            self.outcome = self.function()
        except TimeMovedBackwardsError as error:
            self.outcome = error


def asleep(clock, function):
    """Start a thread that already sleeps."""
    sleeper = Sleeper(function)
    until(lambda: clock._sleepers)
    return sleeper


def test_a_sleep_counts_from_the_first_time_there_is():
    clock = SimulatedClock()
    sleeper = Sleeper(lambda: clock.sleep(SECOND // 2))
    assert sleeper.is_alive()
    clock.set(100 * SECOND)
    until(lambda: clock._sleepers)
    time.sleep(0.5)
    assert sleeper.is_alive()
    clock.set(100 * SECOND + SECOND // 4)
    time.sleep(0.05)
    assert sleeper.is_alive()
    clock.set(101 * SECOND)
    until(lambda: sleeper.outcome is True)


def test_a_jump_back_raises_in_a_sleep_and_a_rate_works_again():
    clock = SimulatedClock()
    clock.set(100 * SECOND)
    sleeper = asleep(clock, lambda: clock.sleep(5 * SECOND))
    clock.set(50 * SECOND)
    until(lambda: isinstance(sleeper.outcome, TimeMovedBackwardsError))
    assert sleeper.outcome.jump == -50
    rate = Rate(clock, 1.0)
    sleeper = asleep(clock, rate.sleep)
    clock.set(20 * SECOND)
    until(lambda: isinstance(sleeper.outcome, TimeMovedBackwardsError))
    sleeper = asleep(clock, rate.sleep)
    clock.set(22 * SECOND)
    until(lambda: sleeper.outcome is True)
    patient = Rate(clock, 1.0, reset=True)
    sleeper = asleep(clock, patient.sleep)
    clock.set(10 * SECOND)
    until(lambda: sleeper.outcome is True)


def test_a_sleep_can_be_cancelled():
    clock, stop = SimulatedClock(), threading.Event()
    sleeper = Sleeper(lambda: clock.sleep(SECOND, stop.is_set))
    stop.set()
    until(lambda: sleeper.outcome is False)
    assert not WallClock().sleep(10 * SECOND, stop.is_set)


@pytest.mark.long
def test_a_clock_that_never_comes_is_reported(caplog):
    clock, stop = SimulatedClock(), threading.Event()
    with caplog.at_level(logging.WARNING, "gazelle.ros"):
        sleeper = Sleeper(lambda: clock.sleep(SECOND, stop.is_set))
        until(lambda: "nothing came on /clock" in caplog.text)
    stop.set()
    sleeper.join(60)


def test_a_rate_keeps_its_pace_on_a_fast_clock():
    clock = SimulatedClock()
    clock.set(SECOND)
    rate = Rate(clock, 50)
    stamps = []

    def cycle():
        for _ in range(20):
            rate.sleep()
            stamps.append(clock.now())
        return True

    sleeper, deadline = Sleeper(cycle), time.monotonic() + 60.0
    while sleeper.outcome is None:
        assert time.monotonic() < deadline
        # Time goes on while the loop sleeps, and waits for it while it is awake.
        if any(not each.event.is_set() for each in list(clock._sleepers)):
            clock.set(clock.now() + SECOND // 100)
        time.sleep(0.0005)
    assert stamps[-1] - stamps[0] == pytest.approx(19 * SECOND / 50, abs=SECOND / 20)


def test_a_node_follows_the_clock_topic(make_node):
    boss = make_node("boss")
    boss.set_param("/use_sim_time", True)
    ticker = make_node("ticker", clock=WallClock())
    node = make_node("node")
    assert node.clock.simulated
    publisher = ticker.advertise("/clock", load_message("rosgraph_msgs/Clock"))
    until(lambda: publisher.num_connections == 1)
    message = publisher.message_class()
    message.deserialize(struct.pack("<II", 7, 5))
    publisher.publish(message)
    until(lambda: node.clock.now() == 7 * SECOND + 5)


def test_a_node_that_follows_the_clock_still_gives_its_messages_to_others(make_node):
    stage, node = make_node("stage"), make_node("watcher")
    clock = load_message("rosgraph_msgs/Clock")
    follow_clock(node)
    heard = []
    node.subscribe("/clock", clock, heard.append)
    publisher = stage.advertise("/clock", clock, latch=True)
    publisher.publish(clock(Time(3, 5)))
    until(lambda: heard)
    assert heard[0].clock == Time(3, 5)
