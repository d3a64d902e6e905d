"""The test nodes of the package rostest: rates, parameters, publications, advertisements.

http://wiki.ros.org/rostest/Nodes lists them and their parameters.
"""
# ruff: noqa: PT009 - these are unittest's tests

from __future__ import annotations

import functools
import itertools
import sys
import threading
import time
import unittest
from collections.abc import Callable, Sequence
from typing import Any

from gazelle_ros.compat import rospy, rostest

_LOOK_S = 0.05
_REQUIRED = object()


def hztest(arguments: Sequence[str]) -> int:
    """Test the rate of a topic."""
    return _run("hztest", HzTest, arguments)


def paramtest(arguments: Sequence[str]) -> int:
    """Test that a parameter is set."""
    return _run("paramtest", ParamTest, arguments)


def publishtest(arguments: Sequence[str]) -> int:
    """Test that messages come."""
    return _run("publishtest", PublishTest, arguments)


def advertisetest(arguments: Sequence[str]) -> int:
    """Test that topics and services are there."""
    return _run("advertisetest", AdvertiseTest, arguments)


def _run(name: str, test: type[unittest.TestCase], arguments: Sequence[str]) -> int:
    sys.argv = [name, *arguments]
    rospy.init_node(name)
    try:
        rostest.rosrun("rostest", name, test, sys.argv)
    except SystemExit as end:
        return int(end.code or 0)
    return 0


class _Test(unittest.TestCase):
    def param(self, name: str, default: Any = _REQUIRED) -> Any:
        """Return a private parameter."""
        value = rospy.get_param(f"~{name}", None)
        if value is None:
            if default is _REQUIRED:
                self.fail(f"the parameter {rospy.resolve_name(f'~{name}')} is not set")
            return default
        return value

    def entries(self, name: str) -> list[dict[str, Any]]:
        """Return a parameter that is a list of dicts, each with a name."""
        found: list[dict[str, Any]] = self.param(name, [])
        for each in found:
            if "name" not in each:
                self.fail(f"an entry of {name} has no 'name': {each}")
        return [{"timeout": 10, "negative": False, "type": None} | each for each in found]


def _wait(condition: Callable[[], Any], seconds: float) -> bool:
    """Wait until a condition is true; return False if it takes longer than this [s of wall time]."""
    deadline = time.monotonic() + seconds
    while not condition():
        if time.monotonic() >= deadline or rospy.is_shutdown():
            return False
        time.sleep(_LOOK_S)
    return True


class HzTest(_Test):
    """Compares the rate of a topic with the expected one."""

    def test_hz(self) -> None:
        """Test that the rate is ``~hz``, give or take ``~hzerror``."""
        rate, duration = float(self.param("hz")), float(self.param("test_duration"))
        margin = float(self.param("hzerror")) if rate else 0.0
        wall = bool(self.param("wall_clock", default=False))
        clock = time.monotonic if wall else rospy.get_time
        received: list[float] = []
        lock = threading.Lock()

        def receive(_message: object) -> None:
            with lock:
                received.append(clock())

        subscriber = rospy.Subscriber(str(self.param("topic")), rospy.AnyMsg, receive)
        came = _wait(lambda: received, float(self.param("wait_time", 20.0)))
        self.assertEqual(came, rate > 0, "no message came" if rate else "a message came")
        end = clock() + duration
        while clock() < end and not rospy.is_shutdown():
            time.sleep(_LOOK_S)
        subscriber.unregister()
        with lock:
            self._judge(list(received), rate, margin)

    def _judge(self, received: list[float], rate: float, margin: float) -> None:
        if not rate:
            self.assertEqual(received, [], "messages came")
            return
        self.assertGreater(len(received), 1, "only one message came")
        measured = (len(received) - 1) / (received[-1] - received[0])
        self.assertGreaterEqual(measured, rate - margin, "the average rate is too low [Hz]")
        self.assertLessEqual(measured, rate + margin, "the average rate is too high [Hz]")
        if self.param("check_intervals", default=False):
            gaps = [after - before for before, after in itertools.pairwise(received)]
            self.assertGreaterEqual(min(gaps), 1 / (rate + margin), "an interval is too short [s]")
            if rate > margin:
                self.assertLessEqual(max(gaps), 1 / (rate - margin), "an interval is too long [s]")


class ParamTest(_Test):
    """Waits for a parameter."""

    def test_param(self) -> None:
        """Test that the parameter is set, and to the expected value if there is one."""
        name, expected = self.param("param_name_target"), self.param("param_value_expected", None)
        there = _wait(lambda: rospy.has_param(name), float(self.param("wait_time", 20)))
        self.assertTrue(there, f"the parameter {name} is not set")
        if expected is not None:
            self.assertEqual(rospy.get_param(name), expected)


class PublishTest(_Test):
    """Waits for messages."""

    def test_publish(self) -> None:
        """Test that a message comes on every topic, except those that are marked as negative."""
        topics = self.entries("topics")
        self.assertTrue(topics, "no topic is named in ~topics")
        received: set[str] = set()
        for each in topics:
            rospy.Subscriber(each["name"], rospy.AnyMsg, lambda _, n=each["name"]: received.add(n))
        begin = time.monotonic()
        for each in sorted(topics, key=lambda entry: float(entry["timeout"])):
            left = float(each["timeout"]) - (time.monotonic() - begin)
            came = _wait(functools.partial(received.__contains__, each["name"]), left)
            state = "published" if came else "not published"
            self.assertNotEqual(came, each["negative"], f"Topic [{each['name']}] is {state}")


class AdvertiseTest(_Test):
    """Waits for topics and services."""

    def test_advertise_topics(self) -> None:
        """Test that all topics of ``~topics`` are advertised."""
        self._all(self.entries("topics"), lambda: dict(rospy.get_published_topics()), "Topic")

    def test_advertise_services(self) -> None:
        """Test that all services of ``~services`` are advertised."""
        from gazelle_ros.compat.rosservice import get_service_list, get_service_type

        def known() -> dict[str, Any]:
            typed = {each["name"] for each in services if each["type"]}
            return {
                name: get_service_type(name) if name in typed else None
                for name in get_service_list()
            }

        services = self.entries("services")
        self._all(services, known, "Service")

    def _all(
        self, expected: list[dict[str, Any]], known: Callable[[], dict[str, Any]], what: str
    ) -> None:
        begin = time.monotonic()
        for each in sorted(expected, key=lambda entry: float(entry["timeout"])):
            name = each["name"]
            left = float(each["timeout"]) - (time.monotonic() - begin)
            there = _wait(functools.partial(lambda n: n in known(), name), left)
            state = "advertised" if there else "not advertised"
            self.assertNotEqual(there, each["negative"], f"{what} [{name}] is {state}")
            if there and each["type"] is not None:
                self.assertEqual(known()[name], each["type"], f"type of {what.lower()} [{name}]")
