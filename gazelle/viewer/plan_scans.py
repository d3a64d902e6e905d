"""What the rangers and lidars of a world in the plane look at, for pictures."""

from __future__ import annotations

from gazelle.engines.planar import Fleet, Mount, PlanarEngine, Scanner
from gazelle.engines.planar.fans import Fan
from gazelle.sensors import LidarModel
from gazelle.simulation import Simulation
from gazelle.simulation.stage import StageSimulation


def scanners_of(simulation: Simulation | StageSimulation, fleet: Fleet) -> list[Scanner]:
    """Scanners without noise, with the beams of all rangers and lidars."""
    if isinstance(simulation, StageSimulation):
        pairs = list(zip(simulation.fans, simulation.mounts, strict=True))
    else:
        pairs = _lidars(simulation)
    return [Scanner(fleet, fan, mounts) for fan, mounts in pairs]


def _lidars(simulation: Simulation) -> list[tuple[Fan, list[Mount]]]:
    """Fans of lidars in the plane, cut where the lidar sees no farther."""
    engine = simulation.engine
    found = []
    for robot in simulation.robots.values():
        for sensor in robot.sensors.values():
            model = sensor.model
            if not isinstance(model, LidarModel) or not isinstance(engine, PlanarEngine):
                continue
            scanner = engine.caster(model.link, model.origins, model.directions).scanner
            old, reach = scanner.fan, model.lidar.range_max
            fan = Fan(old.start, old.step, old.count, reach, min(old.begin, 0.9 * reach))
            found.append((fan, scanner.mounts))
    return found
