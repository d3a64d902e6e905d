"""Maps: masked arrays with unknown cells masked."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle_ros.compat.ros_numpy.registry import converts_from_numpy, converts_to_numpy
from gazelle_ros.msgs import nav_msgs


@converts_to_numpy("nav_msgs/OccupancyGrid")
def occupancygrid_to_numpy(msg: nav_msgs.msg.OccupancyGrid) -> np.ma.MaskedArray[Any, Any]:
    """Return the cells (height, width), -1 of them masked."""
    cells = np.asarray(msg.data, dtype=np.int8).reshape(msg.info.height, msg.info.width)
    return np.ma.array(cells, mask=cells == -1, fill_value=-1)


@converts_from_numpy("nav_msgs/OccupancyGrid")
def numpy_to_occupancy_grid(arr: NDArray[Any], info: Any = None) -> Any:
    """Return the ``OccupancyGrid`` of cells of int8; masked ones become -1.

    Raises:
        TypeError: The array has not two dimensions of int8.
    """
    if arr.ndim != 2 or arr.dtype != np.int8:
        raise TypeError("a map is an array of int8 with two dimensions")
    grid = nav_msgs.msg.OccupancyGrid()
    if info is not None:
        grid.info = info
    filled = np.ma.filled(arr, -1)
    grid.info.height, grid.info.width = filled.shape
    grid.data = filled.ravel()
    return grid
