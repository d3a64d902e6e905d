"""Parameters of ``octomap_server``."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import Any

from gazelle_ros.base.errors import RosError
from gazelle_ros.base.parameter_values import fields_of, value_of, warn_of_unknown
from gazelle_ros.builtin.octomap.ground import GroundFilter
from gazelle_ros.builtin.octomap.voxels import HitModel
from gazelle_ros.builtin.parameters import private_values
from gazelle_ros.node import Node

_SENSOR = {"hit": "hit", "miss": "miss", "least": "min", "most": "max", "max_range": "max_range", "min_range": "min_range"}  # fmt: skip
"""Fields of `HitModel`, and parameters below ``sensor_model``."""
_UNUSED = (
    "colored_map", "compress_map", "incremental_2D_projection", "latch", "publish_free_space",
)  # fmt: skip


@dataclass(frozen=True, slots=True)
class OctomapSettings:
    """Parameters of ``octomap_server``, with its defaults.

    Attributes:
        resolution: Side of a cell [m].
        frame_id: Frame of the map.
        height_map: Whether cells are shown in colours of their height.
        pointcloud_min_x: Points with less are left out, in the frame of the map [m].
        pointcloud_max_x: Points with more are left out [m].
        pointcloud_min_y: Likewise along y [m].
        pointcloud_max_y: Likewise along y [m].
        pointcloud_min_z: Likewise along z [m].
        pointcloud_max_z: Likewise along z [m].
        occupancy_min_z: Lower cells are not published, nor part of the projected map [m].
        occupancy_max_z: Higher cells are not [m].
        min_x_size: Least size of the projected map, around its origin [m].
        min_y_size: Likewise along y [m].
        filter_speckles: Whether occupied cells without occupied neighbours are not published.
        filter_ground: Whether points of the ground only free what is before them.
        base_frame_id: Frame in which the ground is near z = 0.
        map_file: A map to begin with; "" for none.
        sensor: Parameters below ``sensor_model``.
        ground: Parameters below ``ground_filter``.
    """

    resolution: float = 0.05
    frame_id: str = "map"
    height_map: bool = True
    pointcloud_min_x: float = -math.inf
    pointcloud_max_x: float = math.inf
    pointcloud_min_y: float = -math.inf
    pointcloud_max_y: float = math.inf
    pointcloud_min_z: float = -math.inf
    pointcloud_max_z: float = math.inf
    occupancy_min_z: float = -math.inf
    occupancy_max_z: float = math.inf
    min_x_size: float = 0.0
    min_y_size: float = 0.0
    filter_speckles: bool = False
    filter_ground: bool = False
    base_frame_id: str = "base_footprint"
    map_file: str = ""
    sensor: HitModel = HitModel()  # noqa: RUF009  # it is frozen
    ground: GroundFilter = GroundFilter()  # noqa: RUF009  # it is frozen

    @classmethod
    def read(cls, node: Node) -> OctomapSettings:
        """Read the private parameters of a node.

        Raises:
            Error: One is of another kind, or asks for what is not here.
        """
        values = private_values(node)
        where = node.resolve("~")
        spaces = {"sensor": "sensor_model", "ground": "ground_filter"}
        known = [name for name in cls.__slots__ if name not in spaces]
        warn_of_unknown(where, values, [*known, *_UNUSED])
        if values.get("colored_map") is True:
            raise RosError("'colored_map' is not supported", hint="leave it out")
        sensor = _below(where, values, "sensor_model", _SENSOR.values())
        ground = _below(where, values, "ground_filter", GroundFilter.__slots__)
        found = cls(
            **fields_of(cls, values, without=tuple(spaces)),
            sensor=HitModel(
                **{
                    field: value_of(sensor, name, getattr(HitModel(), field))
                    for field, name in _SENSOR.items()
                }
            ),
            ground=GroundFilter(**fields_of(GroundFilter, ground)),
        )
        if not found.resolution > 0.0:
            raise RosError(f"'resolution' must be positive, not {found.resolution}")
        return found


def _below(
    where: str, values: Mapping[str, Any], name: str, known: Collection[str]
) -> Mapping[str, Any]:
    """Return the parameters of a namespace; unknown ones are warned of."""
    found = values.get(name, {})
    if not isinstance(found, Mapping):
        raise RosError(f"'{name}' must be a mapping of parameters, not {found!r}")
    warn_of_unknown(f"{where}/{name}", found, known)
    return found
