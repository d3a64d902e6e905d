"""Hilly ground of flat facets: one tilted slab a cell, which every engine can simulate.

A slab lies along the plane that fits the four corners of its cell best, so that neighbours
meet without steps where the ground does not twist, and within a quarter of the twist
elsewhere.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from gazelle.argument_checks import checked
from gazelle.array_types import Floats
from gazelle.builders.errors import BuildError, positive
from gazelle.builders.paint import Paint
from gazelle.builders.placing import Zone
from gazelle.builders.solids import ORIGIN, Part, assemble
from gazelle.description import Box, Model, Pose
from gazelle.streams import Stream

_OVERLAP = 1.01  # slabs reach a little over their cells, so that no gap shows
_MOST_CELLS = 10_000


@checked(BuildError)
@dataclass(frozen=True, slots=True, eq=False)
class Terrain:
    """Heights on a grid around the origin.

    Attributes:
        heights: [m], shape (rows, columns): row 0 is the southern edge (least y), column 0
            the western (least x).
        cell: Distance of neighbours [m].

    Raises:
        BuildError: There are fewer than two rows or columns, or the distance is not positive.
    """

    heights: Floats
    cell: float

    def __post_init__(self) -> None:
        if self.heights.ndim != 2 or min(self.heights.shape) < 2:
            raise BuildError(f"a terrain has rows and columns, not the shape {self.heights.shape}")
        positive(self.cell, "the distance of heights")

    @property
    def size(self) -> tuple[float, float]:
        """Extent along x and y [m]."""
        rows, columns = self.heights.shape
        return ((columns - 1) * self.cell, (rows - 1) * self.cell)

    def height(self, x: float, y: float) -> float:
        """Return the height of the facet at a point [m].

        Outside the grid that of the nearest edge.
        """
        rows, columns = self.heights.shape
        across = min(max(x / self.cell + (columns - 1) / 2.0, 0.0), columns - 1.0)
        up = min(max(y / self.cell + (rows - 1) / 2.0, 0.0), rows - 1.0)
        column, row = min(int(across), columns - 2), min(int(up), rows - 2)
        middle, slope_x, slope_y = self._plane(row, column)
        return float(middle + slope_x * (across - column - 0.5) + slope_y * (up - row - 0.5))

    def _plane(self, row: int, column: int) -> tuple[float, float, float]:
        """Return the middle height of a cell's facet, and its rise [m] along x and y."""
        (a, b), (c, d) = self.heights[row : row + 2, column : column + 2].tolist()
        return ((a + b + c + d) / 4.0, (b + d - a - c) / 2.0, (c + d - a - b) / 2.0)

    def model(
        self,
        name: str = "terrain",
        *,
        pose: Pose = ORIGIN,
        above: float = -math.inf,
        color: Paint | Callable[[float], Paint] = "meadow",
        thickness: float = 1.0,
    ) -> Model:
        """Return the ground as a model that stands still.

        Args:
            name: Of the model.
            pose: Of the grid's middle, in the world.
            above: Cells with all corners at or below this height [m] are left out, to
                let the ground plane show there.
            color: Of all facets, or what gives that of a facet from its height [m].
            thickness: Of the slabs, downwards [m].

        Raises:
            BuildError: All cells are left out.
        """
        positive(thickness, "the thickness of the ground")
        rows, columns = self.heights.shape
        parts = [
            self._facet(row, column, color, thickness)
            for row in range(rows - 1)
            for column in range(columns - 1)
            if float(self.heights[row : row + 2, column : column + 2].max()) > above
        ]
        if not parts:
            raise BuildError(f"no cell of the terrain is above {above:g} m")
        return assemble(name, parts, pose=pose)

    def _facet(
        self, row: int, column: int, color: Paint | Callable[[float], Paint], thickness: float
    ) -> Part:
        rows, columns = self.heights.shape
        middle, rise_x, rise_y = self._plane(row, column)
        along_x = np.array([self.cell, 0.0, rise_x])
        along_y = np.array([0.0, self.cell, rise_y])
        normal = np.cross(along_x, along_y)
        normal /= np.linalg.norm(normal)
        axes = _square_axes(along_x, along_y)
        turn = np.stack((*axes, normal), axis=1)
        # The facet's outline is a parallelogram; the slab is the rectangle around it.
        length, width = (
            _OVERLAP * float(abs(along_x @ axis) + abs(along_y @ axis)) for axis in axes
        )
        top = np.array(
            [
                (column + 0.5 - (columns - 1) / 2.0) * self.cell,
                (row + 0.5 - (rows - 1) / 2.0) * self.cell,
                middle,
            ]
        )
        center = top - normal * thickness / 2.0
        pose = Pose.from_quaternion(tuple(center), Pose.from_matrix(turn).quaternion)
        paint = color(middle) if callable(color) else color
        return Part(f"facet_{row}_{column}", Box((length, width, thickness)), pose, paint)


