"""Write the map of a world for map_server: what is solid at a height, as OUT.yaml
and OUT.pgm. Robots are left out.

  gazelle map turtlebot3_world tb3_map
  gazelle map office.world office --height 0.3 --resolution 0.02
"""  # noqa: D205  # this is the text of --help

from __future__ import annotations

import argparse
import sys


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument(
        "source", metavar="WORLD", help="world file or bundled name, as for 'gazelle run'"
    )
    parser.add_argument("target", metavar="OUT", help="path of the map, with or without .yaml")
    parser.add_argument(
        "--height",
        type=float,
        default=0.2,
        help="height of the horizontal section [m] (default 0.2)",
    )
    parser.add_argument(
        "--resolution", type=float, default=0.05, help="cell size [m] (default 0.05)"
    )
    parser.add_argument(
        "--margin", type=float, default=1.0, help="free space around the models [m] (default 1)"
    )
    parser.add_argument(
        "--area",
        type=float,
        nargs=4,
        metavar=("X0", "Y0", "X1", "Y1"),
        help="corners of the map [m] (default: bounds of the models)",
    )
    parser.add_argument(
        "--path",
        metavar="DIR",
        action="append",
        default=[],
        help="folder to search for models and packages (repeatable)",
    )


def run(args: argparse.Namespace) -> int:
    """Run the command; returns the exit code."""
    from gazelle import formats
    from gazelle.navigation.true_map import true_map

    world = formats.load(args.source, paths=args.path)
    grid = true_map(
        world,
        args.height,
        resolution=args.resolution,
        margin=args.margin,
        area=None if args.area is None else tuple(args.area),
    )
    settings, picture = formats.save_map(grid, args.target)
    size = f"{grid.width} x {grid.height} cells of {grid.resolution:g} m"
    sys.stdout.write(f"wrote {settings} and {picture.name} ({size})\n")
    return 0
