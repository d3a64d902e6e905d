"""Beams of the rangers and lidars of a world in the plane, for pictures."""

from __future__ import annotations

from gazelle.engines.planar import Fan, Fleet, Mount, PlanarEngine, Scanner
from gazelle.sensors import LidarModel
from gazelle.simulation import Simulation
from gazelle.stage import StageFleet


def scanners_of(simulation: Simulation, fleet: Fleet) -> list[Scanner]:
    """Return scanners without noise, with the beams of all rangers and lidars."""
    stage = simulation.extension(StageFleet)
    pairs = [] if stage is None else list(zip(stage.fans, stage.mounts, strict=True))
    return [Scanner(fleet, fan, mounts) for fan, mounts in (*pairs, *_lidars(simulation))]


def _lidars(simulation: Simulation) -> list[tuple[Fan, list[Mount]]]:
    """Return fans of lidars in the plane, clipped to the lidar's range."""
    engine = simulation.engine
    found = []
    for unit in tuple(simulation.entities.sensors):
        model = unit.model
        if not isinstance(model, LidarModel) or not isinstance(engine, PlanarEngine):
            continue
        scanner = engine.caster(model.link, model.origins, model.directions).scanner
        old, reach = scanner.fan, model.lidar.range_max
        fan = Fan(old.start, old.step, old.count, reach, min(old.begin, 0.9 * reach))
        found.append((fan, scanner.mounts))
    return found
