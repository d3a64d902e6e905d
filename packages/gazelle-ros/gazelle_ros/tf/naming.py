"""Names of frames with a prefix, as tf's ``resolve`` makes them.

A graph with several robots of the same kind keeps their frames apart by the parameter
``tf_prefix`` (http://wiki.ros.org/geometry/CoordinateFrameConventions). Names on the wire never
begin with a slash since tf2.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from gazelle_ros.node import Node

PARAMETER = "tf_prefix"


def resolve_frame(prefix: str, frame: str) -> str:
    """Return a frame's full name; one with a leading slash is full, an empty one stays empty.

    >>> resolve_frame("r1", "odom"), resolve_frame("/r1", "odom"), resolve_frame("r1", "/map")
    ('r1/odom', 'r1/odom', 'map')
    """
    if frame.startswith("/"):
        return frame[1:]
    prefix = prefix.removeprefix("/")
    return f"{prefix}/{frame}" if prefix and frame else frame


class FramePrefixes:
    """The parameters ``tf_prefix`` of a graph, as they are when this is made.

    Args:
        node: Queries the parameter server, once.
    """

    def __init__(self, node: Node) -> None:
        self._values = {
            name.removesuffix(f"/{PARAMETER}"): str(node.get_param(name, "") or "")
            for name in node.param_names()
            if name.endswith(f"/{PARAMETER}")
        }

    def own(self, namespace: str) -> str:
        """Return the parameter of a namespace itself; empty without one, whatever is above it."""
        name = namespace.strip("/")
        return self._values.get(f"/{name}" if name else "", "")

    def of(self, namespace: str) -> str:
        """Return the prefix of a namespace: its own parameter, else the nearest above it."""
        place = "/" + namespace.strip("/")
        while True:
            place = place.rstrip("/")
            if place in self._values or not place:
                return self._values.get(place, "")
            place = place.rpartition("/")[0]
