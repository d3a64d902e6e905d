"""Open the ROS graph to WebSocket clients: rosbridge v2 and rosapi, until Ctrl-C.

  gazelle bridge
  gazelle bridge --port 9091
  gazelle bridge --address 0.0.0.0 --allow-origin 'https://robots.example.org'

roslibpy, roslib.js and Foxglove connect to ws://localhost:9090. Only this
machine can reach it unless --address names an address of a network. Web pages
of other origins are refused unless they match --allow-origin; pages opened as
files have the origin 'null'.
"""  # this is the text of --help

from __future__ import annotations

import argparse

from gazelle_ros.base.argument_types import port_number
from gazelle_ros.base.output import say


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument(
        "-p",
        "--port",
        type=port_number,
        default=9090,
        help="port (default 9090; 0 for any free port)",
    )
    parser.add_argument(
        "--address", default="127.0.0.1", help="to listen on (default: loopback only)"
    )
    parser.add_argument(
        "--allow-origin",
        action="append",
        default=[],
        metavar="PATTERN",
        help="web pages that may connect, such as 'https://*.example.org'",
    )
    parser.add_argument(
        "--master", metavar="URI", help="default: ROS_MASTER_URI, else this machine"
    )


def run(args: argparse.Namespace) -> int:
    """Run the command; returns the exit code."""
    from gazelle_ros.builtin.arguments import spin
    from gazelle_ros.rosbridge.nodes import bridge, listening_text
    from gazelle_ros.rosbridge.settings import BridgeSettings

    given = {"port": args.port, "address": args.address, "allowed_origins": args.allow_origin}
    settings = BridgeSettings(**given)
    with bridge(settings, args.master) as server:
        say(f"{listening_text(settings, server.port)}\n")
        return spin(server.node)
