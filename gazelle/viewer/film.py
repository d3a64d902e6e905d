"""Pictures and films of worlds in the plane as files: PNG, GIF, MP4."""

from __future__ import annotations

import contextlib
import shutil
import subprocess
from collections.abc import Iterable, Iterator
from pathlib import Path

from PIL import Image

from gazelle.array_types import Picture
from gazelle.errors import Error, did_you_mean
from gazelle.simulation import Simulation
from gazelle.viewer.plan import TopView

_STILLS = (".png", ".jpg", ".jpeg", ".webp")
_FILMS = (".gif", ".mp4")


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
        world: Which world of a batch.
        size: Width and height [pixel].
        scans: Whether to show what rangers and lidars meet.

    Returns:
        The picture, shape (height, width, 3).

    Raises:
        Error: The simulation is not in the plane, the suffix is not a picture's, or there is no
            such folder.
    """
    file = _checked(path, _STILLS)
    picture = TopView(simulation, world=world, size=size, scans=scans).look()
    Image.fromarray(picture).save(file)
    return picture


def film_plan(
    simulation: Simulation,
    path: str | Path,
    seconds: float,
    *,
    view: TopView | None = None,
    rate: float = 10.0,
    speed: float = 1.0,
) -> int:
    """Run a world of the planar engine and film it from above; needs no screen.

    Args:
        simulation: Runs, and is ``seconds`` later at the end.
        path: ``.gif``, or ``.mp4`` where the program ffmpeg is installed.
        seconds: Simulated time.
        view: Draws the pictures; with scans and trails by default.
        rate: Pictures a second of film.
        speed: Simulated seconds a second of film.

    Returns:
        The number of pictures.

    Raises:
        Error: The simulation is not in the plane, the suffix is not a film's, a number cannot
            be, or there is no ffmpeg.
    """
    file = _checked(path, _FILMS)
    if not (seconds > 0.0 and rate > 0.0 and speed > 0.0):
        raise Error("a film needs seconds, a rate and a speed above zero")
    drawn = view or TopView(simulation)
    count = max(1, round(seconds * rate / speed))
    pictures = _shots(simulation, drawn, count, seconds / count)
    if file.suffix.lower() == ".mp4":
        _write_mp4(file, pictures, rate)
    else:
        _write_gif(file, pictures, rate)
    return count + 1


def _shots(simulation: Simulation, view: TopView, count: int, period: float) -> Iterator[Picture]:
    """The first picture, and one after each period."""
    start = simulation.time
    yield view.look()
    for number in range(1, count + 1):
        # Towards a time of its own, so that no rounding adds up.
        ahead = start + number * period - simulation.time
        if ahead > 0.0:
            simulation.run(ahead)
        yield view.look()


def _write_gif(file: Path, pictures: Iterable[Picture], rate: float) -> None:
    frames = [
        Image.fromarray(picture).quantize(64, dither=Image.Dither.NONE) for picture in pictures
    ]
    frames[0].save(
        file, save_all=True, append_images=frames[1:], duration=round(1000.0 / rate), loop=0
    )


def _write_mp4(file: Path, pictures: Iterable[Picture], rate: float) -> None:
    program = shutil.which("ffmpeg")
    if program is None:
        raise Error(
            f"to write '{file.name}' the program ffmpeg is needed, and it is not installed",
            hint="install ffmpeg, or write a .gif",
        )
    stream = iter(pictures)
    first = next(stream)
    height, width = first.shape[:2]
    command = [program, "-y", "-loglevel", "error", "-f", "rawvideo", "-pix_fmt", "rgb24"]
    command += ["-s", f"{width}x{height}", "-r", f"{rate:g}", "-i", "-"]
    command += ["-pix_fmt", "yuv420p", "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", str(file)]
    with subprocess.Popen(  # noqa: S603  # the program found, and arguments made here
        command, stdin=subprocess.PIPE, stderr=subprocess.PIPE
    ) as process:
        with contextlib.suppress(BrokenPipeError):  # it ended early, and says why below
            if process.stdin is not None:
                process.stdin.write(first.tobytes())
                for picture in stream:
                    process.stdin.write(picture.tobytes())
        _, said = process.communicate()
    if process.returncode != 0:
        raise Error(
            f"ffmpeg could not write '{file.name}': {said.decode(errors='replace').strip()}"
        )


def _checked(path: str | Path, suffixes: tuple[str, ...]) -> Path:
    file = Path(path)
    if file.suffix.lower() not in suffixes:
        raise Error(
            f"'{file.name}' does not end with {' or '.join(suffixes)}",
            hint=did_you_mean(file.suffix, suffixes),
        )
    if not file.absolute().parent.is_dir():
        raise Error(f"there is no folder '{file.parent}' to write '{file.name}' to")
    return file
