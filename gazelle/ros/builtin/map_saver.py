"""``map_saver``: a map of a topic as a YAML file and a picture (http://wiki.ros.org/map_server)."""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from gazelle.errors import RosError
from gazelle.ros.builtin.arguments import parse_arguments
from gazelle.ros.messages import load_message

_OCCUPIED, _FREE, _UNKNOWN = 0, 254, 205
"""Grey levels of cells."""
_DARK, _BRIGHT = 0.65, 0.196
"""Limits for reading: they tell the three levels apart, whatever the limits of the cells were."""


def main(arguments: Sequence[str]) -> int:
    """Save the next map; returns the exit code."""
    found = parse_arguments(arguments, "map_saver")
    parser = argparse.ArgumentParser(prog="map_saver")
    parser.add_argument("-f", dest="name", default="map", help="name without suffix")
    parser.add_argument("--occ", type=float, default=65, help="occupied from here on, 1 to 100")
    parser.add_argument("--free", type=float, default=25, help="free up to here, 0 to 100")
    parsed = parser.parse_args(found.plain)
    if not 0 <= parsed.free < parsed.occ <= 100:
        raise RosError("the limits are wrong", hint="--free is below --occ, both from 0 to 100")
    with found.start() as node:
        message = node.wait_for_message("map", load_message("nav_msgs/OccupancyGrid"))
    info = message.info
    size = f"{info.width} X {info.height} map @ {info.resolution:.3f} m/pix"
    write_map(message, parsed.name, occupied=parsed.occ, free=parsed.free)
    sys.stdout.write(f"Received a {size}; wrote {parsed.name}.pgm and {parsed.name}.yaml\n")
    return 0


def write_map(message: Any, name: str, *, occupied: float, free: float) -> None:
    """Write ``NAME.pgm`` and ``NAME.yaml``.

    Args:
        message: A ``nav_msgs/OccupancyGrid``.
        name: Path without suffix.
        occupied: Cells from this value on are black.
        free: Cells up to this value are white; others are grey.
    """
    info = message.info
    cells = np.array(message.data, dtype=np.int16).reshape(info.height, info.width)[::-1]
    known = cells >= 0
    levels = np.full(cells.shape, _UNKNOWN, np.uint8)
    levels[known & (cells <= free)] = _FREE
    levels[known & (cells >= occupied)] = _OCCUPIED
    picture = Path(f"{name}.pgm")
    head = (
        f"P5\n# CREATOR: map_saver {info.resolution:.3f} m/pix\n{info.width} {info.height}\n255\n"
    )
    picture.write_bytes(head.encode() + levels.tobytes())
    place, turn = info.origin.position, info.origin.orientation
    yaw = math.atan2(2.0 * (turn.w * turn.z + turn.x * turn.y), 1.0 - 2.0 * (turn.y**2 + turn.z**2))
    Path(f"{name}.yaml").write_text(
        f"image: {picture.name}\nresolution: {info.resolution:f}\n"
        f"origin: [{place.x:f}, {place.y:f}, {yaw:f}]\nnegate: 0\n"
        f"occupied_thresh: {_DARK}\nfree_thresh: {_BRIGHT}\n",
        encoding="utf-8",
    )
