"""Checks of sensors that cannot see their surroundings."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from gazelle.description import (
    Box,
    Collision,
    Cylinder,
    Lidar,
    Link,
    Mesh,
    Pose,
    Sensor,
    Sphere,
    World,
)
from gazelle.errors import Error
from gazelle.formats.lint.diagnostic import Diagnostic, links_of

_MOST_RAYS = 100_000

# Directions in which a lidar within a mesh is checked for an exit.
_LOOKS = 12


def lint(world: World) -> Iterator[Diagnostic]:
    """Yield findings on every sensor."""
    for place in links_of(world):
        for sensor in place.link.sensors:
            name = f"{place.scope}::{place.link.name}::{sensor.name}"
            if sensor.lidar is not None:
                yield from _lidar(name, sensor, sensor.lidar)
                yield from _inside(name, sensor, sensor.lidar, place.link)
            yield from _cameras(name, sensor)


def _lidar(name: str, sensor: Sensor, lidar: Lidar) -> Iterator[Diagnostic]:
    if lidar.range_max <= lidar.range_min:
        yield Diagnostic(
            "lidar-range",
            f"lidar '{name}': its largest range {lidar.range_max:g} m is not above its "
            f"smallest {lidar.range_min:g} m",
            "it can measure nothing",
            "set <range><max> above <min>",
            sensor.source,
        )
    rays = lidar.horizontal.samples * max(lidar.vertical.samples, 1)
    if rays > _MOST_RAYS:
        yield Diagnostic(
            "lidar-rays",
            f"lidar '{name}' casts {rays:,} rays a measurement",
            "each costs time; real scanners of this size are rare",
            "check <samples>, or lower <update_rate>",
            sensor.source,
        )
    if sensor.update_rate == 0.0:
        yield Diagnostic(
            "lidar-rate",
            f"lidar '{name}' has no <update_rate>, so it measures at every physics step",
            "real ones measure 5 to 40 times a second; this costs a hundred times as much",
            "give it an <update_rate>",
            sensor.source,
        )


def _inside(name: str, sensor: Sensor, lidar: Lidar, link: Link) -> Iterator[Diagnostic]:
    """Yield findings on obstacles nearer than the smallest range, which rays do not see."""
    for collision in link.collisions:
        reach = _reach_from(sensor, collision)
        if reach is not None and reach > lidar.range_min:
            yield Diagnostic(
                "lidar-inside",
                f"lidar '{name}' is inside the collision '{collision.name}' of its own link, "
                f"which reaches {reach:.3g} m from it; its smallest range is {lidar.range_min:g} m",
                "it sees its own housing instead of the world",
                "raise <range><min>, shrink the collision, or move the sensor out of it",
                sensor.source,
            )


def _reach_from(sensor: Sensor, collision: Collision) -> float | None:
    """Return the horizontal reach of a collision around the sensor; None if it is outside."""
    place = collision.pose.inverse() * sensor.pose
    x, y, z = place.position
    shape = collision.geometry
    if isinstance(shape, Mesh):
        return _reach_in_mesh(shape, place)
    if isinstance(shape, Box):
        half = tuple(side / 2.0 for side in shape.size)
        if all(abs(p) < h for p, h in zip((x, y, z), half, strict=True)):
            return min(half[0] - abs(x), half[1] - abs(y))
    elif isinstance(shape, Cylinder):
        if abs(z) < shape.length / 2.0 and math.hypot(x, y) < shape.radius:
            return shape.radius - math.hypot(x, y)
    elif isinstance(shape, Sphere):
        distance = math.sqrt(x * x + y * y + z * z)
        if distance < shape.radius:
            return shape.radius - distance
    return None


def _reach_in_mesh(shape: Mesh, place: Pose) -> float | None:
    """Return the horizontal reach of the mesh around a sensor; None where it is open to a side."""
    from gazelle.formats.mesh import load_mesh
    from gazelle.geometry.surface import clean

    if shape.path is None:
        return None
    try:
        data = load_mesh(shape)
    except Error:
        return None  # reported by the reader of the mesh
    low, high = data.bounds
    if not ((low < place.position) & (place.position < high)).all():
        return None
    angles = np.arange(_LOOKS) * 2.0 * np.pi / _LOOKS
    level = np.stack([np.cos(angles), np.sin(angles), np.zeros(_LOOKS)], axis=1)
    directions = level @ place.matrix()[:3, :3].T
    origins = np.tile(place.position, (_LOOKS, 1))
    distance, _ = clean(data.vertices, data.faces).rays.first_hits(origins, directions)
    farthest = float(distance.max())
    return farthest if math.isfinite(farthest) else None


def _cameras(name: str, sensor: Sensor) -> Iterator[Diagnostic]:
    for camera in sensor.cameras:
        if camera.far <= camera.near:
            yield Diagnostic(
                "camera-clip",
                f"camera '{name}': its far clip {camera.far:g} m is not beyond its near clip "
                f"{camera.near:g} m",
                "it can see nothing",
                "set <clip><far> above <near>",
                sensor.source,
            )
        if not 0.0 < camera.horizontal_fov < math.pi and sensor.type != "wideanglecamera":
            yield Diagnostic(
                "camera-fov",
                f"camera '{name}': a field of view of {camera.horizontal_fov:g} rad is none of a "
                "pinhole camera",
                "the picture cannot be projected onto a plane",
                "give <horizontal_fov> in radians, between 0 and 3.14",
                sensor.source,
            )
