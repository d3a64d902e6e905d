"""Random obstacles, trees and rocks: seeded, apart from one another, away from zones."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from typing import Literal, get_args

from gazelle.argument_checks import checked
from gazelle.builders.errors import BuildError
from gazelle.builders.limits import MAX_THINGS
from gazelle.builders.nature import bush, rock, tree
from gazelle.builders.paint import Paint
from gazelle.builders.placing import Place, Rectangle, Zone, scatter
from gazelle.builders.solids import box, cylinder, sphere
from gazelle.description import Model, Pose
from gazelle.errors import did_you_mean
from gazelle.streams import Stream

ObstacleKind = Literal["box", "cylinder", "sphere"]
PlantKind = Literal["broadleaf", "conifer", "poplar", "bush", "rock"]
Range = tuple[float, float]

_PAINTS: tuple[Paint, ...] = ("beech", "orange", "blue", "clay", "green", "slate", "yellow", "red")
_DENSITY = 120.0  # of a movable obstacle: a carton with something in it [kg/m³]


@checked(BuildError)
def random_obstacles(
    count: int,
    *,
    area: Rectangle | None = None,
    seed: int = 0,
    kinds: Sequence[ObstacleKind] = ("box", "cylinder"),
    radius: Range = (0.15, 0.4),
    height: Range = (0.3, 1.0),
    keep_clear: Iterable[Zone] = (),
    gap: float = 0.3,
    movable: bool = False,
    name: str = "obstacle",
) -> tuple[Model, ...]:
    """Return obstacles at random places, no two of which overlap.

    Args:
        count: Number of obstacles.
        area: Area to fill; None for 10 m x 10 m around the origin.
        seed: Same seed, same obstacles.
        kinds: Allowed kinds.
        radius: Least and greatest radius of the circle around one [m].
        height: Least and greatest height [m]; a sphere's follows from its radius.
        keep_clear: Zones that none touches, such as where robots start.
        gap: Least distance between two, and from zones [m].
        movable: Whether they can be pushed; they then weigh 120 kg/m³.
        name: Each is called after it, with a number.

    Raises:
        BuildError: There is no room for all, or an argument makes no sense.
    """
    chosen = _choose(kinds, get_args(ObstacleKind), "obstacle")
    check_range(radius, "radius")
    check_range(height, "height")
    stream = Stream(seed, f"builders.{name}", 1)
    draws = stream.uniform(5 * _count(count))[0].reshape(count, 5).tolist()
    radii = [_between(radius, draw[0]) for draw in draws]
    places = scatter(radii, area or Rectangle(), stream, keep_clear=keep_clear, gap=gap)
    density = _DENSITY if movable else None
    models = []
    for number, (place, draw) in enumerate(zip(places, draws, strict=True)):
        make = _SOLIDS[chosen[int(draw[1] * len(chosen))]]
        paint = _PAINTS[int(draw[2] * len(_PAINTS))]
        tall = _between(height, draw[3])
        models.append(make(f"{name}_{number}", place, tall, draw[4], paint, density))
    return tuple(models)


@checked(BuildError)
def random_plants(
    count: int,
    *,
    area: Rectangle | None = None,
    seed: int = 0,
    kinds: Sequence[PlantKind] = ("broadleaf", "conifer"),
    height: Range = (4.0, 8.0),
    keep_clear: Iterable[Zone] = (),
    gap: float = 0.5,
    ground: Callable[[float, float], float] | None = None,
    name: str = "tree",
) -> tuple[Model, ...]:
    """Return trees, bushes and rocks at random places, their crowns apart.

    Args:
        count: Number of plants.
        area: Area to fill; None for 10 m x 10 m around the origin.
        seed: Same seed, same plants.
        kinds: Allowed kinds.
        height: Least and greatest height, of rocks the size [m].
        keep_clear: Zones that no crown reaches over.
        gap: Least distance between two crowns, and from zones [m].
        ground: Height of the ground at (x, y) [m], such as ``Terrain.height``; None for 0.
        name: Each is called after it, with a number.

    Raises:
        BuildError: There is no room for all, or an argument makes no sense.
    """
    chosen = _choose(kinds, get_args(PlantKind), "plant")
    check_range(height, "height")
    stream = Stream(seed, f"builders.{name}", 1)
    draws = stream.uniform(2 * _count(count))[0].reshape(count, 2).tolist()
    which = [chosen[int(draw[0] * len(chosen))] for draw in draws]
    tall = [_between(height, draw[1]) for draw in draws]
    radii = [_SPREAD[kind] * size for kind, size in zip(which, tall, strict=True)]
    places = scatter(radii, area or Rectangle(), stream, keep_clear=keep_clear, gap=gap)
    models = []
    for number, (kind, size, place) in enumerate(zip(which, tall, places, strict=True)):
        level = 0.0 if ground is None else ground(place.x, place.y)
        pose = Pose(place.x, place.y, level, yaw=place.yaw)
        models.append(_PLANTS[kind](f"{name}_{number}", size, pose))
    return tuple(models)


def _box(
    name: str, place: Place, height: float, shape: float, paint: Paint, density: float | None
) -> Model:
    # Any rectangle with its corners on the circle.
    angle = math.radians(25.0 + 40.0 * shape)
    length, width = 2.0 * place.radius * math.cos(angle), 2.0 * place.radius * math.sin(angle)
    mass = density * length * width * height if density else None
    return box(name, (length, width, height), pose=_pose(place), mass=mass, color=paint)


def _cylinder(
    name: str, place: Place, height: float, _: float, paint: Paint, density: float | None
) -> Model:
    mass = density * math.pi * place.radius**2 * height if density else None
    return cylinder(name, place.radius, height, pose=_pose(place), mass=mass, color=paint)


def _sphere(
    name: str, place: Place, _: float, __: float, paint: Paint, density: float | None
) -> Model:
    mass = density * 4.0 / 3.0 * math.pi * place.radius**3 if density else None
    return sphere(name, place.radius, pose=_pose(place), mass=mass, color=paint)


def _pose(place: Place) -> Pose:
    return Pose(place.x, place.y, yaw=place.yaw)


_SOLIDS: dict[str, Callable[[str, Place, float, float, Paint, float | None], Model]] = {
    "box": _box,
    "cylinder": _cylinder,
    "sphere": _sphere,
}

_PLANTS: dict[str, Callable[[str, float, Pose], Model]] = {
    "broadleaf": lambda name, size, pose: tree(name, kind="broadleaf", height=size, pose=pose),
    "conifer": lambda name, size, pose: tree(name, kind="conifer", height=size, pose=pose),
    "poplar": lambda name, size, pose: tree(name, kind="poplar", height=size, pose=pose),
    "bush": lambda name, size, pose: bush(name, height=size, pose=pose),
    "rock": lambda name, size, pose: rock(name, size=size, pose=pose),
}

_SPREAD = {"broadleaf": 0.42, "conifer": 0.24, "poplar": 0.14, "bush": 0.8, "rock": 0.6}
"""Radius of a plant over its height; a test checks that its shapes lie within."""


def check_range(span: Range, what: str) -> None:
    """Check that a range is two numbers above zero that do not fall.

    Raises:
        BuildError: It is not.
    """
    low, high = span
    if not 0.0 < low <= high < math.inf:
        raise BuildError(f"the {what} goes from a number above zero to a greater, found {span}")


def _between(span: Range, share: float) -> float:
    return span[0] + (span[1] - span[0]) * share


def _count(count: int) -> int:
    if not 0 <= count <= MAX_THINGS:
        raise BuildError(
            f"the number of things must not be negative or over {MAX_THINGS}, found {count}"
        )
    return count


def _choose(kinds: Sequence[str], known: Sequence[str], what: str) -> Sequence[str]:
    if not kinds:
        raise BuildError(f"name at least one kind of {what}", hint=f"there are: {', '.join(known)}")
    for kind in kinds:
        if kind not in known:
            raise BuildError(f"unknown {what} '{kind}'", hint=did_you_mean(kind, known))
    return kinds
