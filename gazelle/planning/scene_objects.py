"""Objects around a robot, or held by it: shapes at poses under a name."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import ArrayLike

from gazelle.argument_checks import checked
from gazelle.description import (
    Box,
    Capsule,
    Cone,
    Cylinder,
    Ellipsoid,
    Geometry,
    Mesh,
    Pose,
    Sphere,
)
from gazelle.engines.collision import Shape
from gazelle.errors import PlanningError
from gazelle.formats import MeshData, Octree


@checked(PlanningError)
@dataclass(frozen=True, slots=True)
class SceneObject:
    """An object of one or more shapes.

    Attributes:
        name: Unique in its scene.
        shapes: With their poses in the object's frame.
        pose: Of the object: in the robot's frame, or in that of the link that holds it.
        type: Kind of object, for people.
        frames: Named frames of it, in its own.
        octree: Octree of its boxes, if any.
    """

    name: str
    shapes: tuple[tuple[Shape, Pose], ...]
    pose: Pose = field(default_factory=Pose)
    type: str = ""
    frames: tuple[tuple[str, Pose], ...] = ()
    octree: Octree | None = None


@checked(PlanningError)
@dataclass(frozen=True, slots=True)
class AttachedObject:
    """An object that moves with a link.

    Attributes:
        object: The object; its pose is in the link's frame.
        link: Link that holds it.
        touch_links: Links that it may touch, besides that one.
    """

    object: SceneObject
    link: str
    touch_links: frozenset[str] = frozenset()


def object_of(name: str, shapes: Shape | Iterable[tuple[Shape, Pose]], pose: Pose) -> SceneObject:
    """Return an object of one shape, or of several at poses.

    Raises:
        PlanningError: It has no name or no shape, or a length is not above zero.
    """
    if not name:
        raise PlanningError("an object of a planning scene needs a name")
    whole = isinstance(shapes, Iterable)
    parts = tuple(shapes) if isinstance(shapes, Iterable) else ((shapes, Pose()),)
    if whole and not parts:
        raise PlanningError(f"the object '{name}' has no shape")
    for shape, _ in parts:
        _check(name, shape)
    return SceneObject(name, parts, pose)


@checked(PlanningError)
def voxel_boxes(
    centres: ArrayLike, sizes: ArrayLike, pose: Pose | None = None
) -> tuple[tuple[Shape, Pose], ...]:
    """Return cubes, such as an octomap's occupied leaves.

    Args:
        centres: [m], shape (n, 3).
        sizes: Lengths of their edges [m], shape (n,).
        pose: Of the map in the object's frame.
    """
    at = Pose() if pose is None else pose
    places = np.asarray(centres, np.float64).reshape(-1, 3).tolist()
    edges = np.asarray(sizes, np.float64).reshape(-1).tolist()
    return tuple(
        (Box((edge, edge, edge)), at * Pose(*place))
        for place, edge in zip(places, edges, strict=True)
    )


def scaled(shape: Shape, factor: float) -> Shape:
    """Return a shape that is larger by a factor, about its own origin."""
    if isinstance(shape, MeshData):
        return MeshData(shape.vertices * factor, shape.faces)
    if isinstance(shape, Box):
        return Box(_three(shape.size, factor))
    if isinstance(shape, Ellipsoid):
        return Ellipsoid(_three(shape.radii, factor))
    if isinstance(shape, Sphere):
        return Sphere(shape.radius * factor)
    if isinstance(shape, Cylinder | Capsule | Cone):
        return replace(shape, radius=shape.radius * factor, length=shape.length * factor)
    if isinstance(shape, Mesh):
        return replace(shape, scale=_three(shape.scale, factor))
    return shape


def _three(values: Sequence[float], factor: float) -> tuple[float, float, float]:
    x, y, z = values
    return (x * factor, y * factor, z * factor)


def _check(name: str, shape: Shape) -> None:
    lengths: tuple[float, ...] = ()
    if isinstance(shape, Box):
        lengths = shape.size
    elif isinstance(shape, Sphere):
        lengths = (shape.radius,)
    elif isinstance(shape, Cylinder | Cone | Capsule):
        lengths = (shape.radius, shape.length)
    elif not isinstance(shape, Geometry | MeshData):
        raise PlanningError(
            f"a shape of the object '{name}' is {shape!r}",
            hint="shapes are those of gazelle.description (Box, Sphere, Cylinder, ...) or a MeshData",
        )
    if not all(0.0 < length < np.inf for length in lengths):
        kind = type(shape).__name__.lower()
        raise PlanningError(f"lengths of a {kind} of the object '{name}' must be above zero")
