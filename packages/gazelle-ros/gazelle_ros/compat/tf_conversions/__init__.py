"""tf_conversions' interface: frames of tf, messages, matrices and PyKDL."""

from gazelle_ros.compat.tf import transformations
from gazelle_ros.compat.tf_conversions.posemath import (
    fromCameraParams,
    fromMatrix,
    fromMsg,
    fromTf,
    toMatrix,
    toMsg,
    toTf,
)

__all__ = [
    "fromCameraParams",
    "fromMatrix",
    "fromMsg",
    "fromTf",
    "toMatrix",
    "toMsg",
    "toTf",
    "transformations",
]
