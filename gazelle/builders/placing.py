"""Placement of models: free places that keep away from zones and from one another."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise, product

from gazelle.argument_checks import checked
from gazelle.builders.errors import BuildError, positive
from gazelle.description import (
    Box,
    Capsule,
    Cone,
    Cylinder,
    Ellipsoid,
    Geometry,
    Model,
    Plane,
    Polyline,
    Pose,
    Sphere,
    Vector3,
)
from gazelle.streams import Stream

_TRIES = 400


@checked(BuildError)
@dataclass(frozen=True, slots=True)
class Disc:
    """A round zone of the ground: centre and radius [m]."""

    x: float = 0.0
    y: float = 0.0
    radius: float = 1.0

    def distance(self, x: float, y: float) -> float:
        """Return the distance from a point to the zone [m]; not above 0 inside."""
        return math.hypot(x - self.x, y - self.y) - self.radius


@checked(BuildError)
@dataclass(frozen=True, slots=True)
class Rectangle:
    """A rectangular zone of the ground: centre, full lengths [m] and turn [rad]."""

    x: float = 0.0
    y: float = 0.0
    length: float = 10.0
    width: float = 10.0
    yaw: float = 0.0

    def distance(self, x: float, y: float) -> float:
        """Return the distance from a point to the zone [m]; not above 0 inside."""
        cosine, sine = math.cos(self.yaw), math.sin(self.yaw)
        dx, dy = x - self.x, y - self.y
        along = abs(cosine * dx + sine * dy) - self.length / 2.0
        across = abs(cosine * dy - sine * dx) - self.width / 2.0
        outside = math.hypot(max(along, 0.0), max(across, 0.0))
        return outside or max(along, across)

    def point(self, u: float, v: float) -> tuple[float, float]:
        """Return the point (x, y) [m] at fractions u along its length and v along its width."""
        dx, dy = (u - 0.5) * self.length, (v - 0.5) * self.width
        cosine, sine = math.cos(self.yaw), math.sin(self.yaw)
        return (self.x + cosine * dx - sine * dy, self.y + sine * dx + cosine * dy)


Zone = Disc | Rectangle


@checked(BuildError)
@dataclass(frozen=True, slots=True)
class Place:
    """A free place: position [m], turn [rad], and the radius [m] that is free around it."""

    x: float
    y: float
    yaw: float
    radius: float


@checked(BuildError)
def scatter(
    radii: Sequence[float],
    area: Rectangle,
    stream: Stream,
    *,
    keep_clear: Iterable[Zone] = (),
    gap: float = 0.0,
) -> list[Place]:
    """Return random places for discs that overlap neither one another nor a zone.

    The largest are placed first; the places come back in the order of the radii.

    Args:
        radii: Of the discs [m].
        area: The discs lie wholly inside.
        stream: Random numbers, of one world.
        keep_clear: Zones that no disc touches.
        gap: Least distance between discs, and from zones [m].

    Raises:
        BuildError: There is no room for all of them.
    """
    zones = tuple(keep_clear)
    found: dict[int, Place] = {}
    for index in sorted(range(len(radii)), key=lambda i: -radii[i]):
        radius = positive(radii[index], "the radius of a place")
        taken = tuple(Disc(place.x, place.y, place.radius) for place in found.values())
        place = _free(radius, area, stream, zones + taken, gap)
        if place is None:
            raise BuildError(
                f"only {len(found)} of {len(radii)} things found room in "
                f"{area.length:g} m x {area.width:g} m",
                hint="ask for fewer or smaller ones, a larger area, or a smaller gap",
            )
        found[index] = place
    return [found[index] for index in range(len(radii))]


def _free(
    radius: float, area: Rectangle, stream: Stream, zones: Sequence[Zone], gap: float
) -> Place | None:
    inner = Rectangle(
        area.x, area.y, area.length - 2.0 * radius, area.width - 2.0 * radius, area.yaw
    )
    if inner.length < 0.0 or inner.width < 0.0:
        return None
    for u, v, turn in stream.uniform(3 * _TRIES)[0].reshape(-1, 3).tolist():
        x, y = inner.point(u, v)
        if all(zone.distance(x, y) >= radius + gap for zone in zones):
            return Place(x, y, turn * 2.0 * math.pi, radius)
    return None


@checked(BuildError)
def footprints(model: Model) -> list[Rectangle]:
    """Return the footprint of each of a model's collisions as a rectangle; planes are left out.

    Exact for upright boxes; other shapes and tilts get a rectangle around them. A mesh,
    heightmap or image, whose size is not known here, counts as a metre.
    """
    return [
        _footprint(placed.pose * link.pose * collision.pose, collision.geometry)
        for placed in model.walk()
        for link in placed.model.links
        for collision in link.collisions
        if not isinstance(collision.geometry, Plane)
    ]


@checked(BuildError)
def along(
    points: Sequence[tuple[float, float]], width: float, pose: Pose | None = None
) -> list[Zone]:
    """Return zones that cover a strip of that width [m] along a line.

    Its points are in a frame at ``pose``.
    """
    frame = pose or Pose()
    line = [frame.apply((x, y, 0.0))[:2] for x, y in points]
    strips = [
        Rectangle(
            (x0 + x1) / 2.0,
            (y0 + y1) / 2.0,
            math.hypot(x1 - x0, y1 - y0),
            width,
            math.atan2(y1 - y0, x1 - x0),
        )
        for (x0, y0), (x1, y1) in pairwise(line)
    ]
    return [*strips, *(Disc(x, y, width / 2.0) for x, y in line)]


def _footprint(pose: Pose, shape: Geometry) -> Rectangle:
    yaw = pose.yaw
    upright = Pose(yaw=yaw).inverse() * Pose.from_quaternion((0.0, 0.0, 0.0), pose.quaternion)
    low, high = _bounds(shape)
    corners = [upright.apply(corner) for corner in product(*zip(low, high, strict=True))]
    xs, ys = [corner[0] for corner in corners], [corner[1] for corner in corners]
    middle = Pose(pose.x, pose.y, yaw=yaw).apply(
        ((min(xs) + max(xs)) / 2.0, (min(ys) + max(ys)) / 2.0, 0.0)
    )
    return Rectangle(middle[0], middle[1], max(xs) - min(xs), max(ys) - min(ys), yaw)


def _bounds(shape: Geometry) -> tuple[Vector3, Vector3]:
    """Return lower and upper corner of the box around a shape, in its frame [m]."""
    if isinstance(shape, Polyline):
        points = [point for outline in shape.outlines for point in outline] or [(0.0, 0.0)]
        xs, ys = [x for x, _ in points], [y for _, y in points]
        return (min(xs), min(ys), 0.0), (max(xs), max(ys), shape.height)
    x, y, z = _half_size(shape)
    return (-x, -y, -z), (x, y, z)


def _half_size(shape: Geometry) -> Vector3:
    if isinstance(shape, Box):
        x, y, z = shape.size
        return (x / 2.0, y / 2.0, z / 2.0)
    if isinstance(shape, Ellipsoid):
        return shape.radii
    if isinstance(shape, Sphere):
        return (shape.radius, shape.radius, shape.radius)
    if isinstance(shape, Capsule):
        return (shape.radius, shape.radius, shape.length / 2.0 + shape.radius)
    if isinstance(shape, Cylinder | Cone):
        return (shape.radius, shape.radius, shape.length / 2.0)
    return (0.5, 0.5, 0.5)
