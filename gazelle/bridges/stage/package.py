"""The package ``stage_ros`` where it is not installed."""

from __future__ import annotations

from gazelle.ros.builtin.registry import BuiltinPackage

STAGE_ROS = BuiltinPackage("stage_ros", {"stageros": "gazelle.bridges.stage.server:main"})
