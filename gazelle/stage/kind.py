"""Stage's way to run models of Stage files in a simulation."""

from __future__ import annotations

from collections.abc import Sequence

from gazelle.description import Model, Plugin, Sensor
from gazelle.engines.planar import PlanarEngine
from gazelle.sensors import SensorModel
from gazelle.simulation.robot import Robot, RobotHost
from gazelle.simulation.scheduled_plugin import make_scheduled
from gazelle.stage.controllers import make_controllers
from gazelle.stage.description import StagePlugin
from gazelle.stage.device_ports import open_devices
from gazelle.stage.fleet import StageFleet
from gazelle.stage.handles import inputs_of, open_outputs, sensor_models
from gazelle.stage.running import StageRunner


class StageKind:
    """Models of Stage files: a fleet moves them, and its sensors measure.

    Args:
        fleet: The robots, for users too.
    """

    def __init__(self, fleet: StageFleet) -> None:
        self.extension = fleet

    def sensors(self, model: Model) -> Sequence[tuple[Sensor, SensorModel]]:
        """Return its rangers and cameras."""
        return sensor_models(self.extension, model)

    def open_ports(self, robot: Robot) -> None:
        """Open the ports of a model's drive, sensors and devices."""
        robot.inputs.update(inputs_of(self.extension, robot.name))
        open_outputs(self.extension, robot)
        open_devices(self.extension, robot)

    def starts(self, plugin: Plugin) -> bool:
        """Return False for plugins for drives and sensors of such a model in other engines."""
        return not isinstance(plugin, StagePlugin)


def run_stage(simulation: RobotHost) -> StageKind | None:
    """Run the models of Stage files as Stage does; None if the engine moves them in another way."""
    engine = simulation.engine
    if not isinstance(engine, PlanarEngine):
        return None
    fleet = StageFleet(engine, simulation.clock, simulation.lock, simulation.seed, make_controllers)
    runner = StageRunner(fleet, simulation.loop)
    simulation.plugins.append(make_scheduled(runner, "stage", ""))
    return StageKind(fleet)
