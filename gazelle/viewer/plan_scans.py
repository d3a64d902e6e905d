"""What the rangers and lidars of a world in the plane look at, for pictures."""

# ruff: noqa: SLF001  # pictures see what sensors see, and draw none of their random numbers

from __future__ import annotations

import math

from gazelle.engines.planar import Fleet, Mount, PlanarEngine, Scanner
from gazelle.engines.planar.fans import Fan
from gazelle.sensors import LidarModel
from gazelle.simulation import Simulation
from gazelle.simulation.stage import StageSimulation


class PictureScanner(Scanner):
    """A scanner that remembers where its fans are."""

    mounts: list[Mount]


def scanners_of(simulation: Simulation | StageSimulation, fleet: Fleet) -> list[PictureScanner]:
    """Scanners without noise, with the beams of all rangers and lidars."""
    if isinstance(simulation, StageSimulation):
        pairs = list(zip(simulation._fans, simulation._mounts, strict=True))
    else:
        pairs = _lidars(simulation)
    made = []
    for fan, mounts in pairs:
        scanner = PictureScanner(fleet, fan, mounts)
        scanner.mounts = list(mounts)
        made.append(scanner)
    return made


def _lidars(simulation: Simulation) -> list[tuple[Fan, list[Mount]]]:
    """Fans of lidars in the plane, cut where the lidar sees no farther."""
    engine = simulation.engine
    found = []
    for robot in simulation.robots.values():
        for sensor in robot.sensors.values():
            model = sensor.model
            if not isinstance(model, LidarModel) or not isinstance(engine, PlanarEngine):
                continue
            engine.cast_rays(model._link, model._origins, model._directions)
            key = (model._link, model._origins.tobytes(), model._directions.tobytes())
            scanner = engine._casters[key][0].scanner
            old, reach = scanner.fan, model.lidar.range_max
            fan = Fan(old.start, old.step, old.count, reach, min(old.begin, 0.9 * reach))
            bodies = scanner._carriers.tolist()
            mounts = [
                Mount(body, x, y, _angle(cos, sin), z)
                for body, (x, y, cos, sin, z) in zip(bodies, scanner._mounts.tolist(), strict=True)
            ]
            found.append((fan, mounts))
    return found


def _angle(cos: float, sin: float) -> float:
    return math.atan2(sin, cos)
