"""Find a robot's lidar and fit it to the number of rays that a task reads."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from dataclasses import dataclass, replace

from gazelle.description import Lidar, Model, Sensor
from gazelle.description.source import Source
from gazelle.errors import GazelleWarning, TaskError


@dataclass(frozen=True, slots=True)
class FittedLidar:
    """A robot with a lidar of the rays that a task reads.

    Attributes:
        model: The robot.
        sensor: Name of the lidar's sensor.
        lidar: The lidar.
    """

    model: Model
    sensor: str
    lidar: Lidar


def fit_lidar(model: Model, samples: int, *, notice: bool) -> FittedLidar:
    """Set the first planar lidar of a robot to exactly ``samples`` rays over its fan.

    The TurtleBot3 manual has its users edit ``<samples>`` from 360 to 24 in the robot's
    file; this does the same to the description. The rays that are left start at the same
    first and end at the same last angle, evenly spread, and only they are cast.

    Args:
        model: The robot.
        samples: Rays the task reads.
        notice: Warn when the file says another number.

    Raises:
        TaskError: The robot has no lidar, or one with several rows or fewer rays; the
            error names the file that says so.
    """
    sensor, lidar = _first_lidar(model)
    rays = _rays_of(lidar)
    _check_shape(sensor, lidar, rays, samples)
    if rays == samples:
        return FittedLidar(model, sensor.name, lidar)
    if notice:
        where = _place(sensor.source)
        warnings.warn(
            GazelleWarning(
                f"the lidar '{sensor.name}'{where} has {rays} rays and the task reads {samples}: "
                f"{samples} rays are cast, over the same angles"
            ),
            stacklevel=2,
        )
    fan = replace(lidar.horizontal, samples=samples, resolution=1.0)
    fitted = replace(lidar, horizontal=fan)
    return FittedLidar(_put(model, sensor, replace(sensor, lidar=fitted)), sensor.name, fitted)


def every_nth_ray(model: Model, nth: int) -> FittedLidar:
    """Reduce the first planar lidar of a robot to ray 0, ``nth``, 2 ``nth`` and so on.

    They look where they did, so a task that reads only these gets the same numbers.

    Args:
        model: The robot.
        nth: 1 or more.

    Raises:
        TaskError: The robot has no lidar, or one with several rows.
    """
    sensor, lidar = _first_lidar(model)
    fan, rays = lidar.horizontal, _rays_of(lidar)
    _check_shape(sensor, lidar, rays, 1)
    samples = (rays - 1) // nth + 1
    share = (samples - 1) * nth / max(rays - 1, 1)
    last = fan.min_angle + share * (fan.max_angle - fan.min_angle)
    kept = replace(fan, samples=samples, resolution=1.0, max_angle=last)
    fitted = replace(lidar, horizontal=kept)
    return FittedLidar(_put(model, sensor, replace(sensor, lidar=fitted)), sensor.name, fitted)


def _first_lidar(model: Model) -> tuple[Sensor, Lidar]:
    sensor = next(_lidars(model), None)
    if sensor is None or sensor.lidar is None:
        raise TaskError(
            f"the robot '{model.name}' has no lidar, which this task needs",
            source=model.source,
            hint="add a <sensor type='ray'>, or use another robot",
        )
    return sensor, sensor.lidar


def _rays_of(lidar: Lidar) -> int:
    return max(1, round(lidar.horizontal.samples * lidar.horizontal.resolution))


def _check_shape(sensor: Sensor, lidar: Lidar, rays: int, samples: int) -> None:
    if lidar.vertical.samples != 1:
        raise TaskError(
            f"the lidar '{sensor.name}' has {lidar.vertical.samples} rows, and this task needs one",
            source=sensor.source,
            hint="set <vertical><samples> to 1",
        )
    if rays < samples:
        raise TaskError(
            f"the lidar '{sensor.name}' has {rays} rays, and this task reads {samples}",
            source=sensor.source,
            hint=f"set <samples> to {samples} or more, or lidar_samples={rays}",
        )


def _place(source: Source | None) -> str:
    if source is None or source.file is None:
        return ""
    return f" ({source.file}:{source.line})" if source.line else f" ({source.file})"


def _lidars(model: Model) -> Iterator[Sensor]:
    for placed in model.walk():
        for link in placed.model.links:
            for sensor in link.sensors:
                if sensor.lidar is not None:
                    yield sensor


def _put(model: Model, old: Sensor, new: Sensor) -> Model:
    """Return the model with one sensor in place of another."""
    links = tuple(
        replace(link, sensors=tuple(new if sensor is old else sensor for sensor in link.sensors))
        if any(sensor is old for sensor in link.sensors)
        else link
        for link in model.links
    )
    nested = tuple(_put(inner, old, new) for inner in model.models)
    return replace(model, links=links, models=nested)
