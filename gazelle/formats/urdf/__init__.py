"""URDF with ``<gazebo>`` extensions, turned into models as libsdformat does."""

from gazelle.formats.urdf.robot import read_robot
from gazelle.formats.urdf.tree import NoLinksError

__all__ = ["NoLinksError", "read_robot"]
