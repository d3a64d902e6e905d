"""Limits of a sensor's description."""

from __future__ import annotations

from gazelle.argument_checks import world_indices
from gazelle.array_types import Worlds
from gazelle.description import Lidar, Scan, Sensor, Source
from gazelle.engines.limits import MAX_RAYS, MAX_VALUES
from gazelle.errors import SimulationError

MAX_PIXELS = 1 << 26
"""Of one camera: 8192 by 8192."""


def check_sensor(sensor: Sensor, name: str, nworld: int) -> None:
    """Check that a sensor's measurements fit into memory.

    Args:
        sensor: The sensor.
        name: Its scoped name.
        nworld: Number of worlds that it measures in.

    Raises:
        SimulationError: It has too many rays or pixels.
    """
    if sensor.lidar is not None:
        check_rays(sensor.lidar, name, nworld, sensor.source)
    for camera in sensor.cameras:
        pixels = _float(camera.width) * _float(camera.height)
        _check_count("pixels", pixels, MAX_PIXELS, name, nworld, sensor.source)


def check_rays(lidar: Lidar, name: str, nworld: int, source: Source | None = None) -> None:
    """Check that the measurements of a lidar fit into memory.

    Args:
        lidar: Settings of the file.
        name: Scoped name of the sensor.
        nworld: Number of worlds that it measures in.
        source: Its place in the file.

    Raises:
        SimulationError: It has too many rays.
    """
    rays = _rays(lidar.horizontal) * _rays(lidar.vertical)
    _check_count("rays", rays, MAX_RAYS, name, nworld, source)


def check_worlds(worlds: Worlds | None, nworld: int) -> None:
    """Check the worlds that a sensor measures in.

    Raises:
        SimulationError: They are more than there are, or one is not there.
    """
    if worlds is not None and len(world_indices(worlds, nworld, SimulationError)) > nworld:
        raise SimulationError(f"a sensor measures in {nworld} worlds, not in {len(worlds)}")


def _check_count(
    what: str, count: float, most: int, name: str, nworld: int, source: Source | None
) -> None:
    if not count <= most:
        raise SimulationError(
            f"sensor '{name}' has {count:.4g} {what}, more than the limit of {most:,}",
            source=source,
        )
    if not count * nworld <= MAX_VALUES:
        raise SimulationError(
            f"sensor '{name}' has {count:.4g} {what} in each of {nworld} worlds, more than the "
            f"limit of {MAX_VALUES:,} in all of them",
            source=source,
        )


def _rays(scan: Scan) -> float:
    return max(1.0, abs(_float(scan.samples) * float(scan.resolution)))


def _float(count: int) -> float:
    return float(min(count, 10**18))


def check_interval(interval: float) -> None:
    """Check the time between two measurements: a drift would be NaN for ever after NaN.

    Raises:
        SimulationError: It is below 0 s, or NaN.
    """
    if not interval >= 0.0:
        raise SimulationError(
            f"the time since the last measurement must be 0 s or more, not {interval!r:.60}"
        )
