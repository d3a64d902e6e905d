"""Localization on a known map with the algorithm of ROS's ``amcl``."""

from __future__ import annotations

from pathlib import Path

from gazelle.native import search_path

__path__ = search_path([str(Path(__file__).parent)])

from gazelle.navigation.localization.localizer import Localizer
from gazelle.navigation.localization.particle_filter import ParticleFilter, PoseEstimate
from gazelle.navigation.localization.scan_model import PlanarScan
from gazelle.navigation.localization.settings import AmclSettings

__all__ = ["AmclSettings", "Localizer", "ParticleFilter", "PlanarScan", "PoseEstimate"]