def _square_axes(along_x: Floats, along_y: Floats) -> tuple[Floats, Floats]:
    """Return two orthogonal unit vectors, turned as little as possible from two given ones.

    Sum and difference of two unit vectors are at a right angle; the axes are between them.
    """
    x, y = along_x / np.linalg.norm(along_x), along_y / np.linalg.norm(along_y)
    plus, minus = x + y, y - x
    plus, minus = plus / np.linalg.norm(plus), minus / np.linalg.norm(minus)
    return (plus - minus) / math.sqrt(2.0), (plus + minus) / math.sqrt(2.0)


@checked(BuildError)
def terrain(heights: ArrayLike, *, cell: float = 1.0) -> Terrain:
    """Return ground of given heights [m], shape (rows, columns), ``cell`` [m] apart.

    Raises:
        BuildError: There are fewer than 2 x 2 or too many heights, or one is not finite.
    """
    positive(cell, "the side of a cell")
    grid = np.array(heights, dtype=np.float64)
    if grid.ndim != 2 or min(grid.shape) < 2:
        raise BuildError(
            f"heights have a shape (rows, columns) of at least 2, 2; found {grid.shape}"
        )
    if grid.size > _MOST_CELLS:
        raise BuildError(
            f"{grid.size} heights are too many slabs to simulate: the most are {_MOST_CELLS}",
            hint="take larger cells",
        )
    if not np.isfinite(grid).all():
        raise BuildError("all heights must be finite")
    return Terrain(grid, cell)


@checked(BuildError)
def hills(
    seed: int = 0,
    *,
    length: float = 40.0,
    width: float = 40.0,
    cell: float = 2.0,
    height: float = 3.0,
    spacing: float = 12.0,
    flat: Iterable[Zone] = (),
    blend: float = 6.0,
) -> Terrain:
    """Return random hills.

    Smooth value noise: a random height every ``spacing`` metres and half as high ones every
    half, joined by cubic steps (K. Perlin, "An Image Synthesizer", SIGGRAPH 1985).

    Args:
        seed: Same seed, same hills.
        length: Along x [m].
        width: Along y [m].
        cell: Side of a facet [m].
        height: Height of the highest possible hill [m]; the lowest ground is at 0.
        spacing: Of hill tops, roughly [m].
        flat: Zones where the ground is at 0.
        blend: Over how many metres around those zones it rises to full height [m].

    Raises:
        BuildError: A length is not positive, or there are too many cells.
    """
    for value, what in ((length, "length"), (width, "width"), (cell, "cell"), (height, "height"),
                        (spacing, "spacing"), (blend, "blend")):  # fmt: skip
        positive(value, f"the {what} of hills")
    columns, rows = (max(1, round(extent / cell)) for extent in (length, width))
    if (columns + 1) * (rows + 1) > _MOST_CELLS:
        raise BuildError(
            f"{columns} x {rows} facets are too many to simulate", hint="take a larger cell"
        )
    x = np.asarray((np.arange(columns + 1) - columns / 2.0) * cell, np.float64)
    y = np.asarray((np.arange(rows + 1) - rows / 2.0) * cell, np.float64)
    stream = Stream(seed, "builders.hills", 1)
    noise = (_noise(x, y, spacing, stream) + 0.5 * _noise(x, y, spacing / 2.0, stream)) / 1.5
    zones = tuple(flat)
    if zones:
        away = np.array([[min(zone.distance(u, v) for zone in zones) for u in x] for v in y])
        noise *= _smooth(np.clip(away / blend, 0.0, 1.0))
    return terrain(height * noise, cell=cell)


def _noise(x: Floats, y: Floats, spacing: float, stream: Stream) -> Floats:
    """Smooth random numbers from 0 to 1, shape (len(y), len(x))."""
    u, v = (x - x[0]) / spacing, (y - y[0]) / spacing
    columns, rows = int(u[-1]) + 2, int(v[-1]) + 2
    knots = stream.uniform(rows * columns)[0].reshape(rows, columns)
    j, i = u.astype(np.intp), v.astype(np.intp)
    s, t = _smooth(u - j), _smooth(v - i)[:, None]
    low = knots[np.ix_(i, j)] * (1.0 - s) + knots[np.ix_(i, j + 1)] * s
    high = knots[np.ix_(i + 1, j)] * (1.0 - s) + knots[np.ix_(i + 1, j + 1)] * s
    return np.asarray(low * (1.0 - t) + high * t, np.float64)


def _smooth(t: Floats) -> Floats:
    """Return 3 t² - 2 t³: from 0 to 1 with level ends."""
    return np.asarray(t * t * (3.0 - 2.0 * t), np.float64)
