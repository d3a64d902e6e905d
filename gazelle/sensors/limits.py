"""Limits of a sensor's description."""

from __future__ import annotations

from collections.abc import Iterator

from gazelle.argument_checks import world_indices
from gazelle.array_types import Worlds
from gazelle.description import Scan, Sensor
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
    for what, count, most in _counts(sensor):
        if not count <= most:
            raise SimulationError(
                f"sensor '{name}' has {count:.4g} {what}, more than the limit of {most:,}",
                source=sensor.source,
            )
        if not count * nworld <= MAX_VALUES:
            raise SimulationError(
                f"sensor '{name}' has {count:.4g} {what} in each of {nworld} worlds, more than the "
                f"limit of {MAX_VALUES:,} in all of them",
                source=sensor.source,
            )


def check_worlds(worlds: Worlds | None, nworld: int) -> None:
    """Check the worlds that a sensor measures in.

    Raises:
        SimulationError: They are more than there are, or one is not there.
    """
    if worlds is not None and len(world_indices(worlds, nworld, SimulationError)) > nworld:
        raise SimulationError(f"a sensor measures in {nworld} worlds, not in {len(worlds)}")


def _counts(sensor: Sensor) -> Iterator[tuple[str, float, int]]:
    """Yield the name, the number and the limit of each counted quantity."""
    if sensor.lidar is not None:
        yield "rays", _rays(sensor.lidar.horizontal) * _rays(sensor.lidar.vertical), MAX_RAYS
    for camera in sensor.cameras:
        yield "pixels", _float(camera.width) * _float(camera.height), MAX_PIXELS


def _rays(scan: Scan) -> float:
    return max(1.0, abs(_float(scan.samples) * scan.resolution))


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
