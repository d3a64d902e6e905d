"""URDF with ``<gazebo>`` extensions, turned into models as libsdformat does."""

from gazelle.formats.urdf.robot import read_robot

__all__ = ["read_robot"]
