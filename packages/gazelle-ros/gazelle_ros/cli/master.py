"""Run a ROS 1 master with parameter server and rosout, until Ctrl-C.

  gazelle master
  gazelle master --port 11322
  gazelle master --host 192.168.1.10

Only this machine can reach it unless --host names an address of a network.
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
        help="port (default: that of ROS_MASTER_URI, else 11311; 0 for any free port)",
    )
    parser.add_argument(
        "--host",
        help="host name or address to advertise (default: loopback only)",
    )
    parser.add_argument("--no-rosout", action="store_true", help="do not start rosout")


def run(args: argparse.Namespace) -> int:
    """Run the command; returns the exit code."""
    from gazelle_ros import net
    from gazelle_ros.base.interrupts import stopping
    from gazelle_ros.master.server import run_master

    port = args.port
    if port is None:
        port = net.split_uri(net.default_master_uri())[1]
    host = args.host or net.default_host()
    with stopping() as end:
        run_master(host, port, rosout=not args.no_rosout, ready=_announce, end=end)
    return 0


def _announce(uri: str) -> None:
    say(f"ROS master at {uri}\nexport ROS_MASTER_URI={uri}\n")
