"""Draw a picture: of a world, a recording, a bag or a trained policy; needs no
graphics card and no screen.

  gazelle picture turtlebot3_world world.png --spawn turtlebot3_burger@-2,-0.5
  gazelle picture my.world --at 5 --eye 2,-3,1.5 --target 0,0,0.2 five.png
  gazelle picture fleet fleet.png --top
  gazelle picture run.jsonl --at 3 crash.png
  gazelle picture runs/TurtleBot3Stage1-ppo-20261105-140302 --at 4 policy.png
"""  # noqa: D205  # this is the text of --help

from __future__ import annotations

import argparse
import sys

from gazelle.cli.filming import add_source, opened
from gazelle.cli.progress_line import ProgressLine
from gazelle_ros.base.argument_types import positive_float


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    add_source(parser)
    parser.add_argument(
        "--at",
        metavar="SECONDS",
        type=positive_float,
        help="simulated time of the image (default 0)",
    )


def run(args: argparse.Namespace) -> int:
    """Run the command; returns the exit code."""
    from gazelle.viewer.film_files import STILLS, writable, write_picture

    file = writable(args.out, STILLS)
    with opened(args) as source:
        if args.at is not None:
            for part in ProgressLine("simulating", 100, "%").count(range(1, 101)):
                source.advance(args.at * part / 100)
        picture = source.render()
    write_picture(file, picture)
    sys.stdout.write(f"{file}: {picture.shape[1]} x {picture.shape[0]}\n")
    return 0
