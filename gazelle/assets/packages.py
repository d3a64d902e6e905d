"""The bundled ROS packages, for ``$(find ...)``, ``gazelle launch`` and ``package://``."""

from __future__ import annotations

from pathlib import Path

from gazelle.ros.builtin.registry import BuiltinPackage

_HERE = Path(__file__).parent

TURTLEBOT3_DESCRIPTION = BuiltinPackage(
    "turtlebot3_description", folder=_HERE / "turtlebot3_description"
)
TURTLEBOT3_GAZEBO = BuiltinPackage("turtlebot3_gazebo", folder=_HERE / "turtlebot3_gazebo")
