"""Runs the tests of a node as rostest does."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import Any

from gazelle_ros.compat import commands, rosunit
from gazelle_ros.compat.rosgraph.masterapi import Master
from gazelle_ros.compat.rospy.core import signal_shutdown


def rosrun(
    package: str,
    test_name: str,
    test: Any,
    sysargs: Sequence[str] | None = None,
) -> None:
    """Run tests, write the results, end the node, and the process with 1 if any failed.

    Args:
        package: Package of the tests.
        test_name: Their name.
        test: A class of tests.
        sysargs: The command line, by default this process's.
    """
    try:
        rosunit.unitrun(package, test_name, test, sysargs)
    finally:
        signal_shutdown("test complete")


run = rosrun
unitrun = rosunit.unitrun


def get_master() -> Master:
    """Return the master."""
    return Master("/roslib")


def is_subscriber(topic: str, subscriber_id: str) -> bool:
    """Return whether a node subscribes to a topic."""
    return _is_in(1, topic, subscriber_id)


def is_publisher(topic: str, publisher_id: str) -> bool:
    """Return whether a node publishes on a topic."""
    return _is_in(0, topic, publisher_id)


def _is_in(place: int, topic: str, node: str) -> bool:
    state = dict(get_master().getSystemState()[place])
    return node in state.get(topic, [])


def rostestmain() -> None:
    """Run ``rostest`` with this process's command line.

    Raises:
        SystemExit: A test failed, or there is none.
    """
    name, *words = sys.argv
    commands.run("launch", [name, "--test", *words])
