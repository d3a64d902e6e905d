"""What sensors measure, with their noise, for all worlds at once."""

from gazelle.sensors.imu import ImuModel, ImuReading
from gazelle.sensors.lidar import LaserScan, LidarModel
from gazelle.sensors.noise import NoiseModel

__all__ = ["ImuModel", "ImuReading", "LaserScan", "LidarModel", "NoiseModel"]
