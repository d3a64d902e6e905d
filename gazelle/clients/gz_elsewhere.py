"""The sub-commands of ``gz`` that are commands of ``gazelle``, and those that are for a window."""

from __future__ import annotations

import argparse
import subprocess
import sys
from collections.abc import Sequence

_VERBS = ("echo", "info", "hz", "bw")

NOT_HERE = {
    "camera": "it moves the camera of a window: 'gazelle view' has one, 'gazelle film --eye' another",
    "debug": "'gazelle check FILE' says what is wrong with a file",
    "log": "logs of Gazebo are not written: 'gazelle bag record -a' and 'gazelle bag play' do that",
    "marker": "markers of a window are not drawn: publish visualization_msgs/Marker",
    "plugin": "'gazelle plugins' lists what is simulated",
}
"""Sub-commands that do nothing here, and what does."""

OPTIONS_NOT_HERE = {
    "joint": "only -f is there; targets of joints are for controllers, as ros_control's topics",
    "physics": "settings are -g, -s, -i and -u; profiles (-o) are not read",
    "sdf": "-k and -p are there; 'gazelle convert FILE - --to sdf' prints a file as SDF",
    "topic": "-l, -e, -i, -z, -b and -d are there; 'gazelle topic pub' publishes, 'gazelle view' shows",
    "world": "-p, -s, -m, -r and -o are there; -r puts back the time too",
}
"""Options that are there, of sub-commands that have more in Gazebo."""


def add_elsewhere(commands: argparse._SubParsersAction) -> None:  # type: ignore[type-arg]
    """Declare the sub-commands."""
    sdf = commands.add_parser("sdf", help="check or print a file")
    what = sdf.add_mutually_exclusive_group()
    what.add_argument("-k", "--check", metavar="FILE", help="check it")
    what.add_argument("-p", "--print", metavar="FILE", dest="shown", help="print it as SDF")
    topic = commands.add_parser("topic", help="topics of the graph")
    what = topic.add_mutually_exclusive_group()
    what.add_argument("-l", "--list", action="store_true", dest="listed", help="list them")
    what.add_argument("-e", "--echo", metavar="TOPIC", help="print its messages")
    what.add_argument("-i", "--info", metavar="TOPIC", help="tell who speaks on it")
    what.add_argument("-z", "--hz", metavar="TOPIC", help="measure its rate")
    what.add_argument("-b", "--bw", metavar="TOPIC", help="measure its bandwidth")
    topic.add_argument("-d", "--duration", type=float, metavar="S", help="end after so long [s]")
    topic.add_argument("-w", "--world-name", help=argparse.SUPPRESS)
    for name, advice in NOT_HERE.items():
        commands.add_parser(name, help=advice)


def elsewhere(options: argparse.Namespace, rest: Sequence[str]) -> int | None:
    """Run a command without a simulator; returns its exit code, or None if it needs one.

    Args:
        options: As parsed.
        rest: Words that the sub-command does not know.
    """
    if options.command in NOT_HERE:
        sys.stderr.write(f"gz {options.command}: {NOT_HERE[options.command]}\n")
        return 1
    if rest or not _has_a_task(options):
        known = OPTIONS_NOT_HERE.get(options.command, f"'gz help {options.command}' lists options")
        unknown = f"it does not know {' '.join(rest)}: " if rest else ""
        sys.stderr.write(f"gz {options.command}: {unknown}{known}\n")
        return 2
    if options.command == "sdf":
        file = options.check or options.shown
        words = ["check", file] if options.check else ["convert", file, "-", "--to", "sdf"]
    elif options.command == "topic":
        words = ["topic", *_topic_words(options)]
    else:
        return None
    return _call(words, getattr(options, "duration", None))


def _has_a_task(options: argparse.Namespace) -> bool:
    """Return False for a sub-command without its required arguments."""
    needed = {"joint": ("force",), "sdf": ("check", "shown"), "topic": ("listed", *_VERBS)}
    names = needed.get(options.command)
    return names is None or any(getattr(options, name) not in (None, False) for name in names)


def _call(words: Sequence[str], duration: float | None) -> int:
    """Run a command of ``gazelle``, for a limited time."""
    command = [sys.executable, "-m", "gazelle.cli.main", *words]
    with subprocess.Popen(command) as process:  # noqa: S603  # our own program
        try:
            return process.wait(duration)
        except subprocess.TimeoutExpired:
            process.terminate()
            process.wait()
            return 0


def _topic_words(options: argparse.Namespace) -> list[str]:
    for verb in _VERBS:
        if getattr(options, verb):
            return [verb, getattr(options, verb)]
    return ["list"]
