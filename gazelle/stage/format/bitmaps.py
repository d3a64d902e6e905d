"""The walls that the bitmaps of a file show."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from gazelle.errors import FormatError
from gazelle.formats.picture import read_picture
from gazelle.stage.format.entity import Property

WALL = 127
"""Greatest value of a pixel's first channel that is a wall."""
MAX_EDGES = 4_000_000
"""Edges between walls and free pixels of a bitmap; maps have far fewer, noise has more."""


@dataclass(slots=True)
class BitmapCells:
    """Cells of the bitmaps of one file, each read once."""

    cells: dict[Path, NDArray[np.bool_]] = field(default_factory=dict)

    def load(self, path: Path, entry: Property) -> NDArray[np.bool_]:
        """Load the walls of a picture, the row of least y first, cropped to what is drawn.

        Raises:
            FormatError: It cannot be read, or nothing is drawn in it.
        """
        if path not in self.cells:
            try:
                dark = read_picture(path)[::-1, :, 0] <= WALL
            except FormatError as error:
                raise entry.fail(f"'{path}': {error.message}", error.hint) from error
            rows, columns = np.flatnonzero(dark.any(axis=1)), np.flatnonzero(dark.any(axis=0))
            if not len(rows):
                raise entry.fail(f"the picture '{path}' shows no walls: it has no dark pixel")
            cells = np.ascontiguousarray(dark[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1])
            if _edges(cells) > MAX_EDGES:
                raise entry.fail(f"the picture '{path}' has more than {MAX_EDGES} edges")
            self.cells[path] = cells
        return self.cells[path]


def _edges(cells: NDArray[np.bool_]) -> int:
    return sum(
        int(np.count_nonzero(one != other))
        for one, other in ((cells[1:], cells[:-1]), (cells[:, 1:], cells[:, :-1]))
    )
