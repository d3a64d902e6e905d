"""SLAM with the algorithms of ROS's ``gmapping``, ``slam_karto`` and ``hector_mapping``."""

from __future__ import annotations

from pathlib import Path

from gazelle.native import search_path

__path__ = search_path([str(Path(__file__).parent)])

from gazelle.navigation.mapping.grid_slam import GmappingSettings, GridSlam
from gazelle.navigation.mapping.hector import HectorSettings, HectorSlam
from gazelle.navigation.mapping.karto import KartoSettings, KartoSlam

__all__ = [
    "GmappingSettings",
    "GridSlam",
    "HectorSettings",
    "HectorSlam",
    "KartoSettings",
    "KartoSlam",
]
