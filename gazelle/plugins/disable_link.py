"""A link at rest: what ``libroboticsgroup_gazebo_disable_link_plugin.so`` does.

ODE leaves a disabled body where it is until something touches it or pulls at it.
"""

from __future__ import annotations

from gazelle.description import Parameters
from gazelle.simulation import ModelPlugin, Robot


class DisableLink(ModelPlugin):
    """Takes a link's weight and lays it to rest: it moves only when others move it."""

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Find the link."""
        self._link = robot.links[parameters.require("link", str)]
        self._link.set_properties(gravity=0.0)
