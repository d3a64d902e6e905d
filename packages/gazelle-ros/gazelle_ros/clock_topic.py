"""The clock of a node: wall time, or the time on ``/clock``."""

from __future__ import annotations

from gazelle_ros.clock import SimulatedClock, TimeSource, WallClock
from gazelle_ros.msgs import rosgraph_msgs
from gazelle_ros.topics import TopicNode


def node_clock(node: TopicNode) -> TimeSource:
    """Return a node's initial clock: simulated if the parameter ``/use_sim_time`` is true."""
    if node.parameters.get("/use_sim_time", False) is not True:
        return WallClock()
    return follow_clock(node)


def follow_clock(node: TopicNode, topic: str = "/clock") -> SimulatedClock:
    """Return a clock that follows a topic of ``rosgraph_msgs/Clock``."""
    clock = SimulatedClock(topic)

    def tick(message: rosgraph_msgs.msg.Clock) -> None:
        clock.set(message.clock.to_nsec())

    node.subscribe(topic, rosgraph_msgs.msg.Clock, tick, queue_size=10)
    return clock
