"""Maps as messages of ``nav_msgs``, and back."""

from __future__ import annotations

import numpy as np

from gazelle.bridges.conversions import pose_of_message
from gazelle.description.occupancy import OccupancyMap
from gazelle.errors import RosError
from gazelle_ros.msgs import nav_msgs
from gazelle_ros.time import Time


def grid_message(grid: OccupancyMap, frame: str, now: int) -> nav_msgs.msg.OccupancyGrid:
    """Return a ``nav_msgs/OccupancyGrid`` of a map at a time [ns]."""
    message = nav_msgs.msg.OccupancyGrid()
    stamp = Time(nsecs=now)
    message.header.stamp, message.header.frame_id = stamp, frame
    info = message.info
    info.map_load_time, info.resolution = stamp, grid.resolution
    info.height, info.width = grid.data.shape
    place, turn = info.origin.position, info.origin.orientation
    place.x, place.y = grid.origin.x, grid.origin.y
    turn.x, turn.y, turn.z, turn.w = grid.origin.quaternion
    message.data = grid.data.ravel().tolist()
    return message


def grid_of_message(message: nav_msgs.msg.OccupancyGrid) -> OccupancyMap:
    """Return the map of a ``nav_msgs/OccupancyGrid``.

    Raises:
        RosError: There are not as many cells as its size says.
    """
    info = message.info
    data = np.array(message.data, dtype=np.int8)
    if data.size != info.width * info.height:
        raise RosError(
            f"a map of {info.width} x {info.height} cells has {data.size}",
            hint="data must have width * height cells",
        )
    origin = pose_of_message(info.origin)
    return OccupancyMap(data.reshape(info.height, info.width), float(info.resolution), origin)
