"""Wind, as the plugin of Gazebo that lets it act does it.

A link with ``<enable_wind>`` is pushed at its centre of mass by
F = mass * strength * (wind - velocity), in newtons with a strength of 1/s: after 1/strength
seconds the air carries it along by two thirds. Neither shape nor size matter. The strength is
what the file's WindPlugin gives as ``force_approximation_scaling_factor``, or 1. Gusts, noise
and rise times of the plugin are not simulated.
"""

from __future__ import annotations

from gazelle.description import World

_PLUGINS = ("WindPlugin", "wind-effects")


def wind_strength(world: World) -> float:
    """How hard the wind of a world pushes [1/s]."""
    for plugin in world.plugins:
        if any(word in plugin.filename for word in _PLUGINS):
            return plugin.parameters.get("force_approximation_scaling_factor", 1.0)
    return 1.0
