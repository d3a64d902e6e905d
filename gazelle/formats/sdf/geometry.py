"""``<geometry>``: one reader a shape, in the table ``SHAPES``."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

from gazelle.description import (
    Box,
    Capsule,
    Cone,
    Cylinder,
    Ellipsoid,
    Empty,
    Geometry,
    Heightmap,
    Image,
    Mesh,
    Parameters,
    Plane,
    Polyline,
    Sphere,
    Vector3,
)
from gazelle.formats import values
from gazelle.formats.extent import extent, replaced, scale
from gazelle.formats.limits import MAX_POINTS
from gazelle.formats.reading import Reading


def read_geometry(node: Parameters | None, reading: Reading) -> Geometry:
    """Read the first shape in a ``<geometry>``; Empty without any."""
    if node is not None:
        for child in node.children:
            reader = SHAPES.get(child.tag)
            if reader is read_polyline:
                return _polylines(list(node.find_all(child.tag)), reading)
            if reader is not None:
                return reader(child, reading)
    return Empty()


def _polylines(nodes: list[Parameters], reading: Reading) -> Polyline:
    """Return one shape of several outlines, if they have the same height."""
    shapes = [read_polyline(node, reading) for node in nodes]
    for node, shape in zip(nodes, shapes, strict=True):
        if shape.height != shapes[0].height:
            reading.note("all outlines of a shape get the height of the first", node)
    return Polyline(tuple(s.outlines[0] for s in shapes), shapes[0].height)


_ROUND = TypeVar("_ROUND", Cylinder, Capsule, Cone)


def _round(kind: type[_ROUND], node: Parameters, usual: float, reading: Reading) -> _ROUND:
    """Return a shape of a radius and a length."""
    radius, length = values.real(node, "radius", usual), values.real(node, "length", 1.0)
    return kind(
        extent(node, radius, "<radius>", reading),
        extent(node, length, "<length>", reading),
        file_lengths=replaced(radius, length),
    )


def _sides(node: Parameters, path: str, reading: Reading) -> tuple[Vector3, tuple[float, ...]]:
    """Return the used lengths along x, y, z, and those in the file if they differ."""
    sides = values.vector(node, path, (1.0, 1.0, 1.0))
    x, y, z = (extent(node, side, f"<{path}>", reading) for side in sides)
    return (x, y, z), replaced(*sides)


def read_box(node: Parameters, reading: Reading) -> Box:
    """Read ``<box><size>``."""
    sides, others = _sides(node, "size", reading)
    return Box(sides, file_lengths=others)


def read_sphere(node: Parameters, reading: Reading) -> Sphere:
    """Read ``<sphere><radius>``."""
    radius = values.real(node, "radius", 1.0)
    return Sphere(extent(node, radius, "<radius>", reading), file_lengths=replaced(radius))


def read_cylinder(node: Parameters, reading: Reading) -> Cylinder:
    """Read ``<cylinder><radius><length>``."""
    return _round(Cylinder, node, 1.0, reading)


def read_capsule(node: Parameters, reading: Reading) -> Capsule:
    """Read ``<capsule><radius><length>``."""
    return _round(Capsule, node, 0.5, reading)


def read_cone(node: Parameters, reading: Reading) -> Cone:
    """Read ``<cone><radius><length>``."""
    return _round(Cone, node, 1.0, reading)


def read_ellipsoid(node: Parameters, reading: Reading) -> Ellipsoid:
    """Read ``<ellipsoid><radii>``."""
    radii, others = _sides(node, "radii", reading)
    return Ellipsoid(radii, file_lengths=others)


def read_plane(node: Parameters, _: Reading) -> Plane:
    """Read ``<plane><normal><size>``."""
    normal = values.vector(node, "normal", (0.0, 0.0, 1.0))
    size = node.find("size")
    width, depth = (1.0, 1.0)
    if size is not None and size.text:
        width, depth = values.parse_reals(size, size.text, "<size>", 2)
    return Plane(values.unit(node.find("normal") or node, normal), (width, depth))


def read_mesh(node: Parameters, reading: Reading) -> Mesh:
    """Read ``<mesh><uri><scale><submesh>``; old files have ``<filename>`` for the URI."""
    uri = values.word(node, "uri") or values.word(node, "filename")
    if not uri:
        raise values.fail(node, "a <mesh> needs a <uri>")
    place = node.find("uri") or node.find("filename") or node
    return Mesh(
        uri=uri,
        path=reading.find(uri, place),
        scale=scale(node, values.vector(node, "scale", (1.0, 1.0, 1.0)), reading),
        submesh=values.word(node, "submesh/name") or None,
        center_submesh=values.flag(node, "submesh/center", default=False),
        source=place.source,
    )


_LOOKS = {"texture", "blend", "use_terrain_paging"}


def read_heightmap(node: Parameters, reading: Reading) -> Heightmap:
    """Read ``<heightmap><uri><size><pos><sampling>``; its textures are kept unread."""
    uri = values.word(node, "uri")
    return Heightmap(
        uri=uri,
        path=reading.find(uri, node.find("uri") or node),
        size=values.vector(node, "size", (1.0, 1.0, 1.0)),
        position=values.vector(node, "pos", (0.0, 0.0, 0.0)),
        sampling=values.whole(node, "sampling", 1),
        extras=tuple(child for child in node.children if child.tag in _LOOKS),
        source=node.source,
    )


def read_image(node: Parameters, reading: Reading) -> Image:
    """Read ``<image><uri><scale><threshold><height><granularity>``."""
    uri = values.word(node, "uri")
    return Image(
        uri=uri,
        path=reading.find(uri, node.find("uri") or node),
        scale=values.real(node, "scale", 1.0),
        threshold=values.whole(node, "threshold", 200),
        height=values.real(node, "height", 1.0),
        granularity=values.whole(node, "granularity", 1),
        source=node.source,
    )


def read_polyline(node: Parameters, _: Reading) -> Polyline:
    """Read ``<polyline><point>...<height>``."""
    points: list[tuple[float, float]] = []
    for child in node.find_all("point"):
        if len(points) == MAX_POINTS:
            raise values.fail(child, f"a polyline has at most {MAX_POINTS:,} points")
        x, y = values.parse_reals(child, child.text, "<point>", 2)
        points.append((x, y))
    return Polyline((tuple(points),), values.real(node, "height", 1.0))


def read_empty(_: Parameters, __: Reading) -> Empty:
    """Read ``<empty>``."""
    return Empty()


SHAPES: dict[str, Callable[[Parameters, Reading], Geometry]] = {
    "box": read_box,
    "capsule": read_capsule,
    "cone": read_cone,
    "cylinder": read_cylinder,
    "ellipsoid": read_ellipsoid,
    "empty": read_empty,
    "heightmap": read_heightmap,
    "image": read_image,
    "mesh": read_mesh,
    "plane": read_plane,
    "polyline": read_polyline,
    "sphere": read_sphere,
}
