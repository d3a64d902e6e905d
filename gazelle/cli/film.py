r"""Make a film of a running world, a recording, a bag or a trained policy.

The format is GIF, or MP4 with the extra film. Neither a graphics card nor a
screen is needed.

  gazelle film fleet fleet.mp4 --for 10
  gazelle film turtlebot3_world burger.gif --spawn turtlebot3_burger@-2,-0.5 \
      --drive 0.2,0.3 --follow turtlebot3_burger --for 5 --fps 10
  gazelle film run.jsonl run.mp4 --speed 4
  gazelle film drive.bag camera.mp4 --topic /camera/image_raw
  gazelle film runs/TurtleBot3Stage1-ppo-20261105-140302 policy.mp4 --for 20
"""  # this is the text of --help

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterable, Iterator

from gazelle.array_types import Picture
from gazelle.cli.filming import add_source, opened
from gazelle.cli.progress_line import ProgressLine
from gazelle_ros.base.argument_types import positive_float
from gazelle_ros.base.interrupts import StopRequest, stopping

_SECONDS = 10.0


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    add_source(parser)
    parser.add_argument(
        "--for",
        dest="seconds",
        metavar="SECONDS",
        type=positive_float,
        help=f"simulated time to record (default {_SECONDS:g}; recordings and bags: to the end)",
    )
    parser.add_argument(
        "--fps",
        metavar="N",
        type=positive_float,
        default=25.0,
        help="frames per second (default 25)",
    )
    parser.add_argument(
        "--speed",
        metavar="X",
        type=positive_float,
        default=1.0,
        help="simulated seconds per second of video (default 1)",
    )


def run(args: argparse.Namespace) -> int:
    """Run the command; returns the exit code."""
    from gazelle.viewer.bag_top_view import BagTopView
    from gazelle.viewer.film_files import FILMS, writable, write_film
    from gazelle.viewer.sources import BagSource, RecordingSource, pictures_of

    file = writable(args.out, FILMS)
    with opened(args) as source, stopping() as stop:
        seconds = args.seconds
        if seconds is None and not isinstance(source, BagSource | BagTopView | RecordingSource):
            seconds = _SECONDS
        period = args.speed / args.fps
        total = None if seconds is None else max(1, round(seconds / period)) + 1
        shown = ProgressLine("filming", total, "pictures")
        pictures = shown.count(pictures_of(source, seconds, period))
        sys.stderr.write("filming; Ctrl-C ends the film early\n")
        count = write_film(file, _until(stop, pictures), args.fps)
    sys.stdout.write(f"{file}: {count} pictures, {count / args.fps:.1f} s\n")
    return 0 if stop.signal is None else 128 + stop.signal


def _until(stop: StopRequest, pictures: Iterable[Picture]) -> Iterator[Picture]:
    """Yield pictures until a stop is requested, at least one."""
    for picture in pictures:
        yield picture
        if stop.is_set():
            return
