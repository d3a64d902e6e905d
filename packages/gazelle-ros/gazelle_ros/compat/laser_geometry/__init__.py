"""laser_geometry's interface: point clouds of laser scans."""

from gazelle_ros.compat.laser_geometry.laser_geometry import LaserProjection

__all__ = ["LaserProjection"]
