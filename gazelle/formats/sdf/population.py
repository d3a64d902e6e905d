"""``<population>``: one model many times, spread over a box or a cylinder."""

from __future__ import annotations

import zlib
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.description import Parameters, Pose
from gazelle.errors import did_you_mean
from gazelle.formats import values
from gazelle.formats.sdf.build import pose_element, with_attributes, with_child
from gazelle.formats.sdf.pose import read_pose

MAX_MODELS = 10_000

_SAMPLES = 40
_ROUNDS = 20

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Region:
    """Where models go: a box, or the cylinder inside of it; lengths along x, y, z [m]."""

    size: tuple[float, float, float]
    round: bool

    def draw(self, chance: np.random.Generator, count: int) -> Floats:
        """Points in it, evenly spread, shape (count, 3)."""
        cube = chance.uniform(-0.5, 0.5, (count, 3))
        if self.round:
            radius, angle = np.sqrt(cube[:, 0] + 0.5) / 2.0, 2.0 * np.pi * cube[:, 1]
            cube[:, 0], cube[:, 1] = radius * np.cos(angle), radius * np.sin(angle)
        points: Floats = cube * self.size
        return points


def expanded(node: Parameters) -> Iterator[Parameters]:
    """The models of a population, named ``NAME_clone_0`` and so on.

    Chance is seeded with the population's name: the same file gives the same places.

    Raises:
        FormatError: There is no model in it, or its distribution or number makes no sense.
    """
    model = node.find("model")
    if model is None:
        raise values.fail(node, "a <population> needs a <model>")
    name = values.attribute(model, "name")
    center = read_pose(node.find("pose"))
    for number, offset in enumerate(_offsets(node).tolist()):
        placed = center * Pose(*offset)
        clone = with_attributes(model, name=f"{name}_clone_{number}")
        yield with_child(clone, pose_element(placed, node))


def _offsets(node: Parameters) -> Floats:
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
    chance = np.random.default_rng(zlib.crc32(node.attributes.get("name", "").encode()))
    count = _count(node, values.whole(node, "model_count", 1))
    return spread(_region(node), count, chance)


def _count(node: Parameters, count: int) -> int:
    if not 0 <= count <= MAX_MODELS:
        raise values.fail(node, f"a population has 0 to {MAX_MODELS} models, found {count}")
    return count


def _region(node: Parameters) -> Region:
    cylinder = node.find("cylinder")
    if cylinder is not None:
        width = 2.0 * values.real(cylinder, "radius", 1.0)
        return Region((width, width, values.real(cylinder, "length", 1.0)), round=True)
    return Region(values.vector(node, "box/size", (1.0, 1.0, 1.0)), round=False)


def _grid(node: Parameters) -> Floats:
    rows = values.whole(node, "distribution/rows", 1)
    columns = values.whole(node, "distribution/cols", 1)
    _count(node, max(rows, 0) * max(columns, 0))
    x, y, _ = values.vector(node, "distribution/step", (0.5, 0.5, 0.0))
    places = [(c * x, r * y, 0.0) for r in range(rows) for c in range(columns)]
    return np.array(places, np.float64).reshape(-1, 3)


def _random(region: Region, count: int, chance: np.random.Generator) -> Floats:
    return region.draw(chance, count)


def _uniform(region: Region, count: int, chance: np.random.Generator) -> Floats:
    """Centres of clusters of random points (Lloyd's k-means), which keep their distance."""
    centres = region.draw(chance, count)
    for _ in range(_ROUNDS if 1 < count <= 500 else 0):
        points = region.draw(chance, _SAMPLES * count)
        nearest = np.linalg.norm(points[:, None] - centres[None], axis=2).argmin(axis=1)
        sums = np.zeros_like(centres)
        np.add.at(sums, nearest, points)
        counts = np.bincount(nearest, minlength=count)[:, None]
        centres = np.where(counts > 0, sums / np.maximum(counts, 1), centres)
    return centres


def _along(axis: int) -> Callable[[Region, int, np.random.Generator], Floats]:
    """Evenly in a row along an axis."""

    def spread(region: Region, count: int, _: np.random.Generator) -> Floats:
        places = np.zeros((count, 3))
        places[:, axis] = ((np.arange(count) + 0.5) / max(count, 1) - 0.5) * region.size[axis]
        return places

    return spread


_SPREADS: dict[str, Callable[[Region, int, np.random.Generator], Floats]] = {
    "linear-x": _along(0),
    "linear-y": _along(1),
    "linear-z": _along(2),
    "random": _random,
    "uniform": _uniform,
}
