"""Sensors and their noise, for all worlds at once."""

from pathlib import Path

from gazelle.native import search_path

__path__ = search_path([str(Path(__file__).parent)])

from gazelle.sensors.altitude import (
    AirPressure,
    AirPressureModel,
    Altimeter,
    AltimeterModel,
    AltimeterReading,
    PressureReading,
    air_pressure,
)
from gazelle.sensors.camera import CameraImage, CameraModel
from gazelle.sensors.contact import ContactModel, ContactReading
from gazelle.sensors.force_torque import ForceTorque, ForceTorqueModel, WrenchReading
from gazelle.sensors.geodesy import TangentPlane
from gazelle.sensors.gps import Gps, GpsModel, GpsReading
from gazelle.sensors.imu import ImuModel, ImuReading
from gazelle.sensors.laser_scan import LaserScan
from gazelle.sensors.lidar import LidarModel
from gazelle.sensors.magnetometer import MagneticReading, Magnetometer, MagnetometerModel
from gazelle.sensors.model import GroupedModel, ScanningModel, SensorModel
from gazelle.sensors.noise import NoiseModel
from gazelle.sensors.rendering import View, look_at, range_image, render
from gazelle.sensors.sonar import Sonar, SonarModel, SonarReading

__all__ = [
    "AirPressure",
    "AirPressureModel",
    "Altimeter",
    "AltimeterModel",
    "AltimeterReading",
    "CameraImage",
    "CameraModel",
    "ContactModel",
    "ContactReading",
    "ForceTorque",
    "ForceTorqueModel",
    "Gps",
    "GpsModel",
    "GpsReading",
    "GroupedModel",
    "ImuModel",
    "ImuReading",
    "LaserScan",
    "LidarModel",
    "MagneticReading",
    "Magnetometer",
    "MagnetometerModel",
    "NoiseModel",
    "PressureReading",
    "ScanningModel",
    "SensorModel",
    "Sonar",
    "SonarModel",
    "SonarReading",
    "TangentPlane",
    "View",
    "WrenchReading",
    "air_pressure",
    "look_at",
    "range_image",
    "render",
]
