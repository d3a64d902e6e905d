"""Plot curves of trainings, columns of a table, or what a bag recorded, as PNG,
SVG or PDF. Needs matplotlib: pip install "gazelle[plots]".

  gazelle plot runs/A runs/B curves.png               trainings, side by side
  gazelle plot drive.bag path.svg [--map map.yaml]    where the robot went
  gazelle plot drive.bag speed.png --field /odom/twist/twist/linear/x
  gazelle plot performance.csv load.png               all columns of numbers
  gazelle plot stalls.csv stalls.png --field stalled
"""  # noqa: D205  # this is the text of --help

from __future__ import annotations

import argparse
import sys
from pathlib import Path


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument(
        "sources", metavar="SOURCE", nargs="+", type=Path, help="folders of runs, a bag or a table"
    )
    parser.add_argument("out", metavar="OUT", type=Path, help="the file to write")
    parser.add_argument(
        "--field",
        metavar="NAME",
        action="append",
        default=[],
        help="a column, or /TOPIC/FIELD of a bag (repeatable)",
    )
    parser.add_argument(
        "--topic",
        metavar="NAME",
        action="append",
        default=[],
        help="odometry or poses of a bag (default: all; repeatable)",
    )
    parser.add_argument(
        "--map", metavar="FILE", type=Path, help="map under a path (default: its own)"
    )
    parser.set_defaults(parser=parser)


def run(args: argparse.Namespace) -> int:
    """Run the command; returns the exit code."""
    from gazelle.viewer.plots import plot_table, plot_trainings

    first, *others = args.sources
    kind = "run" if first.is_dir() else first.suffix
    if others and kind != "run":
        args.parser.error("several sources are plotted together only if all are folders of runs")
    if kind == "run":
        plot_trainings(args.sources, args.out)
    elif kind == ".bag":
        _plot_bag(first, args)
    else:
        plot_table(first, args.field, args.out)
    sys.stdout.write(f"wrote {args.out}\n")
    return 0


def _plot_bag(bag: Path, args: argparse.Namespace) -> None:
    """Plot fields over time, or paths over a map."""
    from gazelle.formats import load_map
    from gazelle.viewer.bag_plots import bag_map, bag_paths, bag_series
    from gazelle.viewer.plots import plot_paths, plot_series

    if args.field:
        plot_series(bag_series(bag, args.field), "time [s]", args.out)
        return
    grid = bag_map(bag) if args.map is None else load_map(args.map)
    plot_paths(bag_paths(bag, args.topic), grid, args.out)
