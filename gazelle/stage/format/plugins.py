"""Plugins for drives and sensors of a Stage robot in other simulators, with stage_ros's names."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

from gazelle.description import Parameters, Sensor
from gazelle.stage.description import StagePlugin

_DRIVE = "libgazebo_ros_planar_move.so"
_LASER = "libgazebo_ros_laser.so"
_TIMEOUT = 0.2
"""After which a robot without a command stands, as in stage_ros [s]."""


@dataclass(frozen=True, slots=True)
class Names:
    """Names of one robot: below a prefix, or plain where that is empty."""

    prefix: str

    def frame(self, name: str) -> str:
        """Return a frame."""
        return f"{self.prefix}/{name}" if self.prefix else name

    def parameters(self, same: tuple[tuple[str, str], ...], **values: str) -> Parameters:
        """Return a plugin's parameters: its namespace, those of all robots, and the others."""
        own = {"robotNamespace": self.prefix, **values} if self.prefix else values
        children = (*_shared(same), *(_parameter(tag, text) for tag, text in own.items()))
        return Parameters("plugin", children=children)

    def drive(self, rate: float) -> StagePlugin:
        """Return the drive plugin: it subscribes ``cmd_vel`` and publishes ``odom`` at a rate [Hz]."""
        return StagePlugin(
            "drive",
            _DRIVE,
            self.parameters(
                (
                    ("commandTopic", "cmd_vel"),
                    ("odometryTopic", "odom"),
                    ("odometryRate", str(rate)),
                    ("cmdTimeout", str(_TIMEOUT)),
                ),
                odometryFrame=self.frame("odom"),
                robotBaseFrame=self.frame("base_footprint"),
            ),
        )

    def published(self, sensor: Sensor, index: int, count: int) -> Sensor:
        """Return a lidar with its topic, which depends on the number of lidars of the robot."""
        suffix = f"_{index}" if count > 1 else ""
        plugin = StagePlugin(
            "laser",
            _LASER,
            self.parameters(
                (("topicName", f"base_scan{suffix}"),),
                frameName=self.frame(f"base_laser_link{suffix}"),
            ),
        )
        return replace(sensor, plugins=(plugin,))


@lru_cache(maxsize=64)
def _shared(values: tuple[tuple[str, str], ...]) -> tuple[Parameters, ...]:
    return tuple(Parameters(tag, text) for tag, text in values)


@lru_cache(maxsize=64)
def _parameter(tag: str, text: str) -> Parameters:
    """Return a parameter, shared by all plugins of a robot: a file may have tens of thousands."""
    return Parameters(tag, text)
