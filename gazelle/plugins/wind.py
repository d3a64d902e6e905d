"""Wind that acts: what ``libWindPlugin.so`` of Gazebo classic does.

The engine itself pushes links with ``<enable_wind>`` by the world's ``<wind>`` (see
docs/explanation/physics.md), as hard as this plugin's ``<force_approximation_scaling_factor>`` says. What
is left for the plugin is to say what of its settings is not simulated.
"""

from __future__ import annotations

import warnings

from gazelle.description import Parameters
from gazelle.errors import SimulationWarning, located
from gazelle.simulation import Simulation, WorldPlugin

_WAVERING = ("horizontal", "vertical")


class Wind(WorldPlugin):
    """Steady wind of the world."""

    def load(self, simulation: Simulation, parameters: Parameters) -> None:  # noqa: ARG002  the engine blows
        """Warn of gusts, noise and rise times, which are left out."""
        for tag in _WAVERING:
            node = parameters.find(tag)
            if node is not None:
                text = (
                    f"the wind blows steadily; <{tag}> of WindPlugin (rise times, gusts, noise) "
                    "is left out"
                )
                warnings.warn(SimulationWarning(located(text, node.source)), stacklevel=2)
                return
