"""The bundled ROS packages, for ``$(find ...)``, ``gazelle launch`` and ``package://``."""

from __future__ import annotations

from gazelle import assets
from gazelle.ros.builtin.registry import BuiltinPackage

TURTLEBOT3_DESCRIPTION = BuiltinPackage(
    "turtlebot3_description", folder=assets.root() / "turtlebot3_description"
)
TURTLEBOT3_GAZEBO = BuiltinPackage("turtlebot3_gazebo", folder=assets.root() / "turtlebot3_gazebo")
COURIER_DESCRIPTION = BuiltinPackage(
    "courier_description", folder=assets.root() / "courier_description"
)
COURIER_GAZEBO = BuiltinPackage("courier_gazebo", folder=assets.root() / "courier_gazebo")
FLEET_STAGE = BuiltinPackage("fleet_stage", folder=assets.root() / "fleet_stage")
