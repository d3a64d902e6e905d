"""image_geometry's interface: what a camera's calibration says about pixels and rays."""

from gazelle_ros.compat.image_geometry.cameramodels import (
    PinholeCameraModel,
    StereoCameraModel,
)

__all__ = ["PinholeCameraModel", "StereoCameraModel"]
