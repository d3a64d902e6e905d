"""Pictures of a running simulation as files."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from gazelle.argument_checks import checked
from gazelle.errors import Error
from gazelle.sensors import View, look_at
from gazelle.simulation import Simulation
from gazelle.viewer.film_files import STILLS, writable, write_picture


@checked(Error)
def take_picture(
    simulation: Simulation,
    path: str | Path,
    *,
    eye: tuple[float, float, float],
    target: tuple[float, float, float] = (0.0, 0.0, 0.0),
    size: tuple[int, int] = (960, 600),
    world: int = 0,
) -> NDArray[np.uint8]:
    """Render a simulation and write it to a file; needs no graphics card and no screen.

    Args:
        simulation: Simulation to view.
        path: ``.png``, ``.jpg`` or ``.webp``.
        eye: Position of the camera [m].
        target: Target point [m].
        size: Width and height [pixel].
        world: World of a batch.

    Returns:
        The picture, shape (height, width, 3).

    Raises:
        Error: The file's suffix is not a picture's, there is no such folder, or no such picture.
    """
    file = writable(path, STILLS)
    picture = simulation.render(View(look_at(eye, target), *size), world)
    write_picture(file, picture)
    return picture
