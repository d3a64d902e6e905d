"""Trees of KDL from URDF."""

from gazelle.ros.compat.kdl_parser_py import urdf

__all__ = ["urdf"]
