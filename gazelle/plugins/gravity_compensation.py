"""Gravity compensation of joints: ``libGravityCompensationPlugin.so``."""

from __future__ import annotations

import warnings

from gazelle.description import Parameters
from gazelle.errors import SimulationWarning
from gazelle.simulation import ModelPlugin, Robot


class GravityCompensation(ModelPlugin):
    """Takes the weight off the links of a model that joints hold to the world.

    That is what efforts on all joints that balance the weight come to, as the original gives.
    """

    def load(self, robot: Robot, parameters: Parameters) -> None:  # noqa: ARG002  its one tag names the model
        """Compensate gravity on the links; warn if nothing holds the model."""
        held = any(
            joint.parent == "world"
            for placed in robot.description.walk()
            for joint in placed.model.joints
        )
        if not held:
            warnings.warn(
                SimulationWarning(
                    f"'{robot.name}' is not fixed to the world: gravity on its joints is not "
                    "compensated"
                ),
                stacklevel=2,
            )
            return
        for link in robot.links.values():
            link.set_properties(gravity=0.0)
