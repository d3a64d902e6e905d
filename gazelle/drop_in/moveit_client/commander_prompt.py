"""``moveit_commander_cmdline.py``: a prompt for commands that move a robot's groups."""

from __future__ import annotations

import argparse
import contextlib
import sys
from collections.abc import Mapping, Sequence

from gazelle.drop_in.moveit_client.session import session
from gazelle.drop_in.moveit_commander.group_commands import (
    Answer,
    MoveGroupInfoLevel,
)
from gazelle.drop_in.moveit_commander.interpreter import MoveGroupCommandInterpreter
from gazelle_ros.base.output import say
from gazelle_ros.builtin.arguments import parse_arguments, spin
from gazelle_ros.compat.rospy.client import init_node

_NAME = "move_group_interface_cmdline"
_COLOURS = {
    MoveGroupInfoLevel.FAIL: "\033[91m",
    MoveGroupInfoLevel.WARN: "\033[93m",
    MoveGroupInfoLevel.SUCCESS: "\033[92m",
    MoveGroupInfoLevel.DEBUG: "\033[94m",
}
_PLAIN = "\033[0m"
_ENDS = ("q", "quit", "exit")


def main(arguments: Sequence[str]) -> int:
    """Run commands until the input ends or one quits; returns the exit code."""
    options = _parser().parse_args(parse_arguments(arguments, _NAME).plain)
    init_node(_NAME, argv=[*arguments], anonymous=True, disable_signals=True)
    with session.node() as node, contextlib.suppress(KeyboardInterrupt):
        interpreter = MoveGroupCommandInterpreter()
        if options.group_name:
            _show(interpreter.execute(f"use {options.group_name}"))
        if options.service:
            sys.stdout.write("Running ROS service\n")
            return spin(node)
        converse(interpreter, node.master_uri)
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="moveit_commander_cmdline.py", description="Move a robot's groups by commands."
    )
    parser.add_argument("-i", "--interactive", action="store_true", help="take commands (default)")
    parser.add_argument("-s", "--service", action="store_true", help="only stay on the graph")
    parser.add_argument("group_name", nargs="?", default="", help="a group to use")
    return parser


def converse(interpreter: MoveGroupCommandInterpreter, master: str) -> None:
    """Run commands from the terminal, or from a file in its place.

    Args:
        interpreter: Understands them.
        master: Address of the master, for people.
    """
    completer = CommandCompleter()
    completer.install()
    sys.stdout.write("\nWaiting for commands. Type 'help' to get a list of known commands.\n\n")
    while True:
        completer.words = {**interpreter.get_keywords(), "quit": []}
        group = interpreter.get_active_group()
        try:
            line = input(f"{group.get_name() if group is not None else ''}> ").strip()
        except EOFError:
            break
        if line.lower() in _ENDS:
            break
        if line.lower() == "host":
            _show((MoveGroupInfoLevel.INFO, f"Master is '{master}'"))
        elif line:
            _show(interpreter.execute(line))
    sys.stdout.write("Bye bye!\n")


def _show(answer: Answer) -> None:
    """Show an answer; in colours on a terminal."""
    level, text = answer
    colour = _COLOURS.get(level, "") if sys.stdout.isatty() else ""
    say(f"{colour}{text}{_PLAIN if colour else ''}\n")


class CommandCompleter:
    """Ends words on the Tab key: commands, and after a command what may follow it.

    Attributes:
        words: Commands, and what may follow each.
    """

    def __init__(self) -> None:
        self.words: Mapping[str, Sequence[str]] = {}

    def install(self) -> None:
        """Install the completion in the prompt, if there is a line editor."""
        with contextlib.suppress(ImportError):
            import readline

            readline.set_completer(
                lambda text, state: self.end(readline.get_line_buffer(), text, state)
            )
            readline.parse_and_bind("tab: complete")

    def end(self, line: str, text: str, state: int) -> str | None:
        """Return one of the completions of a word, or None if there are no more.

        Args:
            line: All that is typed.
            text: The word.
            state: Index of the completion.
        """
        begun = line.split()
        first = begun[0] if begun else ""
        after = first in self.words and (len(begun) > 1 or line.endswith(" "))
        known = self.words[first] if after else self.words
        ends = sorted(word for word in known if word.startswith(text))
        return f"{ends[state]} " if state < len(ends) else None
