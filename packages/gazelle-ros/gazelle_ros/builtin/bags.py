"""``rosbag record`` and ``rosbag play`` as nodes of a launch file."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence

from gazelle_ros.bags import commandline
from gazelle_ros.builtin.arguments import parse_arguments

_Configure = Callable[[argparse.ArgumentParser], None]


def record(arguments: Sequence[str]) -> int:
    """Record; returns the exit code."""
    found = parse_arguments(arguments, "record", anonymous=True)
    parsed = _parsed("record", commandline.configure_record, found.plain)
    return commandline.record(parsed, found.options)


def play(arguments: Sequence[str]) -> int:
    """Play bags; returns the exit code."""
    found = parse_arguments(arguments, "play", anonymous=True)
    parsed = _parsed("play", commandline.configure_play, found.plain)
    return commandline.play(parsed, found.options)


def _parsed(name: str, configure: _Configure, words: list[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog=name)
    configure(parser)
    return parser.parse_args(words)
