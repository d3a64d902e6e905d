"""``map_saver``: a map of a topic as a YAML file and a picture (http://wiki.ros.org/map_server)."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

from gazelle.bridges.navigation.map_messages import grid_of_message
from gazelle.errors import RosError
from gazelle.formats.occupancy_writing import save_map
from gazelle_ros.builtin.arguments import parse_arguments
from gazelle_ros.msgs import nav_msgs


def main(arguments: Sequence[str]) -> int:
    """Save the next map; returns the exit code."""
    found = parse_arguments(arguments, "map_saver", anonymous=True)
    parser = argparse.ArgumentParser(prog="map_saver")
    parser.add_argument("-f", dest="name", default="map", help="name without suffix")
    parser.add_argument("--occ", type=float, default=65, help="occupied from here on, 1 to 100")
    parser.add_argument("--free", type=float, default=25, help="free up to here, 0 to 100")
    parsed = parser.parse_args(found.plain)
    if not 0 <= parsed.free < parsed.occ <= 100:
        raise RosError(
            "--free and --occ are out of range",
            hint="--free must be below --occ, both from 0 to 100",
        )
    with found.start() as node:
        message = node.wait_for_message("map", nav_msgs.msg.OccupancyGrid)
    grid = grid_of_message(message)
    save_map(grid, parsed.name, occupied=parsed.occ, free=parsed.free)
    size = f"{grid.width} X {grid.height} map @ {grid.resolution:.3f} m/pix"
    sys.stdout.write(f"Received a {size}; wrote {parsed.name}.pgm and {parsed.name}.yaml\n")
    return 0
