"""Pictures, videos and live views of simulations."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING

from gazelle.viewer.picture import take_picture

if TYPE_CHECKING:
    from gazelle.viewer.film_files import write_film
    from gazelle.viewer.filming import film, film_plan, take_plan
    from gazelle.viewer.live import LiveView
    from gazelle.viewer.plan import TopView
    from gazelle.viewer.scene_camera import SceneCamera

_HOMES = {
    "LiveView": "live",
    "SceneCamera": "scene_camera",
    "TopView": "plan",
    "film": "filming",
    "film_plan": "filming",
    "take_plan": "filming",
    "write_film": "film_files",
}

__all__ = [
    "LiveView",
    "SceneCamera",
    "TopView",
    "film",
    "film_plan",
    "take_picture",
    "take_plan",
    "write_film",
]


def __getattr__(name: str) -> object:
    """Import an attribute on first use."""
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(importlib.import_module(f"gazelle.viewer.{_HOMES[name]}"), name)
