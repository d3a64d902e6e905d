"""Trees of KDL from URDF."""

from gazelle_ros.compat.kdl_parser_py import urdf

__all__ = ["urdf"]
