"""What sensors measure, with their noise, for all worlds at once."""

from gazelle.sensors.imu import ImuModel, ImuReading
from gazelle.sensors.lidar import LaserScan, LidarModel
from gazelle.sensors.noise import NoiseModel
from gazelle.sensors.rendering import View, look_at, render

__all__ = [
    "ImuModel",
    "ImuReading",
    "LaserScan",
    "LidarModel",
    "NoiseModel",
    "View",
    "look_at",
    "render",
]
