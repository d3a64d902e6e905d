"""Markers on a page, as RViz draws them."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np

from gazelle.array_types import Bytes, Floats
from gazelle.description import Link, Mesh, Model, Visual, World
from gazelle.errors import GazelleWarning
from gazelle.formats.resolve import Resolver
from gazelle.rendering import columns as c
from gazelle.rendering.visible import visible_world
from gazelle.rotations import rotate
from gazelle.viewer.graph.drawing import Drawing, pose_of
from gazelle_ros.msgs import std_msgs, visualization_msgs

# Types of visualization_msgs/Marker.
_ARROW, _CUBE, _SPHERE, _CYLINDER, _STRIP, _LIST = 0, 1, 2, 3, 4, 5
_CUBES, _SPHERES, _POINTS, _TEXT = 6, 7, 8, 9
_MESH, _TRIANGLES = 10, 11
_DELETE, _DELETE_ALL = 2, 3


def draw_marker(drawing: Drawing, message: visualization_msgs.msg.Marker) -> None:
    """Draw a Marker: added, changed or deleted."""
    key = f"{message.ns or 'marker'}_{message.id}".replace("/", "_")
    if message.action == _DELETE_ALL:
        drawing.clear()
    elif message.action == _DELETE:
        drawing.drop(key)
    else:
        _add(drawing, key, message)
        drawing.span(key, _reach(message))


def _add(drawing: Drawing, key: str, message: visualization_msgs.msg.Marker) -> None:
    scene: Any = drawing.page.scene
    color = _color(message.color)
    at, turned = pose_of(message.pose)
    place = {"position": at, "wxyz": turned}
    size = np.array([message.scale.x, message.scale.y, message.scale.z])
    points, colors = _points(message), _colors(message)
    kind = message.type
    if kind in (_CUBE, _SPHERE, _CYLINDER):
        mesh = _solid(kind, size, message.color)
        drawing.put(key, lambda name: scene.add_mesh_trimesh(name, mesh, **place))
    elif kind == _TEXT:
        drawing.put(key, lambda name: scene.add_label(name, message.text, **place))
    elif kind == _ARROW:
        ends = points[:2] if len(points) > 1 else np.array([[0, 0, 0], [size[0], 0, 0]], np.float64)
        wide = float(size[0] if len(points) > 1 else size[1]) or 0.02
        drawing.put(key, lambda name: scene.add_arrows(
            name, ends[None].astype(np.float32), color, shaft_radius=wide / 2.0,
            head_radius=wide, head_length=2.0 * wide, **place,
        ))  # fmt: skip
    elif kind in (_STRIP, _LIST) and len(points) > 1:
        pairs = (
            np.stack((points[:-1], points[1:]), axis=1)
            if kind == _STRIP
            else points[: len(points) // 2 * 2].reshape(-1, 2, 3)
        )
        drawing.put(key, lambda name: scene.add_line_segments(
            name, pairs.astype(np.float32), color, thickness=3.0, thickness_units="screen", **place
        ))  # fmt: skip
    elif kind in (_CUBES, _SPHERES, _POINTS) and len(points):
        shape = "square" if kind == _CUBES else "circle"
        drawing.put(key, lambda name: scene.add_point_cloud(
            name, points, colors, point_size=float(size[0]) or 0.02, point_shape=shape,
            precision="float32", **place,
        ))  # fmt: skip
    elif kind == _MESH:
        _put_mesh(drawing, key, message, place)
    elif kind == _TRIANGLES and len(points) > 2:
        mesh = _triangles(points * np.where(size > 0.0, size, 1.0), colors, message.color)
        drawing.put(key, lambda name: scene.add_mesh_trimesh(name, mesh, **place))
    elif kind > _TRIANGLES:
        text = f"markers of type {kind} are not drawn"
        warnings.warn(GazelleWarning(text), stacklevel=2)


def draw_markers(drawing: Drawing, message: visualization_msgs.msg.MarkerArray) -> None:
    """Draw a MarkerArray."""
    for marker in message.markers:
        draw_marker(drawing, marker)


def _put_mesh(
    drawing: Drawing, key: str, message: visualization_msgs.msg.Marker, place: dict[str, Any]
) -> None:
    """Draw a mesh file in the marker's colour, or in its own where the marker requests it."""
    import trimesh

    uri = message.mesh_resource
    path = Resolver().find(uri)
    if path is None:
        drawing.drop(key)
        text = f"the mesh '{uri}' of a marker was not found"
        warnings.warn(GazelleWarning(text), stacklevel=2)
        return
    scale = (message.scale.x, message.scale.y, message.scale.z)
    link = Link("mesh", visuals=(Visual("mesh", geometry=Mesh(uri, path=path, scale=scale)),))
    seen = visible_world(World(models=(Model("marker", links=(link,)),)))
    shapes = seen.shapes
    vertices, faces = np.asarray(shapes.vertices), np.asarray(shapes.faces)
    meshes, parts = np.asarray(shapes.meshes), np.asarray(shapes.parts)
    pieces = []
    for number, part in enumerate(parts):
        row = meshes[part[c.MESH_OF_PART]]
        own = vertices[row[c.FIRST_VERTEX] : row[c.LAST_VERTEX]]
        piece = trimesh.Trimesh(own, faces[row[c.FIRST_FACE] : row[c.LAST_FACE]], process=False)
        color = np.asarray(shapes.color)[number] * 255.0
        if not message.mesh_use_embedded_materials:
            color = np.array(_color(message.color), np.float64)
        piece.visual.face_colors = [*np.rint(color).astype(int).tolist(), 255]
        pieces.append(piece)
    whole = trimesh.util.concatenate(pieces)
    scene: Any = drawing.page.scene
    drawing.put(key, lambda name: scene.add_mesh_trimesh(name, whole, **place))


