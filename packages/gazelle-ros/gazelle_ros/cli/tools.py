"""Common parts of the commands of ROS 1 tools: sub-commands and questions."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from typing import Any

from gazelle_ros.base.output import say
from gazelle_ros.cli.parsing import Parser

Action = Callable[[argparse.Namespace], int]


class SubCommands:
    """The sub-commands of a command.

    Args:
        parser: The command's parser.
    """

    def __init__(self, parser: argparse.ArgumentParser) -> None:
        self._program = parser.prog
        self._parsers: Any = parser.add_subparsers(
            dest="sub_command", required=True, metavar="SUB-COMMAND", parser_class=Parser
        )

    def add(
        self, name: str, purpose: str, action: Action, *examples: str
    ) -> argparse.ArgumentParser:
        """Add a sub-command; returns its parser.

        Args:
            name: Name as typed by the user.
            purpose: One line for ``--help``.
            action: Runs it.
            *examples: Its arguments in the examples of ``--help``.
        """
        lines = "".join(f"\n  {self._program} {name} {each}".rstrip() for each in examples)
        made: argparse.ArgumentParser = self._parsers.add_parser(
            name,
            help=purpose,
            description=f"{purpose[:1].upper()}{purpose[1:]}." + (lines and f"\n{lines}"),
        )
        made.set_defaults(action=action, parser=made)
        return made


def answer(question: str, choices: set[str]) -> str | None:
    """Ask the user for one of the choices; return None at the end of standard input."""
    say(question)
    while line := sys.stdin.readline():
        if line.strip() in choices:
            return line.strip()
        say(f"please answer with one of: {', '.join(sorted(choices))}\n")
    return None
