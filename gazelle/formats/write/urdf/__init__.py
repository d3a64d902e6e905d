"""Models as URDF with ``<gazebo>`` extensions."""

from gazelle.formats.write.urdf.robot import write_urdf

__all__ = ["write_urdf"]
