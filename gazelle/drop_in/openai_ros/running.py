"""Nodes and topics that are on the graph already, and need not be started."""

from __future__ import annotations

from collections.abc import Iterable

from gazelle_ros.compat import rospy
from gazelle_ros.compat.rospy.state import process
from gazelle_ros.tools import nodes
from gazelle_ros.tools.graph import GraphInspector

_SERVICE = "/gazebo/pause_physics"


def simulator_runs() -> bool:
    """Return whether a simulator with Gazebo's services is on the graph, and answers."""
    with GraphInspector("openai_ros", process.require().master_uri) as graph:
        owners = dict(graph.services()).get(_SERVICE, [])
        return any(nodes.alive(graph, name) for name in owners)


def published(topics: Iterable[str]) -> bool:
    """Return whether all these topics have publishers."""
    known = {name for name, _ in rospy.get_published_topics()}
    return known.issuperset(topics)
