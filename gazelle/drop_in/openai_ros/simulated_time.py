"""Wait in the time of the simulator, whatever clock the script's node goes by."""

from __future__ import annotations

import time

from gazelle_ros.clock import SECOND, SimulatedClock, TimeSource
from gazelle_ros.clock_topic import follow_clock
from gazelle_ros.compat import rospy
from gazelle_ros.compat.rospy.state import process
from gazelle_ros.errors import TimeMovedBackwardsError

CLOCK = "/clock"


class SimulatedTime:
    """Waits for ``/clock``; without a publisher, as with a real robot, for the machine's clock.

    A script's node goes by the machine's clock if it began before the simulator did, as nodes begin
    that start the simulator themselves.
    """

    def __init__(self) -> None:
        node = process.require()
        given: TimeSource = node.clock
        self._clock: TimeSource = given if given.simulated else follow_clock(node, CLOCK)

    def wait(self, seconds: float) -> None:
        """Wait for a duration [s]; less if time jumps back or the node is shut down."""
        if not self._there():
            time.sleep(max(0.0, seconds))
            return
        try:
            self._clock.sleep(round(seconds * SECOND), rospy.is_shutdown)
        except TimeMovedBackwardsError:
            return

    def _there(self) -> bool:
        if not isinstance(self._clock, SimulatedClock) or self._clock.now():
            return True
        return any(name == CLOCK for name, _ in rospy.get_published_topics())
