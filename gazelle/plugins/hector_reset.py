"""Notification of resets: ``libhector_gazebo_reset_plugin.so``."""

from __future__ import annotations

from gazelle.array_types import Worlds
from gazelle.description import Parameters
from gazelle.simulation import ModelPlugin, Output, Robot


class HectorReset(ModelPlugin):
    """Publishes ``reset`` on ``/syscommand`` at every reset."""

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Open the port."""
        del parameters
        self._output = Output("/syscommand", str, lambda: "reset", event=True)
        robot.outputs["syscommand"] = self._output

    def reset(self, worlds: Worlds | None) -> None:
        """Publish the reset."""
        del worlds
        self._output.publish()
