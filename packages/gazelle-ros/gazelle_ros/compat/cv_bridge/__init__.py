"""cv_bridge's interface: images as numpy arrays."""

from gazelle_ros.compat.cv_bridge.core import CvBridge, CvBridgeError
from gazelle_ros.compat.cv_bridge.encodings import getCvType

__all__ = ["CvBridge", "CvBridgeError", "getCvType"]
