"""Maps made while driving (SLAM): the law of ROS's ``gmapping``."""

from __future__ import annotations

from pathlib import Path

from gazelle.native import search_path

__path__ = search_path([str(Path(__file__).parent)])

from gazelle.navigation.mapping.grid_slam import GmappingSettings, GridSlam

__all__ = ["GmappingSettings", "GridSlam"]
