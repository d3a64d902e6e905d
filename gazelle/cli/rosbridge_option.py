"""The flag ``--rosbridge``: browsers and other WebSocket clients beside a simulation."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from gazelle_ros.base.argument_types import port_number

if TYPE_CHECKING:
    from gazelle.bridges import RosServer
    from gazelle.stage.bridge import StageServer

_PORT = 9090


def add_rosbridge(parser: argparse.ArgumentParser) -> None:
    """Declare the flag."""
    parser.add_argument(
        "--rosbridge",
        metavar="PORT",
        type=port_number,
        nargs="?",
        const=_PORT,
        help="with --ros: also let roslibpy, roslib.js and Foxglove on this machine connect, as "
        f"'gazelle bridge' does (default {_PORT}, 0 for any free port)",
    )


@contextmanager
def running_rosbridge(server: RosServer | StageServer, args: argparse.Namespace) -> Iterator[None]:
    """Run rosbridge and rosapi beside the simulation, if requested.

    Raises:
        RosError: The port is taken.
    """
    if args.rosbridge is None:
        yield
        return
    from gazelle_ros.rosbridge.nodes import bridge, listening_text
    from gazelle_ros.rosbridge.settings import BridgeSettings

    settings = BridgeSettings(port=args.rosbridge)
    with bridge(settings, server.master_uri) as rosbridge:
        sys.stdout.write(f"{listening_text(settings, rosbridge.port)}\n")
        yield
