"""State estimation from odometry, IMU, poses and GPS: the algorithms of ``robot_localization``."""

from gazelle.navigation.estimation.control import ControlModel, StampedCommand
from gazelle.navigation.estimation.kalman import Estimate, KalmanFilter, Measurement
from gazelle.navigation.estimation.prediction import ExtendedPrediction, UnscentedPrediction

__all__ = [
    "ControlModel",
    "Estimate",
    "ExtendedPrediction",
    "KalmanFilter",
    "Measurement",
    "StampedCommand",
    "UnscentedPrediction",
]