def _triangles(points: Floats, colors: Bytes, color: std_msgs.msg.ColorRGBA) -> Any:
    """Return every three points as a triangle, seen from both sides, with colours."""
    import trimesh

    count = len(points) // 3 * 3
    faces = np.arange(count).reshape(-1, 3)
    mesh = trimesh.Trimesh(points[:count], np.vstack((faces, faces[:, ::-1])), process=False)
    tones = colors[:count] if colors.ndim > 1 else np.tile(_color(color), (count, 1))
    mesh.visual.vertex_colors = np.column_stack((tones, np.full(count, 255))).astype(np.uint8)
    return mesh


def _solid(kind: int, size: Floats, color: std_msgs.msg.ColorRGBA) -> Any:
    import trimesh

    if kind == _CUBE:
        mesh = trimesh.creation.box((1.0, 1.0, 1.0))
    elif kind == _SPHERE:
        mesh = trimesh.creation.icosphere(subdivisions=2, radius=0.5)
    else:
        mesh = trimesh.creation.cylinder(radius=0.5, height=1.0, sections=24)
    mesh.apply_scale(np.maximum(size, 1e-6))
    tone = trimesh.visual.material.PBRMaterial(
        baseColorFactor=[*_color(color), int(np.clip(color.a, 0.0, 1.0) * 255)],
        alphaMode="BLEND" if color.a < 1.0 else "OPAQUE",
        metallicFactor=0.0,
        roughnessFactor=0.9,
    )
    mesh.visual = trimesh.visual.TextureVisuals(material=tone)
    return mesh


def _reach(message: visualization_msgs.msg.Marker) -> Floats:
    """Return the outermost points of a marker in its frame [m], shape (n, 3)."""
    at, turned = pose_of(message.pose)
    half = np.array([message.scale.x, message.scale.y, message.scale.z]) / 2.0
    points = _points(message)
    around = points if len(points) else np.array([-half, half])
    return at + rotate(np.roll(turned, -1)[None], around)


def _points(message: visualization_msgs.msg.Marker) -> Floats:
    return np.array([[p.x, p.y, p.z] for p in message.points], np.float64).reshape(-1, 3)


def _color(color: std_msgs.msg.ColorRGBA) -> tuple[int, int, int]:
    red, green, blue = (np.clip((color.r, color.g, color.b), 0.0, 1.0) * 255).astype(int).tolist()
    return red, green, blue


def _colors(message: visualization_msgs.msg.Marker) -> Bytes:
    own = getattr(message, "colors", ())
    if len(own) == len(message.points) > 0:
        return np.array([_color(each) for each in own], np.uint8)
    return np.array(_color(message.color), np.uint8)
