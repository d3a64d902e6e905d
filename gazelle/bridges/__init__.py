"""Doors: a simulation on a ROS 1 graph, or the controllers of a robot (``gazelle.bridges.control``)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from gazelle.bridges.serving import RosDoor, refuse_twin, serve_ros

__all__ = ["RosDoor", "refuse_twin", "serve_ros"]


def __getattr__(name: str) -> Any:
    # A robot of one's own needs no simulation, which takes a while to be imported.
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from gazelle.bridges import serving

    return getattr(serving, name)
