"""Links of a robot as ``visualization_msgs/MarkerArray``."""

from __future__ import annotations

from collections.abc import Sequence

from gazelle.array_types import Floats
from gazelle.bridges.conversions import pose_message
from gazelle.description import Box, Cylinder, Mesh, Sphere
from gazelle.description.geometry import Geometry
from gazelle.kinematics import RobotModel
from gazelle_ros.msgs import visualization_msgs
from gazelle_ros.time import Time

_BOX, _SPHERE, _CYLINDER, _MESH = 1, 2, 3, 10
_GREY = 0.5


def link_markers(
    robot: RobotModel, state: Floats, links: Sequence[str], now: int
) -> visualization_msgs.msg.MarkerArray:
    """Return a ``MarkerArray`` of each link's visuals, or its collisions without visuals.

    Args:
        robot: The robot.
        state: Of all variables, shape (variables,).
        links: Links of the group; others are left out.
        now: Stamp of the markers [ns].
    """
    made = visualization_msgs.msg.MarkerArray()
    for name, body in robot.bodies.items():
        if name not in links:
            continue
        pose = robot.pose(state, name)
        for part in body.link.visuals or body.link.collisions:
            marker = _shape(part.geometry)
            if marker is None:
                continue
            marker.header.frame_id, marker.header.stamp = robot.frame, Time(nsecs=now)
            marker.ns, marker.id = name, len(made.markers)
            marker.pose = pose_message(pose * part.pose)
            marker.color.r = marker.color.g = marker.color.b = _GREY
            marker.color.a = 1.0
            made.markers.append(marker)
    return made


def _shape(geometry: Geometry) -> visualization_msgs.msg.Marker | None:
    """Return a marker of a shape; None for shapes that markers lack."""
    marker = visualization_msgs.msg.Marker()
    if isinstance(geometry, Box):
        marker.type, lengths = _BOX, geometry.size
    elif isinstance(geometry, Sphere):
        marker.type, lengths = _SPHERE, (2.0 * geometry.radius,) * 3
    elif isinstance(geometry, Cylinder):
        width = 2.0 * geometry.radius
        marker.type, lengths = _CYLINDER, (width, width, geometry.length)
    elif isinstance(geometry, Mesh):
        marker.type, lengths = _MESH, geometry.scale
        marker.mesh_resource, marker.mesh_use_embedded_materials = geometry.uri, True
    else:
        return None
    marker.scale.x, marker.scale.y, marker.scale.z = lengths
    return marker
