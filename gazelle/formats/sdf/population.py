"""``<population>``: one model many times, spread over a box or a cylinder.

Where Gazebo Classic puts them: a box is centred at the pose, a cylinder stands on it, a grid
is centred at it. The pose turns the places about the least corner of the box or grid, and
not the models, which all stand upright. Only chance is another.
"""

from __future__ import annotations

import zlib
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from gazelle.array_types import Floats
from gazelle.description import Parameters, Pose
from gazelle.errors import FormatError, did_you_mean
from gazelle.formats import values
from gazelle.formats.reading import Reading
from gazelle.formats.sdf.build import pose_element, with_attributes, with_child
from gazelle.formats.sdf.pose import read_pose

MAX_MODELS = 10_000

_ROUNDS = 20
_CLUSTERS = 500
"""More models than this are spread at random instead of evenly."""
_SAMPLES, _FEWEST, _MOST = 40, 10, 8000
"""Points for each cluster, at least a minimum number of each, and of all together."""


@dataclass(frozen=True, slots=True)
class Region:
    """Region in which models are placed.

    Attributes:
        size: Lengths along x, y, z of a box, or of the box around a cylinder [m].
        round: Whether it is a cylinder.
    """

    size: tuple[float, float, float]
    round: bool = False

    @property
    def middle(self) -> Floats:
        """Position of the pose, relative to the origin that positions are counted from [m]."""
        return np.zeros(3) if self.round else np.asarray(self.size) / 2.0

    def draw(self, chance: np.random.Generator, count: int) -> Floats:
        """Sample points in the region, shape (count, 3).

        They are counted from the least corner of a box, from the middle of a cylinder's base;
        in a cylinder they are denser around its axis, as Gazebo's are.
        """
        points: Floats = chance.random((count, 3))
        if self.round:
            radius, angle = points[:, 0] / 2.0, 2.0 * np.pi * points[:, 1]
            points[:, 0], points[:, 1] = radius * np.cos(angle), radius * np.sin(angle)
        return points * self.size


def expanded(node: Parameters, reading: Reading) -> Iterator[Parameters]:
    """Yield the models of a population, named ``NAME_clone_0`` and so on.

    Chance is seeded with the population's name: the same file gives the same places. One whose
    model, distribution or region is missing or makes no sense is left out, as Gazebo Classic
    ignores it (``gazebo::physics::Population::PopulateOne``).

    Raises:
        FormatError: There are more than ``MAX_MODELS``.
    """
    _limit(node)
    try:
        model = node.find("model")
        if model is None:
            raise values.fail(node, "a <population> needs a <model>")
        name = values.attribute(model, "name")
        stand = read_pose(node.find("pose"))
        middle, offsets = _places(node)
    except FormatError as error:
        reading.tolerate(error, "the population is left out")
        return
    for number, offset in enumerate(offsets.tolist()):
        x, y, z = np.add(stand.position, stand.rotate(offset)) - middle
        clone = with_attributes(model, name=f"{name}_clone_{number}")
        yield with_child(clone, pose_element(Pose(float(x), float(y), float(z)), node))


def _limit(node: Parameters) -> None:
    """Raise an error for more models than a world can hold."""
    count = values.whole(node, "model_count", 1)
    if values.word(node, "distribution/type", "random") == "grid":
        rows, columns = (values.whole(node, f"distribution/{side}", 1) for side in ("rows", "cols"))
        count = max(rows, 0) * max(columns, 0)
    if count > MAX_MODELS:
        raise values.fail(node, f"a population has up to {MAX_MODELS} models, found {count}")


def _places(node: Parameters) -> tuple[Floats, Floats]:
    """Return the middle of the region from its least corner, and places relative to it."""
    kind = values.word(node, "distribution/type", "random")
    if kind == "grid":
        return _grid(node)
    spread = _SPREADS.get(kind)
    if spread is None:
        known = [*_SPREADS, "grid"]
        raise values.fail(
            node.find("distribution") or node,
            f"unknown distribution '{kind}'",
            hint=did_you_mean(kind, known),
        )
    region = _region(node)
    if region.round and kind not in _ROUND:
        raise values.fail(node, f"the distribution '{kind}' needs a <box>")
    chance = np.random.default_rng(zlib.crc32(node.attributes.get("name", "").encode()))
    return region.middle, spread(region, _at_least_one(node, "model_count"), chance)


def _at_least_one(node: Parameters, path: str) -> int:
    count = values.whole(node, path, 1)
    if count < 1:
        raise values.fail(node, f"<{path.rpartition('/')[2]}> must be at least 1, found {count}")
    return count


def _region(node: Parameters) -> Region:
    box, cylinder = node.find("box"), node.find("cylinder")
    if box is not None:
        x, y, z = values.vector(box, "size", (1.0, 1.0, 1.0))
        for length in (x, y, z):
            values.positive(box, length, "the size of a box")
        return Region((x, y, z))
    if cylinder is None:
        raise values.fail(node, "a <population> needs a <box> or a <cylinder>")
    radius = values.positive(cylinder, values.real(cylinder, "radius", 1.0), "<radius>")
    length = values.positive(cylinder, values.real(cylinder, "length", 1.0), "<length>")
    return Region((2.0 * radius, 2.0 * radius, length), round=True)


def _grid(node: Parameters) -> tuple[Floats, Floats]:
    rows = _at_least_one(node, "distribution/rows")
    columns = _at_least_one(node, "distribution/cols")
    x, y, _ = values.vector(node, "distribution/step", (0.5, 0.5, 0.0))
    places = [(c * x, r * y, 0.0) for r in range(rows) for c in range(columns)]
    middle = np.array([x * (columns - 1) / 2.0, y * (rows - 1) / 2.0, 0.0])
    return middle, np.array(places, np.float64).reshape(-1, 3)


def _random(region: Region, count: int, chance: np.random.Generator) -> Floats:
    return region.draw(chance, count)


def _uniform(region: Region, count: int, chance: np.random.Generator) -> Floats:
    """Return centres of clusters of random points (Lloyd's k-means), which keep their distance."""
    centres = region.draw(chance, count)
    points = region.draw(chance, max(_FEWEST * count, min(_MOST, _SAMPLES * count)))
    for _ in range(_ROUNDS if 1 < count <= _CLUSTERS else 0):
        # |p - c|² but for |p|², which is the same for all centres c
        away = (centres * centres).sum(axis=1) - 2.0 * points @ centres.T
        nearest = away.argmin(axis=1)
        sums = np.zeros_like(centres)
        np.add.at(sums, nearest, points)
        counts = np.bincount(nearest, minlength=count)[:, None]
        centres = np.where(counts > 0, sums / np.maximum(counts, 1), centres)
    return centres


def _along(axis: int) -> Callable[[Region, int, np.random.Generator], Floats]:
    """Return a sampler of a row along an axis, in the middle of the others.

    The first at the edge.
    """

    def spread(region: Region, count: int, _: np.random.Generator) -> Floats:
        places = np.tile(region.middle, (count, 1))
        places[:, axis] = region.size[axis] * np.arange(count) / max(count, 1)
        return places

    return spread


_SPREADS: dict[str, Callable[[Region, int, np.random.Generator], Floats]] = {
    "linear-x": _along(0),
    "linear-y": _along(1),
    "linear-z": _along(2),
    "random": _random,
    "uniform": _uniform,
}
_ROUND = {"random", "uniform"}
