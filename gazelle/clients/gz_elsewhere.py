"""The sub-commands of ``gz`` that are commands of ``gazelle``, and those that are for a window."""

from __future__ import annotations

import argparse
import subprocess
import sys
from collections.abc import Sequence

NOT_HERE = {
    "camera": "it moves the camera of a window: 'gazelle view' has one, 'gazelle film --eye' another",
    "debug": "'gazelle check FILE' says what is wrong with a file",
    "log": "logs of Gazebo are not written: 'gazelle bag record -a' and 'gazelle bag play' do that",
    "marker": "markers of a window are not drawn: publish visualization_msgs/Marker",
    "plugin": "'gazelle plugins' lists what is simulated",
}
"""Sub-commands that do nothing here, and what does."""


def add_elsewhere(commands: argparse._SubParsersAction) -> None:  # type: ignore[type-arg]
    """Declare the sub-commands."""
    sdf = commands.add_parser("sdf", help="check or print a file")
    what = sdf.add_mutually_exclusive_group(required=True)
    what.add_argument("-k", "--check", metavar="FILE", help="check it")
    what.add_argument("-p", "--print", metavar="FILE", dest="shown", help="print it as SDF")
    topic = commands.add_parser("topic", help="topics of the graph")
    what = topic.add_mutually_exclusive_group(required=True)
    what.add_argument("-l", "--list", action="store_true", dest="listed", help="list them")
    what.add_argument("-e", "--echo", metavar="TOPIC", help="print its messages")
    what.add_argument("-i", "--info", metavar="TOPIC", help="tell who speaks on it")
    what.add_argument("-z", "--hz", metavar="TOPIC", help="measure its rate")
    what.add_argument("-b", "--bw", metavar="TOPIC", help="measure its bandwidth")
    for name, advice in NOT_HERE.items():
        commands.add_parser(name, help=advice)


def elsewhere(options: argparse.Namespace, rest: Sequence[str]) -> int | None:
    """Do what another command does; returns its exit code, or None for what needs a simulator."""
    if options.command in NOT_HERE:
        sys.stderr.write(f"gz {options.command}: {NOT_HERE[options.command]}\n")
        return 1
    if options.command == "sdf":
        file = options.check or options.shown
        words = ["check", file] if options.check else ["convert", file, "-", "--to", "sdf"]
    elif options.command == "topic":
        words = ["topic", *_topic_words(options)]
    else:
        return None
    return subprocess.call([sys.executable, "-m", "gazelle.cli.main", *words, *rest])  # noqa: S603


def _topic_words(options: argparse.Namespace) -> list[str]:
    for verb in ("echo", "info", "hz", "bw"):
        if getattr(options, verb):
            return [verb, getattr(options, verb)]
    return ["list"]
