"""Objects of a planning scene from and to ``moveit_msgs/CollisionObject``."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TypeVar

import numpy as np

from gazelle.bridges.conversions import pose_message, pose_of_message, set_point
from gazelle.description import Box, Cone, Cylinder, Plane, Pose, Sphere
from gazelle.engines.collision import Shape
from gazelle.errors import FormatError, PlanningError
from gazelle.formats import MeshData
from gazelle.planning import SceneObject
from gazelle.planning.scene_objects import object_of
from gazelle_ros.msgs import geometry_msgs, moveit_msgs, shape_msgs

_T = TypeVar("_T")
_BOX, _SPHERE, _CYLINDER, _CONE = 1, 2, 3, 4
_LENGTHS = {_BOX: 3, _SPHERE: 1, _CYLINDER: 2, _CONE: 2}

Shapes = tuple[tuple[Shape, Pose], ...]


def object_of_message(message: moveit_msgs.msg.CollisionObject, frame: Pose) -> SceneObject:
    """Convert a ``CollisionObject``.

    An object without a pose of its own and with one shape is where that is, as in MoveIt.

    Args:
        message: The ``CollisionObject``.
        frame: Its header's frame, in the one that the object shall be in.

    Raises:
        PlanningError: It has no name or no shape, or a shape is not known.
    """
    shapes, pose = shapes_of_message(message), pose_of_message(message.pose)
    if len(shapes) == 1 and _is_empty(message.pose):
        pose, shapes = shapes[0][1], ((shapes[0][0], Pose()),)
    if not all(
        np.isfinite([*each.position, *each.quaternion]).all()
        for each in (pose, *(at for _, at in shapes))
    ):
        raise PlanningError(f"a pose of the object '{message.id}' is not finite")
    made = object_of(message.id, shapes, frame * pose)
    names = zip(message.subframe_names, message.subframe_poses, strict=False)
    frames = tuple((name, pose_of_message(each)) for name, each in names)
    return replace(made, type=message.type.key, frames=frames)


def shapes_of_message(message: moveit_msgs.msg.CollisionObject) -> Shapes:
    """Return shapes of a ``CollisionObject`` at poses in its own frame.

    Raises:
        PlanningError: One is not known.
    """
    found: list[tuple[Shape, Pose]] = []
    for primitive, pose in _placed(message.primitives, message.primitive_poses):
        found.append((_primitive(primitive), pose))
    for mesh, pose in _placed(message.meshes, message.mesh_poses):
        found.append((_mesh(mesh), pose))
    for each, pose in _placed(message.planes, message.plane_poses):
        plane, offset = _plane(each)
        found.append((plane, pose * offset))
    return tuple(found)


def object_message(
    thing: SceneObject, frame: str, *, shapes: bool = True
) -> moveit_msgs.msg.CollisionObject:
    """Return a ``CollisionObject``.

    Args:
        thing: The object.
        frame: Frame of its pose.
        shapes: Whether to say more than its name and type.
    """
    message = moveit_msgs.msg.CollisionObject()
    message.header.frame_id, message.id, message.type.key = frame, thing.name, thing.type
    message.pose = pose_message(thing.pose)
    for shape, pose in thing.shapes if shapes else ():
        if isinstance(shape, MeshData):
            message.meshes.append(mesh_message(shape))
            message.mesh_poses.append(pose_message(pose))
        elif isinstance(shape, Plane):
            coefficients = [*map(float, shape.normal), 0.0]
            message.planes.append(shape_msgs.msg.Plane(coef=coefficients))
            message.plane_poses.append(pose_message(pose))
        else:
            message.primitives.append(_primitive_message(thing.name, shape))
            message.primitive_poses.append(pose_message(pose))
    for name, pose in thing.frames:
        message.subframe_names.append(name)
        message.subframe_poses.append(pose_message(pose))
    return message


def _placed(shapes: Sequence[_T], poses: Sequence[geometry_msgs.msg.Pose]) -> list[tuple[_T, Pose]]:
    """Return shapes with their poses; those without a pose are at the origin."""
    known = [pose_of_message(pose) for pose in poses]
    known += [Pose()] * (len(shapes) - len(known))
    return list(zip(shapes, known, strict=False))


def _is_empty(pose: geometry_msgs.msg.Pose) -> bool:
    place, turn = pose.position, pose.orientation
    return not any((place.x, place.y, place.z, turn.x, turn.y, turn.z, turn.w))


def _primitive(message: shape_msgs.msg.SolidPrimitive) -> Shape:
    lengths = list(message.dimensions)
    if len(lengths) != _LENGTHS.get(message.type):
        raise PlanningError(
            f"a shape of type {message.type} with {len(lengths)} lengths is not known",
            hint="boxes (1) have three, spheres (2) one, cylinders (3) and cones (4) height and radius",
        )
    if message.type == _BOX:
        return Box((lengths[0], lengths[1], lengths[2]))
    if message.type == _SPHERE:
        return Sphere(lengths[0])
    if message.type == _CYLINDER:
        return Cylinder(radius=lengths[1], length=lengths[0])
    return Cone(radius=lengths[1], length=lengths[0])


def _primitive_message(name: str, shape: Shape) -> shape_msgs.msg.SolidPrimitive:
    made = shape_msgs.msg.SolidPrimitive
    if isinstance(shape, Box):
        return made(type=_BOX, dimensions=list(shape.size))
    if isinstance(shape, Sphere):
        return made(type=_SPHERE, dimensions=[shape.radius])
    if isinstance(shape, Cylinder):
        return made(type=_CYLINDER, dimensions=[shape.length, shape.radius])
    if isinstance(shape, Cone):
        return made(type=_CONE, dimensions=[shape.length, shape.radius])
    raise PlanningError(f"a shape of '{name}' has no message: {type(shape).__name__}")


def _plane(message: shape_msgs.msg.Plane) -> tuple[Plane, Pose]:
    """Convert the plane ax + by + cz + d = 0 to one through an origin."""
    *normal, offset = message.coef
    length = float(np.linalg.norm(normal))
    if not 0.0 < length < np.inf:
        raise PlanningError(f"a plane has the normal {normal}")
    a, b, c = (float(value) / length for value in normal)
    away = -float(offset) / length
    return Plane((a, b, c)), Pose(a * away, b * away, c * away)


def _mesh(message: shape_msgs.msg.Mesh) -> MeshData:
    corners = [(point.x, point.y, point.z) for point in message.vertices]
    faces = [tuple(triangle.vertex_indices) for triangle in message.triangles]
    try:
        return MeshData(np.array(corners).reshape(-1, 3), np.array(faces, int).reshape(-1, 3))
    except FormatError as error:
        raise PlanningError(error.message) from error


def mesh_message(mesh: MeshData) -> shape_msgs.msg.Mesh:
    """Return a ``shape_msgs/Mesh``."""
    message = shape_msgs.msg.Mesh()
    triangle, point = shape_msgs.msg.MeshTriangle, geometry_msgs.msg.Point
    message.triangles = [triangle(vertex_indices=face) for face in mesh.faces.tolist()]
    for corner in mesh.vertices.tolist():
        made = point()
        set_point(made, corner)
        message.vertices.append(made)
    return message
