"""Pictures and films of running simulations as files."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Protocol

from gazelle.argument_checks import checked
from gazelle.array_types import Picture
from gazelle.errors import Error
from gazelle.simulation import Simulation
from gazelle.viewer.film_files import FILMS, STILLS, writable, write_film, write_picture
from gazelle.viewer.limits import check_rate, picture_count
from gazelle.viewer.plan import TopView
from gazelle.viewer.scene_camera import SceneCamera


class FilmCamera(Protocol):
    """Camera that draws a simulation: a ``SceneCamera`` or a ``TopView``."""

    def render(self) -> Picture:
        """Render the simulation now, shape (height, width, 3)."""


@checked(Error)
def film(
    simulation: Simulation,
    path: str | Path,
    seconds: float,
    *,
    camera: FilmCamera | None = None,
    rate: float = 25.0,
    speed: float = 1.0,
) -> int:
    """Run a simulation and film it; needs no screen.

    Args:
        simulation: Runs, and is ``seconds`` later at the end.
        path: ``.gif``, or ``.mp4`` with the extra ``film``.
        seconds: Simulated time.
        camera: Draws the pictures; by default a ``SceneCamera`` that sees everything.
        rate: Pictures a second of film, from 0.01 to 1000.
        speed: Simulated seconds a second of film.

    Returns:
        The number of pictures.

    Raises:
        Error: The suffix is not a film's, or a number is invalid.
        MissingExtraError: MP4 is requested, and its writer is not installed.
    """
    file = writable(path, FILMS)
    if not (seconds > 0.0 and speed > 0.0):
        raise Error("a film needs seconds and a speed above zero")
    check_rate(rate)
    count = picture_count(seconds, speed / rate)
    drawn = camera or SceneCamera(simulation)
    return write_film(file, shots(simulation, drawn, count, seconds / count), rate)


@checked(Error)
def take_plan(
    simulation: Simulation,
    path: str | Path,
    *,
    world: int = 0,
    size: tuple[int, int] = (960, 720),
    scans: bool = True,
) -> Picture:
    """Draw a world of the planar engine from above into a file; needs no screen.

    Args:
        simulation: Of a world with ``engine="planar"``.
        path: ``.png``, ``.jpg`` or ``.webp``.
        world: World of a batch.
        size: Width and height [pixel].
        scans: Whether to show what rangers and lidars meet.

    Returns:
        The picture, shape (height, width, 3).

    Raises:
        Error: The simulation is not in the plane, the suffix is not a picture's, there is no
            such folder, or no such picture.
    """
    file = writable(path, STILLS)
    picture = TopView(simulation, world=world, size=size, scans=scans).render()
    write_picture(file, picture)
    return picture


@checked(Error)
def film_plan(
    simulation: Simulation,
    path: str | Path,
    seconds: float,
    *,
    view: TopView | None = None,
    rate: float = 10.0,
    speed: float = 1.0,
) -> int:
    """Run a world of the planar engine and film it from above; see ``film``.

    Args:
        simulation: Runs, and is ``seconds`` later at the end.
        path: ``.gif``, or ``.mp4`` with the extra ``film``.
        seconds: Simulated time.
        view: Draws the pictures; with scans and trails by default.
        rate: Pictures a second of film.
        speed: Simulated seconds a second of film.

    Returns:
        The number of pictures.

    Raises:
        Error: The simulation is not in the plane, or as ``film``.
    """
    camera = view or TopView(simulation)
    return film(simulation, path, seconds, camera=camera, rate=rate, speed=speed)


def shots(
    simulation: Simulation, camera: FilmCamera, count: int, period: float
) -> Iterator[Picture]:
    """Yield the first picture, and one after each period of simulated time [s]."""
    start = simulation.time
    yield camera.render()
    for number in range(1, count + 1):
        # Towards a time of its own, so that no rounding adds up.
        ahead = start + number * period - simulation.time
        if ahead > 0.0:
            simulation.run(ahead)
        yield camera.render()
