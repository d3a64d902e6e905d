"""Measurements of topics."""

from __future__ import annotations

import time

import pytest
from ros.graph import Background, until

from gazelle_ros import load_message
from gazelle_ros.tools.rates import RateMeter, SizeMeter, measure_rates

STRING = load_message("std_msgs/String")


def test_rates_are_measured():
    meter = RateMeter()
    assert meter.read() is None
    for number in range(11):
        meter.add(number * 0.1)
    rate, least, most, spread, count = meter.read()
    assert (rate, least, most, count) == (
        pytest.approx(10),
        pytest.approx(0.1),
        pytest.approx(0.1),
        11,
    )
    assert spread == pytest.approx(0, abs=1e-9)
    assert meter.read() is None
    assert not meter.add(0.0)


def test_a_window_forgets():
    meter = RateMeter(3)
    for now in (0.0, 10.0, 10.1, 10.2):
        meter.add(now)
    assert meter.read()[4] == 3
    assert meter.add(10.3)
    assert meter.read()[0] == pytest.approx(10)


def test_sizes_are_measured():
    meter = SizeMeter()
    meter.add(0.0, 1000)
    assert meter.text(1.0) == ""
    meter.add(1.0, 3000)
    assert meter.text(2.0) == (
        "average: 2.00KB/s\n\tmean: 2.00KB min: 1.00KB max: 3.00KB window: 2\n"
    )


@pytest.mark.long
def test_rates_of_topics_are_written(graph, make_node, out):
    assert any(written_rate_is_right(graph, make_node, out) for _ in range(10))


def written_rate_is_right(graph, make_node, out):
    """Return whether the rate is right; a pause of a thread or process leads to another rate."""
    out.seek(0)
    out.truncate()
    node = make_node("talker")
    publishers = [node.advertise(topic, STRING) for topic in ("/a", "/b")]
    running = Background(measure_rates, graph, ["/a", "/b"], out)
    until(lambda: all(each.num_connections for each in publishers))
    begin, rounds = time.monotonic(), 0
    while out.getvalue().count("\n") < 6 and time.monotonic() < begin + 30.0:
        for each in publishers:
            each.publish(STRING())
        rounds += 1
        time.sleep(0.02)
    wanted = rounds / (time.monotonic() - begin)
    running.end()
    for each in publishers:
        each.close()
    lines = out.getvalue().splitlines()
    assert lines[:2] == ["subscribed to [/a]", "subscribed to [/b]"]
    assert lines[2].split() == ["topic", "rate", "min_delta", "max_delta", "std_dev", "window"]
    return float(lines[4].split()[1]) == pytest.approx(wanted, rel=0.2)


@pytest.mark.parametrize("meter", [RateMeter, SizeMeter])
def test_a_window_larger_than_any_memory_keeps_all(meter):
    meter(10**30)
