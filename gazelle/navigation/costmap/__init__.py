"""Costmaps from maps, sensors and inflation.

The rules, costs and parameters are those of ROS's ``costmap_2d``.
"""

from __future__ import annotations

from pathlib import Path

from gazelle.native import search_path

__path__ = search_path([str(Path(__file__).parent)])

from gazelle.navigation.costmap.costmap import Costmap, Layer
from gazelle.navigation.costmap.footprint import footprint_of
from gazelle.navigation.costmap.inflation_layer import InflationLayer
from gazelle.navigation.costmap.obstacle_layer import ObservationSource, ObstacleLayer
from gazelle.navigation.costmap.parameters import CostmapSetup, costmap_of
from gazelle.navigation.costmap.static_layer import StaticLayer
from gazelle.navigation.costmap.voxel_layer import VoxelLayer

__all__ = [
    "Costmap",
    "CostmapSetup",
    "InflationLayer",
    "Layer",
    "ObservationSource",
    "ObstacleLayer",
    "StaticLayer",
    "VoxelLayer",
    "costmap_of",
    "footprint_of",
]
