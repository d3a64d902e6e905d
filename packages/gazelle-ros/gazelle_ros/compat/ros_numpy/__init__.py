"""ros_numpy's interface: messages as numpy arrays, and back."""

from gazelle_ros.compat.ros_numpy import geometry, image, occupancy_grid, point_cloud2, registry
from gazelle_ros.compat.ros_numpy.registry import (
    converts_from_numpy,
    converts_to_numpy,
    msgify,
    numpify,
)

__all__ = [
    "converts_from_numpy",
    "converts_to_numpy",
    "geometry",
    "image",
    "msgify",
    "numpify",
    "occupancy_grid",
    "point_cloud2",
    "registry",
]
