"""ROS 1 interface of simulations, and of robot controllers (``gazelle.bridges.control``)."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from gazelle.bridges.serving import RosServer, refuse_twin, serve_ros

__all__ = ["RosServer", "refuse_twin", "serve_ros"]


def __getattr__(name: str) -> Any:
    # Imported on first use: controllers of real robots need no simulation, which imports slowly.
    if name == "RosDoor":
        warnings.warn(DeprecationWarning("RosDoor is called RosServer now"), stacklevel=2)
        name = "RosServer"
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from gazelle.bridges import serving

    return getattr(serving, name)
