"""Things in plain colours that no lamp changes, as simple simulators draw them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from gazelle.argument_checks import checked
from gazelle.description import Color, Empty, Material, Pose, Scene, Visual, World
from gazelle.errors import EngineError
from gazelle.geometry.triangles import TriangleMesh
from gazelle.rendering.surface_materials import SurfaceMaterial
from gazelle.rendering.visible import GatheredShapes, VisiblePart, VisibleWorld, rows_of

_BLACK = (0.0, 0.0, 0.0)


@checked(EngineError)
@dataclass(frozen=True, slots=True)
class PaintedPart:
    """Triangles of one colour.

    Attributes:
        link: Number of the link that they are on.
        mesh: In the link's frame; parts of equal shape may share it, which is held once.
        color: Red, green and blue, 0 to 1, as pictures show it.
    """

    link: int
    mesh: TriangleMesh
    color: tuple[float, float, float]


@checked(EngineError)
def painted_world(links: Sequence[str], parts: Iterable[PaintedPart]) -> VisibleWorld:
    """Return the visible world of links that are all at the origin at first.

    Args:
        links: Their names.
        parts: Parts of the triangles, by which labels count.
    """
    gathered, numbers = GatheredShapes(), dict[int, int]()
    found, held = [], []
    for label, part in enumerate(parts):
        if not 0 <= part.link < len(links):
            raise EngineError(f"part {label} is on link {part.link}, and there are {len(links)}")
        key = id(part.mesh)
        if key not in numbers:
            numbers[key] = gathered.add_mesh(part.mesh)
            held.append(part.mesh)  # as long as its id is in use
        material = SurfaceMaterial(_BLACK, part.color)
        gathered.add_part(numbers[key], material, part.link, label)
        paint = Material(diffuse=(*_BLACK, 1.0), emissive=(*part.color, 1.0))
        found.append(VisiblePart(links[part.link], Visual("paint", Empty(), material=paint)))
    pose = Pose()
    rest = np.tile(rows_of(np.asarray(pose.position), np.asarray(pose.quaternion)), (len(links), 1))
    return VisibleWorld(tuple(links), tuple(found), gathered.drawn(), rest)


@checked(EngineError)
def plain_surroundings(background: Color) -> World:
    """Return an empty world with a background of one colour."""
    return World(scene=Scene(ambient=(*_BLACK, 1.0), background=background))
